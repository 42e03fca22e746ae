/// When the effort beyond a limit counts as moving nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct LimitThresholds {
    /// The lowest quantile of the absolute effort that is tried as a limit (1). A limit below it would clip more than
    /// two fifths of the log.
    pub lowest_quantile: f64,
    /// Share of the largest effort beyond a limit from which on a sample counts as above it (1): less is what the
    /// low-pass spreads.
    pub touched: f64,
    /// Least share of what the other effects leave that a limit must explain (power, 1). Without this and the next two
    /// tests, 19 false findings more in 18 trials.
    pub explained: f64,
    /// Least power of what the other effects lack above a limit, over the power that they leave below it (1).
    pub above_noise: f64,
    /// Least power of what the other effects lack above a limit, over what is left there of the clamped effort (1).
    pub above_clamped: f64,
    /// Rise of the deviance at the ends of the 95 per cent interval of a limit (nats, doubled): the 95 per cent
    /// quantile of chi squared with one degree of freedom.
    pub interval_rise: f64,
}

impl Default for LimitThresholds {
    fn default() -> Self {
        Self {
            lowest_quantile: 0.6,
            touched: 0.01,
            explained: 0.5,
            above_noise: 20.0,
            above_clamped: 20.0,
            interval_rise: 3.84,
        }
    }
}
