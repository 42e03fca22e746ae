/// What the logs must have to be used: joints that move, runs that are long enough, second encoders that follow.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadinessThresholds {
    /// Range of motion up to which a joint counts as unmoved, as a share of the span of its limits or of a full turn
    /// (1): .126 rad for a joint that turns freely.
    pub unmoved_range: f64,
    /// The same where the encoder is fine (1): .025 rad for a joint that turns freely.
    pub least_range: f64,
    /// Least share of what the joint that moves most moves, each over its full range, that is no shaking of a joint which is held
    /// (1).
    pub held_range: f64,
    /// Steps of the encoder, or deviations of its noise in the band of the diagnosis, that a fine encoder has over the range
    /// of motion (1).
    pub encoder_steps: f64,
    /// Share of a limit above which an effort counts as at the limit (1): noise takes it to either side.
    pub at_limit_from: f64,
    /// Least share of the samples at a limit that is worth a warning (1): less happens at a start or a stop.
    pub at_limit_share: f64,
    /// Largest relative difference between the motion of a link and that of its motor (1). Gear ratios are off by a
    /// few per cent; a second encoder that differs by more measures something else.
    pub second_encoder_mismatch: f64,
    /// Fewest samples of a run that is kept once its spoilt seconds are cut out.
    pub fewest_run_samples: usize,
}

impl Default for ReadinessThresholds {
    fn default() -> Self {
        Self {
            unmoved_range: 0.02,
            least_range: 0.004,
            held_range: 0.1,
            encoder_steps: 200.0,
            at_limit_from: 0.95,
            at_limit_share: 0.01,
            second_encoder_mismatch: 0.2,
            fewest_run_samples: 100,
        }
    }
}
