use crate::search::constancy::Variation;

/// Why a change of a model is refused, with the numbers that decided. Groups and joints are indices.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Refusal {
    /// The logs hold no information on it beyond its prior.
    NotShown,
    /// Another hypothesis of the model changes the same numbers by another name.
    OtherName { of: usize },
    /// It raises the log evidence by too little (nats). Without `taken_by`, a hypothesis of the model, it would raise it
    /// by enough.
    TooLittleEvidence { gain: f64, least: f64, taken_by: Option<usize> },
    /// It raises the log evidence by too little beyond its simpler rivals, or for an effect of so few arms (nats).
    AddsTooLittle { gain: f64, least: f64 },
    /// Its most likely size is physically impossible: the first weight that is not zero, by its index in the group;
    /// `None` where a bound holds all of them at zero.
    NotPhysical { weight: Option<(usize, f64)> },
    /// Physical bodies explain only the share `kept` of what the free parameters of a link explain.
    NoBody { kept: f64, least: f64 },
    /// It lowers the held-out error at joint `at` by too little (RMS, N·m or N). Without a joint: the weighted sum of
    /// squares of all joints.
    NoBetterPrediction { at: Option<usize>, by: f64, least: f64 },
    /// The 95 per cent interval of its one parameter contains the described value.
    MayBeDescribed { parameter: &'static str, described: f64, ci95: [f64; 2], unit: &'static str },
    /// The 95 per cent region of its weights contains no change: `chi2` is less than `limit`.
    MayBeNone { chi2: f64, limit: f64 },
    /// Its size would have to vary.
    Varies(Variation),
    /// About the robot that has it, it does worse than its twin, by so many standard errors.
    WorseThanTwin { twin: usize, errors: f64, most: f64 },
    /// At joint `at` a fit predicts held-out efforts worse than the description does (RMS, N·m or N).
    KeepsDescription { at: usize, described: f64, fitted: f64 },
}
