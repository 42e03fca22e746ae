use schemars::JsonSchema;
use serde::Deserialize;

/// The answer to one trial of CauseBench: `TRIAL.json`.
///
/// Whatever is left out counts as nothing said.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Answer to a trial of CauseBench")]
pub struct TrialAnswer {
    /// What the description gets wrong, the surest first; at most 200.
    #[serde(default)]
    #[schemars(length(max = 200))]
    pub names: Vec<NamedCause>,
    /// Whether structure is left that no name explains.
    #[serde(default)]
    pub left_open: bool,
    /// Whether the logs are refused as wrong.
    #[serde(default)]
    pub refused: bool,
    /// A table beside this file (npz, Parquet or CSV) with the columns `time` and `JOINT.effort` (N m or N) for the rows
    /// of the held-out log.
    #[serde(default)]
    pub prediction: Option<String>,
    /// An MJCF beside this file: the arm as it is by this answer. Its joints have the names of the trial.
    #[serde(default)]
    pub model: Option<String>,
    /// Processor time of the answer (s).
    #[serde(default)]
    pub seconds: Option<f64>,
}

/// A cause that an answer names.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NamedCause {
    /// Name or code of the effect: `coulomb_friction` or `FR02`.
    pub effect: String,
    /// The joint, for an effect of a joint.
    #[serde(default)]
    pub joint: Option<String>,
    /// The link, for an effect of a link.
    #[serde(default)]
    pub link: Option<String>,
    /// What it may be as well, at most 4.
    #[serde(default)]
    #[schemars(length(max = 4))]
    pub rivals: Vec<NamedPlace>,
    /// Its sizes.
    #[serde(default)]
    #[schemars(length(max = 20))]
    pub sizes: Vec<NamedSize>,
}

/// An effect of the catalogue and where it acts.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NamedPlace {
    /// Name or code.
    pub effect: String,
    /// The joint, for an effect of a joint.
    #[serde(default)]
    pub joint: Option<String>,
    /// The link, for an effect of a link.
    #[serde(default)]
    pub link: Option<String>,
}

/// A size of a cause, with its 95 per cent interval.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NamedSize {
    /// Name of the parameter in the catalogue, such as `level`.
    pub parameter: String,
    /// Best value of the arm, in the unit of the catalogue.
    pub value: f64,
    /// 95 per cent interval.
    pub interval: [f64; 2],
    /// The value in the description; 0 where it is left out, and 1 for a torque constant and a transmission ratio.
    #[serde(default)]
    pub described: Option<f64>,
}
