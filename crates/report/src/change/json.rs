use diagnosis::{Comparison, EffectAt, Estimate};
use pages::{Provenance, ReportError, with_schema};
use serde::Serialize;

use crate::change::page::change_sentence;
use crate::diagnosis::json::{FindingByName, by_name};

/// Name and version of the schema of `comparison.json`.
const SCHEMA: &str = "plumbline.comparison/1";

/// What changed, as it is written.
#[derive(Serialize)]
struct Document<'a> {
    robot: &'a str,
    sentence: String,
    /// The changes; what is nominal in them is the size before.
    changes: Vec<FindingByName<'a>>,
    /// Sizes of the changed effects in the first logs alone, where these determine them.
    in_first_logs: Vec<SizeByName<'a>>,
    /// What both sets show with the same size, which is no change.
    alike: Vec<FindingByName<'a>>,
    /// What the first logs show, held where nothing above is said of it.
    held: Vec<FindingByName<'a>>,
    warnings: Vec<&'a String>,
    provenance: Sides<'a>,
}

/// Where the two diagnoses come from.
#[derive(Serialize)]
struct Sides<'a> {
    before: &'a Provenance,
    after: &'a Provenance,
}

#[derive(Serialize)]
struct SizeByName<'a> {
    #[serde(flatten)]
    at: &'a EffectAt,
    #[serde(serialize_with = "by_name")]
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
    with_schema(SCHEMA, &document)
}
