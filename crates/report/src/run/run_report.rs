use experiment::Metrics;
use robot::Robot;
use schemars::Schema;

use crate::run::claims::ClaimUnit;
use crate::run::diagnosis_summary::DiagnosisSummary;
use pages::{Provenance, ReportError, with_schema, written_schema};

/// Name and version of the schema of `metrics.json`.
const SCHEMA: &str = "plumbline.run/1";

/// Thousandths in one: mrad a radian, mm a metre.
pub(crate) const THOUSANDTHS: f64 = 1e3;

/// Everything that the report of a run shows.
#[derive(Debug, Clone, Copy)]
pub struct RunReport<'a> {
    /// The numbers.
    pub metrics: &'a Metrics,
    /// The robot as described, for units.
    pub robot: &'a Robot,
    /// The diagnosis.
    pub diagnosis: &'a DiagnosisSummary,
    /// The beginning of the motion that was tracked, drawn for a page.
    pub motion: &'a str,
    /// Commands for what to do next, each with what it does.
    pub next: &'a [[String; 2]],
    /// Where the answer comes from.
    pub provenance: &'a Provenance,
}

impl RunReport<'_> {
    /// The JSON schema of `metrics.json`.
    pub fn schema() -> Schema {
        written_schema::<Metrics>(SCHEMA, "Plumbline run")
    }

    /// The unit in which drifts and errors of the joints' positions are told: a thousandth of that of the positions.
    pub(crate) fn position_unit(&self) -> &'static str {
        let links = self.robot.links();
        match links.iter().filter(|link| link.joint.kind.is_rotation()).count() {
            0 => "mm",
            all if all == links.len() => "mrad",
            _ => "mrad or mm",
        }
    }

    /// What errors of the tracking are, as they are printed.
    pub(crate) fn tracked_unit(&self) -> ClaimUnit {
        ClaimUnit { scale: THOUSANDTHS, unit: self.position_unit() }
    }

    /// `metrics.json`, in the schema `plumbline.run/1`.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn json(&self) -> Result<String, ReportError> {
        with_schema(SCHEMA, self.metrics)
    }
}
