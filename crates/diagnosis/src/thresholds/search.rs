/// Which hypotheses become findings, and which are their rivals.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchThresholds {
    /// Least gain in log evidence for a hypothesis to enter or stay (nats): odds of 20 to 1.
    pub evidence: f64,
    /// The same for an effect that an error elsewhere, or one of many trial shapes, may imitate (nats). With 3
    /// instead of 10, six causes more, two less and ten false findings more in 18 trials.
    pub evidence_of_imitable: f64,
    /// What a change between two sets of logs needs besides (nats): in an arm that was diagnosed before, most effects are as
    /// they were.
    pub evidence_of_change: f64,
    /// Largest lack of log evidence with which a hypothesis still is a rival of another, or is named in its place
    /// because it is simpler (nats): odds of 20 to 1.
    pub rival_evidence: f64,
    /// Least share of a finding's held-out gain that a rival must reach (weighted squares, 1). With 0, 8 per cent more
    /// rivals in 18 trials.
    pub rival_gain: f64,
    /// Number of standard errors, over the blocks, by which a model must do worse than another to be ruled out as a
    /// rival (1). With 3, one cause more and 9 per cent more rivals in 18 trials.
    pub rival_errors: f64,
    /// Least gain in log evidence for which a finding is exchanged for a neighbour (nats): less is rounding, and two
    /// equal hypotheses would replace each other for ever.
    pub exchange_evidence: f64,
    /// Least fall of a joint's held-out error that counts, as a share of its residual (RMS, 1), where that is less
    /// than the practical share. Without it, two joints of the LWR 4 are 8 and 18 per cent worse.
    pub remaining_share: f64,
    /// Error of the law of described dry friction while a joint slides, as a share of its level (1).
    pub rough_friction: f64,
    /// Least share of what a change of a link's inertia explains that a physical inertia must explain (1). With 0, 18
    /// per cent more rivals in 18 trials; with .5 another link takes the place of the right one
    /// (`tests/diagnosis/found.rs`); with .95 joints of the LWR 4 are worse.
    pub kept_by_bodies: f64,
    /// How far the bodies that are fitted beside the findings may be off, in errors of CAD (1): steps of two from a good
    /// description to one whose masses are three times too large. The step with the most evidence is taken for the
    /// whole robot.
    pub body_errors: [f64; 6],
    /// Least fall of a joint's held-out error for which something is fitted beside the findings (share, 1).
    pub supplement_gain: f64,
    /// Largest rise of another joint's held-out error that is accepted for it (share, 1).
    pub supplement_harm: f64,
    /// Number of partners, the most evident first, that are tried with a hypothesis that predicts no better alone.
    pub partners: usize,
    /// Variation (RMS, as a share of the size, 1) beyond which an effect is not the cause. The laws of bodies, gears and
    /// sensors are exact. Without this and the next test, 13 false findings more in 18 trials.
    pub variation: f64,
    /// The same for friction and springs, of which every law is approximate (1). With .5 for both, five causes more,
    /// five less and seven false findings more in 52 trials.
    pub variation_of_rough: f64,
    /// Half the fall of the weighted sum of squares on held-out blocks by which a size must vary (nats).
    pub variation_evidence: f64,
    /// Least information on a weight, in units of that of its prior, that is more than rounding (1): with less, two
    /// hypotheses cannot be told apart.
    pub informed: f64,
}

impl Default for SearchThresholds {
    fn default() -> Self {
        Self {
            evidence: 3.0,
            evidence_of_imitable: 10.0,
            evidence_of_change: 3.0,
            rival_evidence: 3.0,
            rival_gain: 0.5,
            rival_errors: 2.0,
            exchange_evidence: 1.0,
            remaining_share: 0.5,
            rough_friction: 0.15,
            kept_by_bodies: 0.9,
            body_errors: [1.0, 2.0, 4.0, 8.0, 16.0, 32.0],
            supplement_gain: 0.02,
            supplement_harm: 0.02,
            partners: 3,
            variation: 0.25,
            variation_of_rough: 0.7,
            variation_evidence: 3.0,
            informed: 1e-9,
        }
    }
}
