/// When the effort beyond a limit counts as moving nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct LimitThresholds {
    /// Lowest quantile of the absolute effort that is tried as a limit (1). A lower limit would clip more than two
    /// fifths of the log.
    pub lowest_quantile: f64,
    /// Share of the largest effort beyond a limit above which a sample counts as beyond it (1): smaller values come
    /// from the spread of the low-pass.
    pub touched: f64,
    /// Least share of the residual of the other effects that a limit must explain (power, 1). Without this and the
    /// next two tests, 19 false findings more in 18 trials.
    pub explained: f64,
    /// Least power of the residual of the other effects above a limit, over its power below the limit (1).
    pub above_noise: f64,
    /// Least power of the residual of the other effects above a limit, over that of the clamped effort there (1).
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
