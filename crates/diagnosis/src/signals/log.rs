use catalogue::EffectKind;
use effects::{Frame, Hypothesis};
use logs::{LogError, Prepared};
use rayon::prelude::*;
use robot::Robot;

use crate::signals::along::Along;
use crate::signals::limit::Limit;
use crate::signals::look::Look;
use crate::signals::tone::Tone;

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
    pub look: Look,
    /// The robot as it was described, where its efforts are not those of the robot that a design
    /// is about: second encoders have shown otherwise.
    pub described: Option<&'a Robot>,
}

impl<'a> Log<'a> {
    /// The efforts of some logs, as they are.
    pub fn new(prepared: &'a Prepared, moved: &'a [bool]) -> Self {
        let (tones, limits, without, look) = (&[], &[], &[], Look::Effort);
        Self { prepared, moved, tones, limits, without, look, described: None }
    }

    /// Whether a second encoder shows the link of joint `j`.
    pub fn shows_link(&self, j: usize) -> bool {
        self.prepared.runs.iter().all(|run| run.joints[j].link.is_some())
    }

    /// The joints whose rows a design has.
    pub fn rows(&self) -> Vec<bool> {
        let has = |(j, moved): (usize, &bool)| {
            *moved && (self.look == Look::Effort || self.shows_link(j))
        };
        self.moved.iter().enumerate().map(has).collect()
    }

    /// Whether a design asks about a hypothesis. Both encoders together say what lies between
    /// them, whatever the effort; then nothing of it is left in the effort.
    pub fn asks(&self, hypothesis: Hypothesis) -> bool {
        let shown = hypothesis.before_the_link().is_some_and(|j| self.shows_link(j));
        let moved = hypothesis.joint().is_none_or(|j| self.moved[j]);
        let wanted = !self.without.contains(&hypothesis.kind);
        wanted && moved && shown == (self.look == Look::Twist)
    }

    /// Evaluates `robot` along every run; its efforts while its joints move.
    pub fn along(&self, robot: &Robot, frame: &Frame) -> Result<Vec<Along<'a>>, LogError> {
        let evaluated = |run| {
            let along = Along::new(robot, frame, run, self.prepared.cutoff_hz, self.limits)?;
            let along = if self.look == Look::Effort { along.while_moving() } else { along };
            along.hearing(self.tones)
        };
        self.prepared.runs.par_iter().map(evaluated).collect()
    }

    /// The same of whole runs.
    pub fn along_all(&self, robot: &Robot, frame: &Frame) -> Result<Vec<Along<'a>>, LogError> {
        let cutoff_hz = self.prepared.cutoff_hz;
        let evaluated =
            |run| Along::new(robot, frame, run, cutoff_hz, self.limits)?.hearing(self.tones);
        self.prepared.runs.par_iter().map(evaluated).collect()
    }
}
