use catalogue::EffectKind;
use effects::{Frame, Hypothesis};
use logs::{LogError, Prepared, PreparedRun, rest_speeds};
use rayon::prelude::*;
use robot::Robot;

use crate::signals::along::Along;
use crate::signals::limit::Limit;
use crate::signals::response::Response;
use crate::signals::tone::Tone;
use crate::thresholds::Thresholds;

/// The logs from which a design is made, with what is known of them already.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Log<'a> {
    pub prepared: &'a Prepared,
    /// Joints that moved.
    pub moved: &'a [bool],
    /// Oscillations of the efforts.
    pub tones: &'a [Tone],
    /// Torque limits; effort beyond them did not become torque.
    pub limits: &'a [Limit],
    /// Effects that are not looked for.
    pub without: &'a [EffectKind],
    /// The signal that a design of these logs explains.
    pub response: Response,
    /// The described robot, where second encoders have shown that its drives differ. Efforts are then compared with
    /// those of this robot, while a design is about another robot.
    pub described: Option<&'a Robot>,
    pub thresholds: &'a Thresholds,
}

impl<'a> Log<'a> {
    /// The efforts of some logs, without tones and limits yet.
    pub fn new(prepared: &'a Prepared, moved: &'a [bool], thresholds: &'a Thresholds) -> Self {
        let (tones, limits, without, response) = (&[], &[], &[], Response::Effort);
        Self { prepared, moved, tones, limits, without, response, described: None, thresholds }
    }

    /// The same logs for a design of the twist between two encoders, which ignores tones and limits of the efforts.
    pub fn of_twist(&self) -> Self {
        Self { tones: &[], limits: &[], response: Response::Twist, described: None, ..*self }
    }

    /// Whether a second encoder shows the link of joint `j`.
    pub fn shows_link(&self, j: usize) -> bool {
        self.prepared.runs.iter().all(|run| run.joints[j].link.is_some())
    }

    /// The joints that a design has rows for.
    pub fn rows(&self) -> Vec<bool> {
        let has = |(j, moved): (usize, &bool)| {
            *moved && (self.response == Response::Effort || self.shows_link(j))
        };
        self.moved.iter().enumerate().map(has).collect()
    }

    /// Whether a design of these logs includes a hypothesis. Two encoders show the effects between motor and link by
    /// themselves, so a design of the efforts leaves these out where there are two.
    pub fn includes(&self, hypothesis: Hypothesis) -> bool {
        let shown = hypothesis.before_the_link().is_some_and(|j| self.shows_link(j));
        let moved = hypothesis.joint().is_none_or(|j| self.moved[j]);
        let wanted = !self.without.contains(&hypothesis.kind);
        wanted
            && moved
            && shown == (self.response == Response::Twist)
            && self.shows_motors(hypothesis)
    }

    /// Whether both joints of shared motors move at once in at least `moving_share` of the samples in which the first moves.
    /// Elsewhere the friction of these motors is that of one joint.
    fn shows_motors(&self, hypothesis: Hypothesis) -> bool {
        let (EffectKind::DifferentialCoupling, Some(j)) = (hypothesis.kind, hypothesis.joint())
        else {
            return true;
        };
        let rest = rest_speeds(self.prepared);
        let speeds = self.prepared.runs.iter().filter_map(|run| {
            let [first, second] = run.joints.get(j..j + 2)? else { return None };
            Some(first.qd.iter().zip(&second.qd))
        });
        let (mut one, mut both) = (0_usize, 0_usize);
        for (_, second) in speeds.flatten().filter(|(first, _)| first.abs() > rest[j]) {
            one += 1;
            both += usize::from(second.abs() > rest[j + 1]);
        }
        both as f64 > self.thresholds.signals.moving_share * one as f64
    }

    /// `robot` evaluated along every run, with its efforts only while its joints move.
    pub fn along(&self, robot: &Robot, frame: &Frame) -> Result<Vec<Along<'a>>, LogError> {
        let evaluate = |run| {
            let along = self.along_run(robot, frame, run)?;
            let along =
                if self.response == Response::Effort { along.while_moving() } else { along };
            Ok(along.with_even_noise().with_tones(self.tones).without_swings())
        };
        self.prepared.runs.par_iter().map(evaluate).collect()
    }

    /// `robot` evaluated along every run, with its efforts also while its joints stand.
    pub fn along_all(&self, robot: &Robot, frame: &Frame) -> Result<Vec<Along<'a>>, LogError> {
        let evaluate =
            |run| Ok(self.along_run(robot, frame, run)?.with_tones(self.tones).without_swings());
        self.prepared.runs.par_iter().map(evaluate).collect()
    }

    fn along_run(
        &self,
        robot: &Robot,
        frame: &Frame,
        run: &'a PreparedRun,
    ) -> Result<Along<'a>, LogError> {
        let cutoff_hz = self.prepared.cutoff_hz;
        Along::new(robot, frame, run, cutoff_hz, self.limits, &self.thresholds.signals)
    }
}
