use std::borrow::Cow;

use effects::without_unused_shapes;
use robot::Robot;

use crate::columns::design::Design;
use crate::columns::run_design::JointDesign;
use crate::error::DiagnosisError;
use crate::regression::blocks::{Block, blocks};
use crate::regression::fitted_model::FittedModel;
use crate::regression::gram::Grams;
use crate::regression::linear_fit::LinearFit;
use crate::regression::problem::{HypothesisSet, Problem};
use crate::search::dataset::Dataset;
use crate::search::friction_error::{FrictionError, friction_level};
use crate::settings::Settings;
use crate::signals::log::Log;
use crate::thresholds::Thresholds;

/// The inputs of a diagnosis, after the logs are prepared.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Inputs<'a> {
    /// The robot as it was described.
    pub nominal: &'a Robot,
    /// The same robot with the best trial shapes of effects; the design is about this one.
    pub robot: &'a Robot,
    pub settings: &'a Settings,
    pub log: Log<'a>,
    pub design: &'a Design,
    /// For every joint, the reason why the logs say nothing of it, if there is one.
    pub inadequate: &'a [Option<String>],
}

impl Inputs<'_> {
    pub fn thresholds(&self) -> &Thresholds {
        &self.settings.thresholds
    }

    /// Calls `work` with the logs cut into blocks.
    pub fn with_dataset<T>(&self, work: impl FnOnce(&Dataset) -> T) -> Result<T, DiagnosisError> {
        let blocks = self.blocks()?;
        let grams = Grams::new(self.design, &blocks);
        Ok(work(&self.dataset(&blocks, &grams, &self.least_falls())))
    }

    fn dataset<'a>(
        &'a self,
        blocks: &'a [Block],
        grams: &'a Grams,
        (practical, friction): &'a (Vec<f64>, Vec<FrictionError>),
    ) -> Dataset<'a> {
        let (robot, design, thresholds) = (self.robot, self.design, self.thresholds());
        Dataset { robot, design, blocks, grams, practical, friction, thresholds }
    }

    /// Blocks of at least five autocorrelation times of the residual with all hypotheses in the model.
    fn blocks(&self) -> Result<Vec<Block>, DiagnosisError> {
        let thresholds = &self.thresholds().blocks;
        let rough = blocks(self.design, 1.0, thresholds);
        if rough.len() < thresholds.fewest {
            return Err(DiagnosisError::TooShort { got: rough.len(), expected: thresholds.fewest });
        }
        let grams = Grams::new(self.design, &rough);
        let memory = self.dataset(&rough, &grams, &self.least_falls()).memory();
        Ok(blocks(self.design, memory, thresholds))
    }

    /// What the least falls of each joint's held-out error follow from: the least RMS that counts, and described friction.
    fn least_falls(&self) -> (Vec<f64>, Vec<FrictionError>) {
        let friction = (0..self.design.joints()).map(|j| self.friction_error(j)).collect();
        (self.practical(), friction)
    }

    /// Least fall of each joint's held-out RMS error that counts (N·m or N).
    pub fn practical(&self) -> Vec<f64> {
        let rms = |j: usize| {
            let joints = self.design.runs.iter().map(|run| &run.joints[j]);
            let efforts =
                joints.flat_map(|joint| joint.informative(joint.measured.iter().copied()));
            let (n, sum) = efforts.fold((0, 0.0), |(n, s), e| (n + 1, s + e * e));
            (sum / f64::from(n.max(1))).sqrt()
        };
        (0..self.design.joints()).map(|j| self.settings.practical_share * rms(j)).collect()
    }

    /// What the law of described dry friction may err by at joint `j`.
    pub fn friction_error(&self, j: usize) -> FrictionError {
        let joints = || self.design.runs.iter().map(|run| &run.joints[j]);
        let informative = joints().flat_map(|joint| &joint.is_informative).filter(|t| **t).count();
        let slides = |joint: &JointDesign| {
            joint.is_informative.iter().zip(&joint.slides).filter(|(t, s)| **t && **s).count()
        };
        let sliding: usize = joints().map(slides).sum();
        let level = friction_level(&self.nominal.links()[j].actuator);
        let counts = [informative - sliding, informative];
        FrictionError::new(level, counts, self.thresholds().search.rough_friction)
    }

    /// A robot without the trial shapes of effects that it lacks, and with the tones and limits of the logs.
    pub fn without_trial_shapes(&self, robot: Robot) -> Robot {
        let mut finished = without_unused_shapes(robot, self.nominal);
        let common_phase = self.thresholds().tones.common_phase;
        self.log.tones.iter().for_each(|tone| tone.extend(&mut finished, common_phase));
        self.log.limits.iter().for_each(|limit| limit.extend(&mut finished));
        finished
    }

    /// The first linear fit of a model, about the robot without findings.
    pub fn first_fit<'b>(
        &'b self,
        problem: &'b Problem<'b>,
        model: &'b HypothesisSet,
        fitted: &'b FittedModel,
    ) -> LinearFit<'b> {
        let Self { robot: about, nominal, .. } = *self;
        let problem = Cow::Borrowed(problem);
        LinearFit { problem, model, weights: &fitted.weights, about, nominal }
    }
}
