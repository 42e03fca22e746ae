use robot::Robot;

use crate::error::DiagnosisError;
use crate::outcome::between::{Between, between};
use crate::outcome::findings::Found;
use crate::outcome::gain::HeldOutGain;
use crate::outcome::held_out::{HeldOut, spans};
use crate::outcome::told::Told;
use crate::progress::Progress;
use crate::regression::blocks::{Fold, Folding};
use crate::regression::problem::Problem;
use crate::regression::solved::Solved;
use crate::result::RuledOut;
use crate::search::failed::Failed;
use crate::search::record::Record;
use crate::search::study::Study;

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

impl Study<'_> {
    /// What the logs say, held out by run.
    pub fn answer<'b>(
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
    pub fn held_out(&self, record: &Record, answer: &Answer) -> Vec<HeldOut> {
        let spans = |of: &[usize]| spans(self.design, record.blocks, of);
        let part = |(fold, solved): (&Fold, &Solved)| HeldOut {
            test: spans(&fold.test),
            train: spans(&fold.train),
            extended: self.finished(solved.robot.clone()),
        };
        answer.by_run.folds.iter().zip(&answer.gain.folds).map(part).collect()
    }

    /// What second encoders show, about the robot that the efforts extend.
    fn between(&self, extended: &Robot) -> Result<Option<Between>, DiagnosisError> {
        between(extended, self.nominal, self.settings, (&self.log, self.inadequate))
    }
}
