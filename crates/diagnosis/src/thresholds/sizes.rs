/// How well a size is known, and which size the logs would have shown.
#[derive(Debug, Clone, PartialEq)]
pub struct SizeThresholds {
    /// Quantile of Student's t at the upper end of a two-sided 95 per cent interval (1).
    pub interval_quantile: f64,
    /// Probability of the region of several weights inside which a change may be zero (1).
    pub region: f64,
    /// Share of an interval by which its ends may be off, and of a value below which nothing changes it (1): rounding.
    pub rounding: f64,
    /// Standard deviation of a number, over that of its prior, below which the logs determine it (1).
    pub determined: f64,
    /// Standard errors at which an effect would be found in four cases of five by a test at level 0.005, two-sided (1):
    /// 2.81 + 0.84. With 2.84, no finding changed in 18 trials.
    pub detected: f64,
    /// Level of a form of dry friction over the Coulomb level, below which it does not matter (1).
    pub missed_form: f64,
    /// Weight of the divergence from the described inertias, in units of the log-likelihood (1): a pseudo-inertia that
    /// differs by its own size counts like one standard deviation.
    pub inertia_prior: f64,
    /// Thickness along every axis of the body from which a payload is measured, as a share of its distance from the origin
    /// of the link that holds it (1): that of a compact tool.
    pub held_thickness: f64,
    /// Least standard deviation of a direction of the inertial parameters, in those of its prior (1): a thousandth of
    /// the prior is sharper than any model of rigid bodies is true.
    pub sharpest_inertia: f64,
}

impl Default for SizeThresholds {
    fn default() -> Self {
        Self {
            interval_quantile: 0.975,
            region: 0.95,
            rounding: 1e-9,
            determined: 0.5,
            detected: 3.65,
            missed_form: 0.5,
            inertia_prior: 1.0,
            held_thickness: 0.03,
            sharpest_inertia: 1e-3,
        }
    }
}
