use effects::weeded;
use logs::LogError;
use rayon::prelude::*;
use robot::Robot;

use crate::between::{Between, between};
use crate::blocks::{Block, FEWEST_BLOCKS, Fold, Folding, blocks};
use crate::contest::Apart;
use crate::design::Design;
use crate::error::DiagnosisError;
use crate::extend::{Solved, solved};
use crate::failed::{Failed, rise};
use crate::findings::{Evidence, Found};
use crate::gain::HeldOutGain;
use crate::gram::Grams;
use crate::held_out::{HeldOut, spans};
use crate::idle::idle;
use crate::log::Log;
use crate::problem::{Model, Problem};
use crate::progress::Progress;
use crate::result::{Diagnosis, RuledOut};
use crate::search::Record;
use crate::settings::Settings;
use crate::settled::{Settled, Withheld};
use crate::traces::{RunTraces, traces};
use crate::uncertainty::Fitted;

/// Everything a diagnosis looks at, once the logs are prepared.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Study<'a> {
    /// The robot as it was described.
    pub nominal: &'a Robot,
    /// The same with the germs of effects, which the design is about.
    pub robot: &'a Robot,
    pub settings: &'a Settings,
    pub log: Log<'a>,
    pub design: &'a Design,
    /// Why the logs say nothing of a joint.
    pub inadequate: &'a [Option<String>],
}

/// What the search over the whole record came to.
pub(crate) struct Answer<'a> {
    /// The same problem held out by run.
    pub by_run: Problem<'a>,
    pub extended: Robot,
    pub found: Vec<Found>,
    pub ruled_out: Vec<RuledOut>,
    /// The smallest level of dry friction that would have been found at every joint (N·m or N).
    pub unseen_friction: Vec<f64>,
    /// Number of hypotheses that were looked for.
    pub hypotheses: usize,
    pub gain: HeldOutGain,
    pub failed: Failed,
    /// What is left by what was found without each run, and by nothing, `[joint][run][sample]`.
    pub left: Vec<Vec<Vec<f64>>>,
    pub gap: Vec<Vec<Vec<f64>>>,
    /// What second encoders show.
    pub between: Option<Between>,
}

/// What a search over the whole record came to.
pub(crate) struct Conclusion<'a> {
    pub problem: Problem<'a>,
    pub model: Model,
    pub solution: Solved,
    pub apart: Apart,
    pub withheld: Withheld,
    pub failed: Failed,
}

/// What is told of a conclusion.
pub(crate) struct Told {
    pub found: Vec<Found>,
    pub ruled_out: Vec<RuledOut>,
    /// The smallest level of dry friction that would have been found at every joint (N·m or N).
    pub unseen_friction: Vec<f64>,
}

/// What a search came to whose effects all do what their columns say.
struct Searched<'a> {
    problem: Problem<'a>,
    model: Model,
    solution: Solved,
}

impl Study<'_> {
    /// Searches, tests and reports; `data.runs` and `warnings` are left for the caller.
    pub fn run(
        &self,
        progress: &dyn Progress,
    ) -> Result<(Diagnosis, Vec<RunTraces>, Robot, Vec<HeldOut>), DiagnosisError> {
        progress.stage("searching for causes", 3);
        self.with_record(|record| {
            progress.step();
            let answer = self.answer(record, progress)?;
            let diagnosis = self.report(record, &answer);
            let traces = traces(self, &answer)?;
            let held_out = self.held_out(record, &answer);
            Ok((diagnosis, traces, answer.extended, held_out))
        })?
    }

    /// The robot with what a search over the whole record finds, before any test of it.
    pub fn extended(&self) -> Result<Robot, DiagnosisError> {
        self.with_record(|record| {
            let all: Vec<usize> = (0..record.blocks.len()).collect();
            Ok(self.searched(record, &all)?.solution.robot)
        })?
    }

    /// What `look` makes of the record, cut into blocks.
    pub fn with_record<T>(&self, look: impl FnOnce(&Record) -> T) -> Result<T, DiagnosisError> {
        let blocks = self.blocks()?;
        let grams = Grams::new(self.design, &blocks);
        let practical = self.practical();
        Ok(look(&Record {
            robot: self.robot,
            design: self.design,
            blocks: &blocks,
            grams: &grams,
            practical: &practical,
        }))
    }

    /// Blocks of at least five autocorrelation times of what a model of everything leaves.
    fn blocks(&self) -> Result<Vec<Block>, DiagnosisError> {
        let rough = blocks(self.design, 1.0);
        if rough.len() < FEWEST_BLOCKS {
            return Err(DiagnosisError::TooShort { got: rough.len(), expected: FEWEST_BLOCKS });
        }
        let grams = Grams::new(self.design, &rough);
        let practical = self.practical();
        let record = Record {
            robot: self.robot,
            design: self.design,
            blocks: &rough,
            grams: &grams,
            practical: &practical,
        };
        Ok(blocks(self.design, record.memory()))
    }

    /// Least fall of each joint's held-out RMS error that counts (N·m or N).
    fn practical(&self) -> Vec<f64> {
        let rms = |j: usize| {
            let joints = self.design.runs.iter().map(|run| &run.joints[j]);
            let efforts = joints.flat_map(|joint| joint.told(joint.measured.iter().copied()));
            let (n, sum) = efforts.fold((0, 0.0), |(n, s), e| (n + 1, s + e * e));
            (sum / f64::from(n.max(1))).sqrt()
        };
        (0..self.design.joints()).map(|j| self.settings.practical_share * rms(j)).collect()
    }

    fn answer<'b>(
        &self,
        record: &Record<'b>,
        progress: &dyn Progress,
    ) -> Result<Answer<'b>, DiagnosisError> {
        let conclusion = self.conclusion(record, progress)?;
        let by_run = conclusion.problem.refolded(Folding::ByRun);
        let (conclusion, gain) = self.that_predicts(record, &by_run, conclusion, progress)?;
        let left = gain.left(&by_run);
        let gap = by_run
            .held_out_residuals(|_, run, j| self.design.runs[run].joints[j].residual().collect());
        let Told { found, ruled_out, unseen_friction } = self.told(record, &conclusion);
        let extended = self.finished(conclusion.solution.robot.clone());
        let hypotheses = conclusion.problem.design.groups.len();
        let between = self.between(&extended)?;
        let extended = between.as_ref().map_or(extended, |b| b.robot.clone());
        Ok(Answer {
            failed: conclusion.failed,
            by_run,
            extended,
            found,
            ruled_out,
            unseen_friction,
            hypotheses,
            gain,
            left,
            gap,
            between,
        })
    }

    /// The folds, each with the robot of what was found without it.
    fn held_out(&self, record: &Record, answer: &Answer) -> Vec<HeldOut> {
        let spans = |of: &[usize]| spans(self.design, record.blocks, of);
        let part = |(fold, solved): (&Fold, &Solved)| HeldOut {
            test: spans(&fold.test),
            train: spans(&fold.train),
            extended: self.finished(solved.robot.clone()),
        };
        answer.by_run.folds.iter().zip(&answer.gain.folds).map(part).collect()
    }

    /// What a search over the whole record comes to, of sizes that are decided and constant.
    pub fn conclusion<'b>(
        &self,
        record: &Record<'b>,
        progress: &dyn Progress,
    ) -> Result<Conclusion<'b>, DiagnosisError> {
        let all: Vec<usize> = (0..record.blocks.len()).collect();
        let Searched { problem, model, .. } = self.searched(record, &all)?;
        progress.step();
        let (Settled { model, solution, withheld }, apart) =
            self.contested(record, &problem, model)?;
        progress.step();
        let failed = Failed::default();
        Ok(Conclusion { problem, model, solution, apart, withheld, failed })
    }

    /// What a search on the blocks `of` comes to. It goes on without every effect that does less than
    /// its columns: these explain what the effect does not.
    fn searched<'b>(&self, record: &Record<'b>, of: &[usize]) -> Result<Searched<'b>, LogError> {
        let (mut problem, mut model) = record.search(of);
        loop {
            let solution = solved(self.robot, &self.log, &problem, &model)?;
            let Some(g) = idle(self.robot, &self.log, (&problem, &model), &solution)? else {
                return Ok(Searched { problem, model, solution });
            };
            problem.idle.insert(g);
            model.remove(&g);
            (problem, model) = record.search_on(problem, model);
        }
    }

    /// What predicts held-out efforts better than the description does of a conclusion, and by how
    /// much. A joint of which nothing does keeps its description.
    fn that_predicts<'b>(
        &self,
        record: &Record<'b>,
        by_run: &Problem<'b>,
        mut conclusion: Conclusion<'b>,
        progress: &dyn Progress,
    ) -> Result<(Conclusion<'b>, HeldOutGain), DiagnosisError> {
        progress.stage("testing on held-out data", by_run.folds.len());
        let search = |fold: &Fold| {
            let searched = self.searched(record, &fold.train);
            progress.step();
            searched
        };
        let searched: Vec<Searched> =
            by_run.folds.par_iter().map(search).collect::<Result<_, LogError>>()?;
        let withheld = &conclusion.withheld;
        let gain = |failed: &Failed| -> Result<HeldOutGain, LogError> {
            let named = |searched: &Searched| self.named(searched, withheld, failed);
            let folds = searched.par_iter().map(named).collect::<Result<_, LogError>>()?;
            Ok(HeldOutGain::new(record, by_run, folds))
        };
        let mut failed = Failed::default();
        let mut best = gain(&failed)?;
        while let Some(more) = failed.with_worse_joints(&best.inverse) {
            (best, failed) = (gain(&more)?, more);
        }
        for g in failed.suspects(record.design, &conclusion.model, &best.inverse) {
            let less = failed.without(g);
            let other = gain(&less)?;
            if rise(&other.inverse) < rise(&best.inverse) {
                (best, failed) = (other, less);
            }
        }
        let model = failed.kept(&conclusion.problem, &conclusion.model);
        failed.dropped = conclusion.model.difference(&model).copied().collect();
        if model != conclusion.model {
            let problem = &conclusion.problem;
            conclusion.solution = solved(self.robot, &self.log, problem, &model)?;
        }
        Ok((Conclusion { model, failed, ..conclusion }, best))
    }

    /// What a search came to, without what has no name over the whole record and what failed.
    fn named(
        &self,
        searched: &Searched,
        withheld: &Withheld,
        failed: &Failed,
    ) -> Result<Solved, LogError> {
        let Searched { problem, model, solution } = searched;
        let mut named = failed.kept(problem, model);
        named.retain(|g| !withheld.contains_key(g));
        if named == *model {
            return Ok(solution.clone());
        }
        solved(self.robot, &self.log, problem, &named)
    }

    /// The findings of a conclusion, and what they leave out.
    pub fn told(&self, record: &Record, conclusion: &Conclusion) -> Told {
        let Conclusion { problem, model, solution, apart, withheld, failed } = conclusion;
        let evidence =
            Evidence { selection: &record.selection(problem), model, apart, withheld, failed };
        let first = self.fitted(problem, model, solution);
        let found = solution.tell(&first, |fitted| evidence.findings(fitted));
        let unseen_friction = evidence.unseen_friction();
        Told { found, ruled_out: evidence.ruled_out(), unseen_friction }
    }

    /// What second encoders show, about the robot that the efforts extend.
    fn between(&self, extended: &Robot) -> Result<Option<Between>, DiagnosisError> {
        between(extended, self.nominal, self.settings, (&self.log, self.inadequate))
    }

    /// A robot without the germs of effects that it has not got, and with what was heard.
    fn finished(&self, robot: Robot) -> Robot {
        let mut finished = weeded(robot, self.nominal);
        self.log.tones.iter().for_each(|tone| tone.extend(&mut finished));
        self.log.limits.iter().for_each(|limit| limit.extend(&mut finished));
        finished
    }

    /// A model as it was solved first, about the robot without findings.
    pub fn fitted<'b>(
        &'b self,
        problem: &'b Problem<'b>,
        model: &'b Model,
        solution: &'b Solved,
    ) -> Fitted<'b> {
        let Self { robot: about, nominal, .. } = *self;
        Fitted { problem, model, weights: &solution.weights, about, nominal }
    }
}
