use catalogue::EffectKind;
use effects::RevealedBy;
use schemars::JsonSchema;
use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};

/// The schema that `diagnosis.json` follows.
pub const SCHEMA: &str = "plumbline.diagnosis/1";

/// How well the model explains the logs, per joint and overall.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The nominal model explains the log down to its noise floor.
    Consistent,
    /// Named effects bring the residual down to the noise floor.
    Explained,
    /// Named effects explain a part, and structure without a name remains.
    PartlyExplained,
    /// Structure remains, and the logs support no named effect.
    Unexplained,
    /// The logs say too little of the joint.
    DataInadequate,
}

impl Verdict {
    /// The verdict in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Consistent => "consistent",
            Self::Explained => "explained",
            Self::PartlyExplained => "partly explained",
            Self::Unexplained => "unexplained",
            Self::DataInadequate => "data inadequate",
        }
    }

    /// The verdict on logs that were corrected. Only those who recorded the logs can confirm the correction, so no
    /// joint is closed.
    pub(crate) fn of_corrected_logs(self) -> Self {
        match self {
            Self::Consistent | Self::Explained => Self::PartlyExplained,
            open => open,
        }
    }
}

/// The errors of a model in some logs, and their causes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Diagnosis {
    /// Always [`SCHEMA`].
    pub schema: &'static str,
    /// Name of the robot.
    pub robot: String,
    /// The verdict over all joints.
    pub verdict: Verdict,
    /// One entry a joint, in the order of the robot.
    pub joints: Vec<JointReport>,
    /// Named causes, the largest share first.
    pub findings: Vec<Finding>,
    /// Causes that the logs show but that are too small to matter: below the practical size at every joint.
    pub negligible: Vec<Negligible>,
    /// Structure that no named cause explains.
    pub unexplained: Vec<Unexplained>,
    /// What is fitted beside the findings, where the robot with it predicts better.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub also_fitted: Option<AlsoFitted>,
    /// Effects that were tested and not found.
    pub ruled_out: Vec<RuledOut>,
    /// The fall of the prediction error on held-out data.
    pub gain: Gain,
    /// The logs and how they were prepared.
    pub data: DataSummary,
    /// Doubts about the input, each in a sentence.
    pub warnings: Vec<String>,
}

/// One joint.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct JointReport {
    /// Name of the joint.
    pub name: String,
    /// The verdict for this joint.
    pub verdict: Verdict,
    /// The reason for the verdict, in a sentence.
    pub because: String,
    /// RMS of the measured effort in the band of the diagnosis (N m or N). This and the next two are of samples in
    /// which the joint moves: in a long stand, dry friction holds it with any part of its level.
    pub torque_rms_nm: f64,
    /// RMS of measured minus nominal effort.
    pub residual_rms_nm: f64,
    /// RMS of measured minus extended effort, on held-out data.
    pub remaining_rms_nm: f64,
    /// RMS of the noise in the band of the diagnosis, from sources other than the residual.
    pub noise_floor_rms_nm: f64,
    /// Where most of the noise comes from.
    pub noise_floor_from: NoiseFloorSource,
    /// Whether what is left is within the noise, and that so large a share of the effort that a cause may hide in it: such
    /// a joint is open though no structure is seen in it.
    #[serde(default)]
    pub is_lost_in_noise: bool,
    /// Noise and residual over frequency.
    pub spectrum: NoiseSpectrum,
    /// Integrated autocorrelation time of the remaining residual (s).
    pub autocorrelation_time_s: f64,
    /// Number of independent samples that the logs are equivalent to.
    pub effective_samples: f64,
    /// Range of motion in the logs (rad or m).
    pub range: f64,
}

/// How the noise floor was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum NoiseFloorSource {
    /// Difference between runs that repeat a motion.
    Repeats,
    /// The effort's own noise, above the motion or of its step.
    Effort,
    /// The noise of the encoders, carried to torque by the inertia of the arm.
    Encoders,
    /// No source of noise is known.
    Unknown,
}

impl NoiseFloorSource {
    /// The source of the noise in words, to follow a number of N m.
    pub fn words(self) -> &'static str {
        match self {
            Self::Repeats => "of what differs between runs of one motion",
            Self::Effort => "of the effort's own noise",
            Self::Encoders => "of the encoders' noise, carried by the arm's inertia",
            Self::Unknown => "of which the logs tell nothing",
        }
    }
}

/// Residual effort of a joint and its noise over frequency, after the low-pass.
#[derive(Debug, Clone, Default, PartialEq, Serialize, JsonSchema)]
pub struct NoiseSpectrum {
    /// Frequencies (Hz).
    pub hz: Vec<f64>,
    /// One-sided density of the noise whose source is known ((N m)²/Hz or N²/Hz).
    pub noise_nm2_per_hz: Vec<f64>,
    /// One-sided density of the residual effort on held-out data ((N m)²/Hz or N²/Hz).
    pub left_nm2_per_hz: Vec<f64>,
}

/// A number with its uncertainty.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Estimate {
    /// Name of the parameter, as in the catalogue.
    pub name: &'static str,
    /// Best value.
    pub value: f64,
    /// 95 per cent interval, including the uncertainty from unnamed effects.
    pub ci95: [f64; 2],
    /// 95 per cent interval of noise alone. It suits a change between two logs of one arm, which have the same
    /// unnamed effects.
    pub noise95: [f64; 2],
    /// Value in the nominal model.
    pub nominal: f64,
    /// Unit.
    pub unit: &'static str,
    /// Whether the logs determine the value; if not, it is that of the prior.
    pub determined: bool,
}

/// An effect and where it acts.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct EffectAt {
    /// The effect; in JSON its name as `effect`, its code as `code`.
    #[serde(flatten, serialize_with = "code_and_name")]
    #[schemars(with = "CodeAndName")]
    pub effect: EffectKind,
    /// The joint, for an effect of a joint.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// The link, for an effect of a link.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub link: Option<String>,
}

impl EffectAt {
    /// The effect and its place in words, such as `FR01 viscous friction at elbow`.
    pub fn words(&self) -> String {
        match self.joint.as_ref().or(self.link.as_ref()) {
            Some(place) => format!("{} at {place}", self.effect.label()),
            None => self.effect.label(),
        }
    }
}

/// The keys of an effect in JSON.
#[derive(JsonSchema)]
#[expect(dead_code, reason = "its keys are those that code_and_name writes")]
struct CodeAndName {
    /// Code of the effect, such as `FR01`.
    code: String,
    /// Name of the effect.
    effect: EffectKind,
}

fn code_and_name<S: Serializer>(effect: &EffectKind, serializer: S) -> Result<S::Ok, S::Error> {
    let mut fields = serializer.serialize_struct("Effect", 2)?;
    fields.serialize_field("code", effect.code())?;
    fields.serialize_field("effect", effect)?;
    fields.end()
}

/// A named cause.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Finding {
    /// The effect and its place.
    #[serde(flatten)]
    pub at: EffectAt,
    /// Its parameters.
    pub parameters: Vec<Estimate>,
    /// Share of the nominal residual's power that the finding explains, over the joints it acts on.
    pub share_explained: f64,
    /// Log Bayes factor (nats) of the model with the finding against the model without it.
    pub log_evidence: f64,
    /// Relative fall of the held-out residual's power when the finding is added to the others.
    pub held_out_gain: f64,
    /// Effects that explain the held-out data as well in place of the finding.
    pub not_separable_from: Vec<EffectAt>,
    /// The motion that would separate them, if there are rivals.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub told_apart_by: Option<&'static str>,
    /// Evidence for the finding, in sentences.
    pub evidence: Vec<String>,
    /// Combinations of its parameters that the logs leave open, in words.
    pub undetermined: Vec<String>,
}

impl Finding {
    /// The rivals in words, in two lists: other causes, and forms of the same dry friction that differ only where the
    /// logs have no motion, such as `FR04 Stribeck friction near rest`.
    pub fn rivals(&self) -> (Vec<String>, Vec<String>) {
        let shows = |r: &EffectAt| {
            let (of, shows) = effects::model(r.effect).ok()?.traits().form_of()?;
            (of == self.at.effect && r.joint == self.at.joint).then_some(shows)
        };
        let all = self.not_separable_from.iter();
        let (forms, others): (Vec<_>, Vec<_>) = all.partition(|r| shows(r).is_some());
        let is_near_rest = |r: &&EffectAt| shows(r) == Some(RevealedBy::NearRest);
        let (at_rest, elsewhere): (Vec<_>, Vec<_>) = forms.into_iter().partition(is_near_rest);
        let words = |forms: Vec<&EffectAt>, place: &str| {
            let labels: Vec<String> = forms.iter().map(|r| r.effect.label()).collect();
            (!labels.is_empty()).then(|| format!("{} {place}", labels.join(" or ")))
        };
        let forms = [words(at_rest, "near rest"), words(elsewhere, "at other positions")];
        let (parts, others): (Vec<_>, Vec<_>) =
            others.into_iter().partition(|r| self.is_part_of(r));
        let parts: Vec<String> = parts.into_iter().map(EffectAt::words).collect();
        let together = (!parts.is_empty()).then(|| parts.join(" with "));
        (
            together.into_iter().chain(others.into_iter().map(EffectAt::words)).collect(),
            forms.into_iter().flatten().collect(),
        )
    }

    /// Whether a rival explains as much only in combination with another: Coulomb friction with an offset explains as
    /// much as asymmetric friction.
    fn is_part_of(&self, rival: &EffectAt) -> bool {
        let parts = effects::model(self.at.effect).map_or(&[] as &[_], |m| m.traits().together());
        parts.contains(&rival.effect) && rival.joint == self.at.joint
    }
}

/// A cause that the logs show but that is too small to be a finding.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Negligible {
    /// The effect and its place.
    #[serde(flatten)]
    pub at: EffectAt,
    /// The joint at which it matters most.
    pub most_at: String,
    /// Root of the fall of the held-out mean square there (N m or N).
    pub rms_nm: f64,
    /// The value below which that fall does not matter there (N m or N).
    pub least_nm: f64,
}

/// Structure left at a joint.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Unexplained {
    /// Name of the joint.
    pub joint: String,
    /// Share of the nominal residual's power that is unnamed structure.
    pub share: f64,
    /// The signals that the structure follows, the strongest first.
    pub depends_on: Vec<Dependence>,
}

/// How much of a residual follows one signal.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Dependence {
    /// The signal, such as `position of elbow`.
    pub signal: String,
    /// Share of the residual's power that the signal predicts on held-out data.
    pub share: f64,
}

/// Changes of everyday effects and of bodies that the extended robot has beside the findings.
///
/// The logs show none of them by itself. Where every number of a description is off by a little, all together predict
/// better.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct AlsoFitted {
    /// The changed parameters.
    pub parameters: Vec<FittedParameter>,
    /// RMS error on held-out data with the findings alone, per joint (N m or N); with everything it is
    /// [`InverseGain::rms_after_nm`].
    pub rms_named_nm: Vec<f64>,
}

/// A parameter that is fitted beside the findings.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FittedParameter {
    /// The effect and its place.
    #[serde(flatten)]
    pub at: EffectAt,
    /// Name of the parameter, as in the catalogue.
    pub name: &'static str,
    /// Value in the extended robot.
    pub value: f64,
    /// Value in the robot with the findings alone.
    pub before: f64,
    /// Unit.
    pub unit: &'static str,
}

/// An effect that was looked for and not found.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RuledOut {
    /// The effect and its place.
    #[serde(flatten)]
    pub at: EffectAt,
    /// The parameter that `smallest_detectable` speaks of.
    pub parameter: &'static str,
    /// The smallest size that the logs would have shown. For a stiffness it is the largest value, for a breakaway
    /// level the excess over the Coulomb level. `None` when these logs cannot show any size.
    pub smallest_detectable: Option<f64>,
    /// Its unit.
    pub unit: &'static str,
    /// Why the effect is not a finding.
    pub because: String,
}

/// How much better the extended model predicts.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Gain {
    /// Gain in predicting torque.
    pub inverse: InverseGain,
}

/// Torque prediction on data that neither selection nor fit has seen, per joint.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct InverseGain {
    /// Mean squared error over the variance of the effort, nominal model.
    pub nmse_before: Vec<f64>,
    /// The same, extended model.
    pub nmse_after: Vec<f64>,
    /// RMS error, nominal model (N m or N).
    pub rms_before_nm: Vec<f64>,
    /// RMS error, extended model (N m or N).
    pub rms_after_nm: Vec<f64>,
    /// Which runs or blocks were held out.
    pub held_out: String,
    /// The same values fold by fold.
    pub folds: Vec<FoldGain>,
}

/// Torque prediction on one held-out part, per joint.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FoldGain {
    /// The held-out run or block.
    pub name: String,
    /// RMS of the measured effort (N m or N).
    pub torque_rms_nm: Vec<f64>,
    /// RMS error, nominal model.
    pub rms_before_nm: Vec<f64>,
    /// RMS error, model selected and fitted on the other parts.
    pub rms_after_nm: Vec<f64>,
}

/// The logs and how they were prepared.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DataSummary {
    /// One entry a run.
    pub runs: Vec<RunSummary>,
    /// Whether the logs were corrected first; a warning says how.
    pub put_right: bool,
    /// Cut-off of the low-pass filter (Hz).
    pub cutoff_hz: f64,
    /// Why this cut-off.
    pub cutoff_reason: String,
    /// Rate of the samples that the regressions use (Hz).
    pub regression_rate_hz: f64,
    /// Length of a block, the unit of replication (s).
    pub block_s: f64,
    /// Number of blocks.
    pub blocks: usize,
    /// Number of hypotheses that were looked for.
    pub hypotheses: usize,
}

/// One run.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RunSummary {
    /// Name of the run.
    pub name: String,
    /// SHA-256 of the file.
    pub sha256: String,
    /// Number of samples in the file.
    pub samples: usize,
    /// Duration (s).
    pub duration_s: f64,
    /// Sampling rate (Hz).
    pub rate_hz: f64,
}
