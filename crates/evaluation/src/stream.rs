use std::ops::ControlFlow;
use tracking::{Event, Tick, Watch};
use crate::{EvaluationError, FeedforwardKind, Outputs, Progress, TrackedRun, TrackingScenario};
/// x
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {}
/// x
pub struct Stream<'a> { progress: &'a dyn Progress }
impl<'a> Stream<'a> {
    /// x
    pub fn start(_: &TrackingScenario, _: FeedforwardKind, _: Option<&Outputs>, progress: &'a dyn Progress) -> Result<Self, EvaluationError> { Ok(Self { progress }) }
    /// x
    pub fn finish(self, _: &TrackingScenario, _: &TrackedRun) -> Result<Option<Written>, EvaluationError> { Ok(None) }
}
impl Watch for Stream<'_> {
    fn tick(&mut self, _: &Tick) -> ControlFlow<()> { if self.progress.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) } }
    fn event(&mut self, _: &Event) {}
}
