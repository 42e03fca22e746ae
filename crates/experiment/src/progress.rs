/// Hears what a run of a scenario is doing, and may stop it.
pub trait Progress: learner::TrainingProgress {
    /// Something new begins.
    fn begin(&self, what: &str);

    /// A second of motion is simulated.
    fn second(&self);

    /// Whether the run is to end.
    fn is_stopped(&self) -> bool;
}

impl Progress for learner::SilentTraining {
    fn begin(&self, _: &str) {}

    fn second(&self) {}

    fn is_stopped(&self) -> bool {
        false
    }
}
