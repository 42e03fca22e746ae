use robot::Robot;

use crate::error::DiagnosisError;
use crate::outcome::finding_builder::FindingWithFall;
use crate::outcome::findings::Findings;
use crate::outcome::gain::HeldOutGain;
use crate::outcome::held_out::{HeldOutPart, spans};
use crate::outcome::second_encoder::{SecondEncoder, compare_encoders};
use crate::outcome::supplement::Supplement;
use crate::progress::DiagnosisProgress;
use crate::regression::blocks::{Fold, Folding};
use crate::regression::fitted_model::FittedModel;
use crate::regression::problem::Problem;
use crate::result::{AlsoFitted, RuledOut};
use crate::search::dataset::Dataset;
use crate::search::inputs::Inputs;
use crate::search::kept_nominal::KeptNominal;

/// The findings of a search over all blocks, and their test on held-out runs.
pub(crate) struct TestedFindings<'a> {
    /// The same problem with runs held out.
    pub by_run: Problem<'a>,
    pub extended: Robot,
    pub found: Vec<FindingWithFall>,
    pub ruled_out: Vec<RuledOut>,
    /// The smallest level of dry friction at every joint that the logs would have shown (N·m or N).
    pub unseen_friction: Vec<f64>,
    /// Number of hypotheses that were looked for.
    pub hypotheses: usize,
    /// The gain of what is written: of the findings, and of what is fitted beside them.
    pub gain: HeldOutGain,
    /// What is fitted beside the findings.
    pub also_fitted: Option<AlsoFitted>,
    pub kept_nominal: KeptNominal,
    /// Held-out residuals of the models found without each run, and residuals of the nominal model,
    /// `[joint][run][sample]`.
    pub left: Vec<Vec<Vec<f64>>>,
    pub gap: Vec<Vec<Vec<f64>>>,
    /// Findings between motors and links, from second encoders.
    pub second_encoder: Option<SecondEncoder>,
}

impl Inputs<'_> {
    /// Finds causes, and tests them on runs held out in turn.
    pub fn test_findings<'b>(
        &self,
        dataset: &Dataset<'b>,
        progress: &dyn DiagnosisProgress,
    ) -> Result<TestedFindings<'b>, DiagnosisError> {
        let causes = self.find_causes(dataset, progress)?;
        let by_run = causes.problem.with_folding(Folding::ByRun);
        let (causes, gain) = self.keep_what_predicts(dataset, &by_run, causes, progress)?;
        let left = gain.held_out_residuals(&by_run);
        let gap = by_run.held_out_residuals(|_, block, j| {
            let all = self.design.runs[block.run].joints[j].residual();
            all.skip(block.samples.start).take(block.samples.len()).collect()
        });
        let Findings { found, ruled_out, unseen_friction } = self.findings(dataset, &causes)?;
        let supplement = match self.settings.only_findings {
            true => None,
            false => self.find_supplement(dataset, &by_run, &causes, &gain)?,
        };
        let also_fitted = supplement.as_ref().map(|s| self.also_fitted(&causes, &gain, s));
        let (gain, fitted) = match supplement {
            Some(Supplement { fitted, gain }) => (gain, fitted),
            None => (gain, causes.fitted.clone()),
        };
        let extended = self.without_trial_shapes(fitted.robot);
        let hypotheses = causes.problem.design.groups.len();
        let second_encoder =
            compare_encoders(&extended, self.nominal, self.settings, &self.log, self.inadequate)?;
        let extended = second_encoder.as_ref().map_or(extended, |found| found.robot.clone());
        Ok(TestedFindings {
            kept_nominal: causes.kept_nominal,
            by_run,
            extended,
            found,
            ruled_out,
            unseen_friction,
            hypotheses,
            gain,
            also_fitted,
            left,
            gap,
            second_encoder,
        })
    }

    /// The folds, each with the robot found without it.
    pub fn held_out_parts(&self, dataset: &Dataset, tested: &TestedFindings) -> Vec<HeldOutPart> {
        let spans = |of: &[usize]| spans(self.design, dataset.blocks, of);
        let part = |(fold, fitted): (&Fold, &FittedModel)| HeldOutPart {
            test: spans(&fold.test),
            train: spans(&fold.train),
            extended: self.without_trial_shapes(fitted.robot.clone()),
        };
        tested.by_run.folds.iter().zip(&tested.gain.folds).map(part).collect()
    }
}
