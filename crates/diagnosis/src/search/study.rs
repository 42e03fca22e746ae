use effects::weeded;
use robot::Robot;

use crate::columns::design::Design;
use crate::error::DiagnosisError;
use crate::regression::blocks::{Block, FEWEST_BLOCKS, blocks};
use crate::regression::fitted::Fitted;
use crate::regression::gram::Grams;
use crate::regression::problem::{Model, Problem};
use crate::regression::solved::Solved;
use crate::search::record::Record;
use crate::settings::Settings;
use crate::signals::log::Log;

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

impl Study<'_> {
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
    pub fn practical(&self) -> Vec<f64> {
        let rms = |j: usize| {
            let joints = self.design.runs.iter().map(|run| &run.joints[j]);
            let efforts = joints.flat_map(|joint| joint.told(joint.measured.iter().copied()));
            let (n, sum) = efforts.fold((0, 0.0), |(n, s), e| (n + 1, s + e * e));
            (sum / f64::from(n.max(1))).sqrt()
        };
        (0..self.design.joints()).map(|j| self.settings.practical_share * rms(j)).collect()
    }

    /// A robot without the germs of effects that it has not got, and with what was heard.
    pub fn finished(&self, robot: Robot) -> Robot {
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
