/// Which of an arm's logs a motion is for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LogPlan {
    /// Number of the log.
    pub log: usize,
    /// Logs in all.
    pub logs: usize,
    /// Length of the log (s).
    pub length_s: f64,
}
