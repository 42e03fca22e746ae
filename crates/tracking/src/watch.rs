use std::ops::ControlFlow;

use motion::State;
use robot::Reading;

/// One turn of the loop; signals have one entry a joint.
#[derive(Debug, Clone, Copy)]
pub struct ControlTick<'a> {
    /// Time since the motion began (s): the number of the tick times the period.
    pub time_s: f64,
    /// What the motion asks for.
    pub reference: &'a State,
    /// What the machine reported, with its own time.
    pub reading: &'a Reading,
    /// Where the links are (rad or m), when the machine knows.
    pub link_positions: Option<&'a [f64]>,
    /// What the feedforward asked for, faded where it is not trusted.
    pub feedforward: &'a crate::feedforward::TorquePrediction,
    /// Torque of the feedback (N m or N).
    pub feedback: &'a [f64],
    /// What the machine was told (N m or N).
    pub command: &'a [f64],
    /// Whether the command was brought within the limits.
    pub limited: &'a [bool],
    /// Time since the tick at which the predictor took its reference (s); none while there is
    /// no prediction.
    pub age_s: Option<f64>,
}

/// Something that happened in a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// Time since the motion began (s).
    pub time_s: f64,
    /// Its severity.
    pub level: Level,
    /// What happened and what is done about it.
    pub words: String,
}

/// Severity of an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// As it should be.
    Info,
    /// The run goes on, but not as it was meant to.
    Warning,
    /// The run ends.
    Error,
}

/// Observes a run between its ticks. In wall-clock time it has to be quick.
pub trait TrackingWatch {
    /// A tick is over; [`ControlFlow::Break`] ends the run.
    fn tick(&mut self, tick: &ControlTick) -> ControlFlow<()>;

    /// Something happened.
    fn event(&mut self, event: &Event);
}

/// No observer.
impl TrackingWatch for () {
    fn tick(&mut self, _: &ControlTick) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn event(&mut self, _: &Event) {}
}
