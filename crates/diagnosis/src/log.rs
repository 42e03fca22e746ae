use catalogue::EffectKind;
use effects::Frame;
use logs::{LogError, Prepared};
use robot::Robot;

use crate::evaluate::Along;
use crate::limits::Limit;
use crate::tone::Tone;

/// The logs as a design takes them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Log<'a> {
    pub prepared: &'a Prepared,
    /// Joints that moved.
    pub moved: &'a [bool],
    /// What oscillates in the efforts.
    pub tones: &'a [Tone],
    /// Beyond which the efforts became no torque.
    pub limits: &'a [Limit],
    /// Effects that are not looked for.
    pub without: &'a [EffectKind],
}

impl<'a> Log<'a> {
    /// Evaluates `robot` along every run.
    pub fn along(&self, robot: &Robot, frame: &Frame) -> Result<Vec<Along<'a>>, LogError> {
        let runs = self.prepared.runs.iter().enumerate();
        runs.map(|run| {
            Along::new(robot, frame, run, self.prepared.cutoff_hz, (self.tones, self.limits))
        })
        .collect()
    }
}
