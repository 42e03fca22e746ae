use std::ops::ControlFlow;

/// Receives the progress of a training, and may end its searches.
pub trait TrainingProgress: Sync {
    /// A new stage, in words.
    fn stage(&self, words: &str);

    /// One more evaluation of the likelihood, and the best value so far. `Break` ends this
    /// search and those that follow, each with the best it has.
    fn evaluation(&self, evaluations: usize, best: f64) -> ControlFlow<()>;
}

/// Ignores the progress, and never ends a search.
#[derive(Debug, Clone, Copy)]
pub struct SilentTraining;

impl TrainingProgress for SilentTraining {
    fn stage(&self, _: &str) {}

    fn evaluation(&self, _: usize, _: f64) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}
