/// When a motion is near the resonance of a link on the spring of its transmission, and which springs are tried.
#[derive(Debug, Clone, PartialEq)]
pub struct SpringThresholds {
    /// Slowest resonance that is tried, in cut-offs (1): a slower link hardly follows the motion.
    pub slowest: f64,
    /// Fastest resonance that is tried, in cut-offs (1). The cut-off is some five times the band of the motion: below a third
    /// of a resonance the slope by the compliance is at most an eighth off.
    pub fastest: f64,
    /// Ratio of a trial stiffness to the one before (1): the trial response, of a spring of unknown damping, is wider.
    pub stiffness_ratio: f64,
    /// Damping of a trial spring before it is fitted, over the critical one of its link (1): that of the trial response.
    pub damping_ratio: f64,
    /// Least share of what all linear effects leave of a joint's effort (power, 1) that a spring must explain.
    pub least_gain: f64,
    /// The same of what the everyday effects of the joint leave: near its resonance the link makes most of the effort.
    pub least_everyday_gain: f64,
}

impl Default for SpringThresholds {
    fn default() -> Self {
        Self {
            slowest: 0.05,
            fastest: 0.6,
            stiffness_ratio: 1.25,
            damping_ratio: 0.1,
            least_gain: 0.1,
            least_everyday_gain: 0.5,
        }
    }
}
