/// Who is told how far a diagnosis has come.
pub trait Progress: Sync {
    /// A new stage of so many steps begins.
    fn stage(&self, name: &str, steps: usize);

    /// One step of the stage is done.
    fn step(&self);
}

/// Nobody is told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Silent;

impl Progress for Silent {
    fn stage(&self, _: &str, _: usize) {}

    fn step(&self) {}
}
