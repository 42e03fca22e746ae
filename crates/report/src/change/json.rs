use diagnosis::{Comparison, EffectAt, Estimate};
use pages::{Provenance, ReportError, to_json, written_schema};
use schemars::{JsonSchema, Schema};
use serde::Serialize;

use crate::change::page::change_sentence;
use crate::diagnosis::json::{FindingByName, ParameterValue, by_name};

/// Name and version of the schema of `comparison.json`.
const SCHEMA: &str = "plumbline.comparison/1";

/// What changed, as it is written.
#[derive(Serialize, JsonSchema)]
struct Document<'a> {
    schema: &'static str,
    /// Name of the robot.
    robot: &'a str,
    /// What changed, in a sentence.
    sentence: String,
    /// The changes; what is nominal in them is the size before.
    changes: Vec<FindingByName<'a>>,
    /// Sizes of the changed effects in the first logs alone, where these determine them.
    in_first_logs: Vec<SizeByName<'a>>,
    /// Oscillations that both sets show with the same amplitude, which are no change.
    alike: Vec<FindingByName<'a>>,
    /// What the first logs show, held where nothing above is said of it.
    held: Vec<FindingByName<'a>>,
    /// Doubts about the input, each in a sentence.
    warnings: Vec<&'a String>,
    /// Where the two diagnoses come from.
    provenance: Sides<'a>,
}

/// Where the two diagnoses come from.
#[derive(Serialize, JsonSchema)]
struct Sides<'a> {
    /// The first logs, about the given robot.
    before: &'a Provenance,
    /// The other logs, about the robot that the first ones extend.
    after: &'a Provenance,
}

/// The parameters of an effect in the first logs.
#[derive(Serialize, JsonSchema)]
struct SizeByName<'a> {
    #[serde(flatten)]
    at: &'a EffectAt,
    /// Its parameters by name.
    #[serde(serialize_with = "by_name")]
    #[schemars(with = "std::collections::BTreeMap<String, ParameterValue<'static>>")]
    parameters: &'a [Estimate],
}

/// `comparison.json`: what changed from the first logs to the others, in the schema `plumbline.comparison/1`, with the
/// provenance of both.
///
/// A number that is not finite is `null`.
///
/// # Errors
///
/// [`ReportError::Format`].
pub fn change_json(
    comparison: &Comparison,
    [before, after]: [&Provenance; 2],
) -> Result<String, ReportError> {
    let [first, other] = [&comparison.before, &comparison.after].map(|side| &side.diagnosis);
    let sizes = comparison.first.iter();
    let document = Document {
        schema: SCHEMA,
        robot: &other.robot,
        sentence: change_sentence(comparison),
        changes: other.findings.iter().map(FindingByName::new).collect(),
        in_first_logs: sizes
            .map(|size| SizeByName { at: &size.at, parameters: &size.parameters })
            .collect(),
        alike: comparison.alike.iter().map(FindingByName::new).collect(),
        held: first.findings.iter().map(FindingByName::new).collect(),
        warnings: first.warnings.iter().chain(&other.warnings).collect(),
        provenance: Sides { before, after },
    };
    to_json(&document)
}

/// The JSON schema of `comparison.json`.
pub fn change_schema() -> Schema {
    written_schema::<Document<'static>>(SCHEMA, "Plumbline comparison")
}
