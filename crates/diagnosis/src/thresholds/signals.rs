/// Which samples are informative about the effort of a joint, and which runs repeat a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct SignalThresholds {
    /// How far the low-pass carries the effort of a standing joint into the motion beside it, in periods of its
    /// cut-off (1).
    pub filter_reach: f64,
    /// Least share of what the low-pass takes into a sample that comes from a moving joint, for the sample to be
    /// informative (1). With a smaller share the signal falls below the noise: the power of the signal falls with the
    /// square of the share, that of the noise with the share itself.
    pub informative_share: f64,
    /// Least share of a joint's informative samples in which it must slide for them to have a variance of their own (1): of
    /// fewer it is hardly known.
    pub least_sliding: f64,
    /// Least share of a run's samples in which a joint moves, for the run to count as a motion of that joint (1).
    pub moving_share: f64,
    /// Largest RMS difference in position between two runs of one motion, as a share of the range (1).
    pub repeat_difference: f64,
    /// Largest shift in time between two runs of one motion (s).
    pub repeat_shift_s: f64,
    /// Least likeness of the spectra of two runs that move at the same frequencies (1): parts of a motion of one sine a
    /// joint have .988, motions that repeat .96 and more, all others at most .952 (docs/lab/2026-11-29-panel.md).
    pub one_spectrum: f64,
}

impl Default for SignalThresholds {
    fn default() -> Self {
        Self {
            filter_reach: 0.35,
            informative_share: 2.0 / 3.0,
            least_sliding: 0.1,
            moving_share: 0.05,
            repeat_difference: 0.01,
            repeat_shift_s: 1.0,
            one_spectrum: 0.97,
        }
    }
}
