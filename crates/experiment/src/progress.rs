/// Receives the progress of a scenario's run, and may stop it.
pub trait Progress: learner::TrainingProgress {
    /// A new step begins.
    fn begin(&self, what: &str);

    /// One more second of motion is simulated.
    fn second(&self);

    /// Whether the run is to stop.
    fn is_stopped(&self) -> bool;
}

impl Progress for learner::SilentTraining {
    fn begin(&self, _: &str) {}

    fn second(&self) {}

    fn is_stopped(&self) -> bool {
        false
    }
}
