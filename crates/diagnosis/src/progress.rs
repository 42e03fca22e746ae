/// Receives the progress of a diagnosis.
pub trait DiagnosisProgress: Sync {
    /// A stage of so many steps begins.
    fn stage(&self, name: &str, steps: usize);

    /// One step of the stage is done.
    fn step(&self);
}

/// Reports nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Silent;

impl DiagnosisProgress for Silent {
    fn stage(&self, _: &str, _: usize) {}

    fn step(&self) {}
}
