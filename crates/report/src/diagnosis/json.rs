use diagnosis::{
    AlsoFitted, DataSummary, EffectAt, Estimate, Finding, InverseGain, JointReport, Negligible,
    RuledOut, Unexplained, Verdict,
};
use experiment::ForwardGap;
use schemars::{JsonSchema, Schema};
use serde::{Serialize, Serializer};

use crate::diagnosis::input_options::InputOptions;
use crate::diagnosis::report::Report;
use crate::diagnosis::residual::ResidualModel;
use pages::{Provenance, ReportError, to_json, written_schema};

/// `diagnosis.json`: the diagnosis in the schema [`diagnosis::SCHEMA`], with provenance.
///
/// A number that is not finite is `null`.
///
/// # Errors
///
/// [`ReportError::Format`].
pub fn json(report: &Report) -> Result<String, ReportError> {
    let document = Document::new(report);
    to_json(&document)
}

/// The JSON schema of `diagnosis.json`.
pub fn diagnosis_schema() -> Schema {
    written_schema::<Document<'static>>(diagnosis::SCHEMA, "Plumbline diagnosis")
}

/// A diagnosis as it is written: parameters by name, provenance at the end.
#[derive(Serialize, JsonSchema)]
struct Document<'a> {
    schema: &'a str,
    /// Name of the robot.
    robot: &'a str,
    /// The verdict over all joints.
    verdict: Verdict,
    /// One entry a joint, in the order of the robot.
    joints: &'a [JointReport],
    /// Named causes, the largest share first.
    findings: Vec<FindingByName<'a>>,
    /// Causes that the logs show and that are too small to matter.
    negligible: &'a [Negligible],
    /// What is fitted without a name beside the findings, and stands in the extended robot as well.
    #[serde(skip_serializing_if = "Option::is_none")]
    also_fitted: Option<&'a AlsoFitted>,
    /// Structure that no named cause explains.
    unexplained: &'a [Unexplained],
    /// Effects that were tested and not found.
    ruled_out: &'a [RuledOut],
    /// What the extended model buys.
    gain: Gains<'a>,
    /// A learned model of what the findings leave.
    #[serde(skip_serializing_if = "Option::is_none")]
    residual_model: Option<&'a ResidualModel>,
    /// The logs and how they were prepared.
    data: &'a DataSummary,
    /// Doubts about the input, each in a sentence.
    warnings: &'a [String],
    /// How robot and logs were read.
    #[serde(skip_serializing_if = "Option::is_none")]
    input: Option<&'a InputOptions>,
    /// Where the answer comes from.
    provenance: &'a Provenance,
}

/// What the extended model buys: in predicting torque, and in simulating motion.
#[derive(Serialize, JsonSchema)]
struct Gains<'a> {
    /// In predicting torque.
    inverse: &'a InverseGain,
    /// In simulating motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    forward: Option<&'a ForwardGap>,
}

/// A finding as it is written.
#[derive(Serialize, JsonSchema)]
pub(crate) struct FindingByName<'a> {
    #[serde(flatten)]
    at: &'a EffectAt,
    /// Its parameters by name.
    #[serde(serialize_with = "by_name")]
    #[schemars(with = "std::collections::BTreeMap<String, ParameterValue<'static>>")]
    parameters: &'a [Estimate],
    /// Share of the nominal residual's power that the finding explains.
    share_explained: f64,
    /// Log Bayes factor (nats) of the model with the finding against the model without it.
    log_evidence: f64,
    /// Relative fall of the held-out residual's power when the finding is added to the others.
    held_out_gain: f64,
    /// Effects that explain the held-out data as well in its place.
    not_separable_from: &'a [EffectAt],
    /// The motion that would tell it from those.
    #[serde(skip_serializing_if = "Option::is_none")]
    told_apart_by: Option<&'a str>,
    /// Evidence for it, in sentences.
    evidence: &'a [String],
    /// Combinations of its parameters that the logs leave open, in words.
    undetermined: &'a [String],
}

impl<'a> Document<'a> {
    fn new(report: &Report<'a>) -> Self {
        let diagnosis = report.diagnosis;
        Self {
            schema: diagnosis.schema,
            robot: &diagnosis.robot,
            verdict: diagnosis.verdict,
            joints: &diagnosis.joints,
            findings: diagnosis.findings.iter().map(FindingByName::new).collect(),
            negligible: &diagnosis.negligible,
            also_fitted: diagnosis.also_fitted.as_ref(),
            unexplained: &diagnosis.unexplained,
            ruled_out: &diagnosis.ruled_out,
            gain: Gains { inverse: &diagnosis.gain.inverse, forward: report.forward },
            residual_model: report.residual,
            data: &diagnosis.data,
            warnings: &diagnosis.warnings,
            input: report.input,
            provenance: report.provenance,
        }
    }
}

impl<'a> FindingByName<'a> {
    /// A finding with its parameters by name.
    pub(crate) fn new(finding: &'a Finding) -> Self {
        Self {
            at: &finding.at,
            parameters: &finding.parameters,
            share_explained: finding.share_explained,
            log_evidence: finding.log_evidence,
            held_out_gain: finding.held_out_gain,
            not_separable_from: &finding.not_separable_from,
            told_apart_by: finding.told_apart_by,
            evidence: &finding.evidence,
            undetermined: &finding.undetermined,
        }
    }
}

/// What stands under the name of a parameter.
#[derive(Serialize, JsonSchema)]
pub(crate) struct ParameterValue<'a> {
    /// Best value.
    value: f64,
    /// 95 per cent interval, including the uncertainty from unnamed effects.
    ci95: [f64; 2],
    /// 95 per cent interval of noise alone.
    noise95: [f64; 2],
    /// Value in the nominal model.
    nominal: f64,
    /// Unit.
    unit: &'a str,
    /// Whether the logs determine the value.
    determined: bool,
}

/// Parameters under their names.
pub(crate) fn by_name<S: Serializer>(
    parameters: &[Estimate],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_map(parameters.iter().map(|p| {
        let &Estimate { name, value, ci95, noise95, nominal, unit, determined } = p;
        (name, ParameterValue { value, ci95, noise95, nominal, unit, determined })
    }))
}

#[cfg(test)]
mod tests {
    use crate::sample;

    #[test]
    fn parameters_stand_under_their_names_and_not_a_number_is_null() {
        let mut sample = sample::arm();
        sample.diagnosis.findings[0].log_evidence = f64::NAN;
        sample.diagnosis.also_fitted = Some(sample::also_fitted());
        let text = super::json(&sample.report()).unwrap();
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(value["schema"], "plumbline.diagnosis/1");
        let finding = &value["findings"][0];
        assert_eq!(finding["effect"], "coulomb_friction");
        assert_eq!(finding["joint"], "shoulder");
        let codes = [finding, &finding["not_separable_from"][0], &value["ruled_out"][0]];
        assert_eq!(codes.map(|at| &at["code"]), ["FR02", "FR01", "EN02"]);
        assert_eq!(finding["parameters"]["level"]["unit"], "N m");
        assert_eq!(finding["parameters"]["level"]["ci95"][1], 2.2);
        assert!(finding["log_evidence"].is_null());
        let fitted = &value["also_fitted"]["parameters"][0];
        assert!(fitted["code"].is_string() && fitted["value"].is_number(), "{fitted}");
        assert!(value["negligible"].is_array());
        assert!(value["provenance"]["files"][0]["sha256"].is_string());
    }
}
