/// How a command that ran to its end turned out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExitStatus {
    /// Exit code 0.
    Good,
    /// A gap is left or an inertia is impossible: exit code 1.
    Gap,
}

impl ExitStatus {
    /// The code that the process ends with.
    pub fn code(self) -> u8 {
        match self {
            Self::Good => 0,
            Self::Gap => 1,
        }
    }
}
