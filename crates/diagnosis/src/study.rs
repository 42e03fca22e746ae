use effects::weeded;
use logs::LogError;
use robot::Robot;

use crate::between::{Between, between};
use crate::blocks::{Block, FEWEST_BLOCKS, Fold, Folding, blocks};
use crate::contest::Apart;
use crate::design::Design;
use crate::error::DiagnosisError;
use crate::extend::{Solved, solved};
use crate::extent::range;
use crate::findings::{Evidence, Found};
use crate::floor::Floors;
use crate::gain::{HeldOutGain, measured};
use crate::gram::Grams;
use crate::held_out::{HeldOut, spans};
use crate::idle::idle;
use crate::log::Log;
use crate::noise::integrated_time;
use crate::problem::{Model, Problem};
use crate::progress::Progress;
use crate::result::{
    DataSummary, Diagnosis, Finding, Gain, JointReport, RuledOut, SCHEMA, Unexplained, Verdict,
};
use crate::search::Record;
use crate::settings::Settings;
use crate::settled::{Settled, Withheld};
use crate::significance::Significance;
use crate::structure::{Probe, Structure};
use crate::tone_finding::tone_finding;
use crate::traces::{RunTraces, traces};
use crate::uncertainty::Fitted;
use crate::verdict::{Situation, overall};

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
struct Answer<'a> {
    problem: Problem<'a>,
    /// The same problem held out by run.
    by_run: Problem<'a>,
    extended: Robot,
    found: Vec<Found>,
    ruled_out: Vec<RuledOut>,
    /// Number of hypotheses tested.
    hypotheses: usize,
    gain: HeldOutGain,
    /// What is left by what was found without each run, and by nothing, `[joint][run][sample]`.
    left: Vec<Vec<Vec<f64>>>,
    gap: Vec<Vec<Vec<f64>>>,
    /// What second encoders show.
    between: Option<Between>,
}

/// What a search over the whole record came to.
pub(crate) struct Conclusion<'a> {
    pub problem: Problem<'a>,
    pub model: Model,
    pub significance: Significance,
    pub solution: Solved,
    pub apart: Apart,
    pub withheld: Withheld,
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
            let traces = traces(self.design, &answer.left);
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
        let all: Vec<usize> = (0..rough.len()).collect();
        let problem = record.problem(&all);
        let noise = problem.noise(&problem.everything());
        let moved = noise.time.iter().zip(&self.design.moved).filter(|(_, m)| **m);
        let mut times: Vec<f64> = moved.map(|(t, _)| *t).collect();
        times.sort_by(f64::total_cmp);
        Ok(blocks(self.design, times.get(times.len() / 2).copied().unwrap_or(1.0)))
    }

    /// Least fall of each joint's held-out RMS error that counts (N·m or N).
    fn practical(&self) -> Vec<f64> {
        let rms = |j: usize| {
            let efforts = self.design.runs.iter().flat_map(|r| &r.joints[j].measured);
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
        let Conclusion { problem, solution, significance, withheld, .. } = &conclusion;
        let by_run = problem.refolded(Folding::ByRun);
        let search = |of: &[usize]| self.named(self.searched(record, of)?, withheld);
        let gain = HeldOutGain::new(record, &by_run, &search, progress)?;
        let left = gain.left(&by_run);
        let gap = by_run
            .held_out_residuals(|_, run, j| self.design.runs[run].joints[j].residual().collect());
        let (found, ruled_out) = self.told(record, &conclusion);
        let extended = self.finished(solution.robot.clone());
        let hypotheses = significance.count();
        let between = self.between(&extended)?;
        let extended = between.as_ref().map_or(extended, |b| b.robot.clone());
        let Conclusion { problem, .. } = conclusion;
        Ok(Answer {
            problem,
            by_run,
            extended,
            found,
            ruled_out,
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

    /// What a search over the whole record comes to: significant, stable and of a size that is
    /// decided.
    pub fn conclusion<'b>(
        &self,
        record: &Record<'b>,
        progress: &dyn Progress,
    ) -> Result<Conclusion<'b>, DiagnosisError> {
        let all: Vec<usize> = (0..record.blocks.len()).collect();
        let Searched { problem, model, .. } = self.searched(record, &all)?;
        progress.step();
        let (Settled { model, significance, solution, withheld }, apart) =
            self.contested(record, &problem, model)?;
        progress.step();
        Ok(Conclusion { problem, model, significance, solution, apart, withheld })
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

    /// What a search came to, without what has no name over the whole record.
    fn named(&self, searched: Searched, withheld: &Withheld) -> Result<Solved, LogError> {
        let Searched { problem, model, solution } = searched;
        let named: Model = model.iter().copied().filter(|g| !withheld.contains_key(g)).collect();
        if named == model {
            return Ok(solution);
        }
        solved(self.robot, &self.log, &problem, &named)
    }

    /// The findings of a conclusion, and what they leave out.
    pub fn told(&self, record: &Record, conclusion: &Conclusion) -> (Vec<Found>, Vec<RuledOut>) {
        let Conclusion { problem, model, significance, solution, apart, withheld } = conclusion;
        let evidence = Evidence {
            selection: &record.selection(problem),
            model,
            significance,
            apart,
            withheld,
            seed: self.settings.seed,
        };
        let first = self.fitted(problem, model, solution);
        let found = solution.tell(&first, |fitted| evidence.findings(fitted));
        (found, evidence.ruled_out())
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

    /// What is found by the search and by listening, the largest share first.
    fn findings(&self, answer: &Answer) -> Vec<Finding> {
        let heard = self.log.tones.iter().map(|tone| tone_finding(self.nominal, tone));
        let limited = self.log.limits.iter().map(|limit| limit.finding(self.nominal));
        let between = answer.between.iter().flat_map(|b| b.found.clone());
        let found = answer.found.iter().map(|f| f.finding.clone());
        let mut findings: Vec<Finding> = found.chain(between).chain(heard).chain(limited).collect();
        findings.sort_by(|a, b| b.share_explained.total_cmp(&a.share_explained));
        findings
    }

    fn ruled_out(&self, answer: &Answer) -> Vec<RuledOut> {
        let between = answer.between.iter().flat_map(|b| &b.ruled_out);
        answer.ruled_out.iter().chain(between).cloned().collect()
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

    fn report(&self, record: &Record, answer: &Answer) -> Diagnosis {
        let floors = Floors::new(self.design, self.log.prepared);
        let reports: Vec<(JointReport, Structure)> =
            (0..self.design.joints()).map(|j| self.joint(record, answer, &floors, j)).collect();
        let unexplained = reports.iter().filter_map(unexplained).collect();
        let joints: Vec<JointReport> = reports.into_iter().map(|(j, _)| j).collect();
        Diagnosis {
            schema: SCHEMA,
            robot: self.robot.name().to_owned(),
            verdict: overall(&joints.iter().map(|j| j.verdict).collect::<Vec<_>>()),
            joints,
            findings: self.findings(answer),
            unexplained,
            ruled_out: self.ruled_out(answer),
            gain: Gain { inverse: answer.gain.inverse.clone() },
            data: self.data(record, answer),
            warnings: Vec::new(),
        }
    }

    fn joint(
        &self,
        record: &Record,
        answer: &Answer,
        floors: &Floors,
        j: usize,
    ) -> (JointReport, Structure) {
        let problem = &answer.problem;
        let inverse = &answer.gain.inverse;
        let (torque_rms, _) = measured(record, &problem.of, j);
        let tones = self.log.tones.iter().filter(|t| t.joint == j).count();
        let limits = self.log.limits.iter().filter(|l| l.joint == j).count();
        // What a search without a part of the record takes for a cause is none where the search
        // over all of it has dropped it again.
        let is_named = tones + limits > 0 || answer.found.iter().any(|f| f.fall[j].abs() > 0.0);
        let residual = if is_named { answer.left[j].clone() } else { answer.gap[j].clone() };
        let time = integrated_time(&residual);
        let moved = self.design.moved[j];
        let structure = if moved {
            let parts = (record.blocks, answer.by_run.folds.as_slice());
            Probe::new(self.robot, self.design, parts, j).structure(&residual)
        } else {
            Structure { share: 0.0, depends_on: Vec::new() }
        };
        let nominal_rms = inverse.rms_before_nm[j];
        let remaining_rms = if is_named { inverse.rms_after_nm[j] } else { nominal_rms };
        let (floor, source) =
            floors.choose(j, remaining_rms * (1.0 - structure.share).sqrt(), time);
        let lowered = |f: &&Found| f.fall[j] > record.practical[j].powi(2);
        let situation = Situation {
            inadequate: self.inadequate[j].clone(),
            findings: answer.found.iter().filter(lowered).count() + tones + limits,
            between: answer.between.as_ref().map_or(0, |b| b.at(&self.robot.links()[j].joint.name)),
            torque_rms,
            nominal_rms,
            remaining_rms,
            floor,
            structure: structure.share,
        };
        let (verdict, because) = situation.verdict();
        let samples = residual.iter().map(Vec::len).sum::<usize>() as f64;
        let report = JointReport {
            name: self.robot.links()[j].joint.name.clone(),
            verdict,
            because,
            torque_rms_nm: torque_rms,
            residual_rms_nm: nominal_rms,
            remaining_rms_nm: remaining_rms,
            noise_floor_rms_nm: floor,
            noise_floor_from: source,
            autocorrelation_time_s: time / self.design.rate_hz,
            effective_samples: samples / time,
            range: range(self.log.prepared, j),
        };
        (report, Structure { share: situation.unexplained(), ..structure })
    }

    fn data(&self, record: &Record, answer: &Answer) -> DataSummary {
        let samples: usize = self.design.runs.iter().map(|r| r.time.len()).sum();
        DataSummary {
            runs: Vec::new(),
            cutoff_hz: self.log.prepared.cutoff_hz,
            cutoff_reason: self.log.prepared.cutoff_reason.clone(),
            regression_rate_hz: self.design.rate_hz,
            block_s: samples as f64 / record.blocks.len() as f64 / self.design.rate_hz,
            blocks: record.blocks.len(),
            hypotheses: answer.hypotheses + answer.between.as_ref().map_or(0, |b| b.hypotheses),
        }
    }
}

fn unexplained((joint, structure): &(JointReport, Structure)) -> Option<Unexplained> {
    let left = matches!(joint.verdict, Verdict::PartlyExplained | Verdict::Unexplained);
    left.then(|| {
        let ratio = joint.remaining_rms_nm / joint.residual_rms_nm.max(f64::MIN_POSITIVE);
        Unexplained {
            joint: joint.name.clone(),
            share: (structure.share * ratio * ratio).min(1.0),
            depends_on: structure.depends_on.clone(),
        }
    })
}
