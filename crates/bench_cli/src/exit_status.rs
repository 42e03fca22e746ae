/// How a command that ran to its end turned out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BenchExitStatus {
    /// Exit code 0.
    Good,
    /// Trials are left to make, or to make again: exit code 1.
    Gap,
}
