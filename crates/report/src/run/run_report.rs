use experiment::Metrics;
use robot::Robot;
use schemars::Schema;

use crate::run::claims::ClaimUnit;
use crate::run::diagnosis_summary::DiagnosisSummary;
use pages::{Provenance, ReportError, with_schema, written_schema};

/// Name and version of the schema of `metrics.json`.
const SCHEMA: &str = "plumbline.run/1";

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

    /// The unit of the joints' positions, and of a thousandth of it.
    pub(crate) fn position_units(&self) -> [&'static str; 2] {
        let links = self.robot.links();
        match links.iter().filter(|link| link.joint.kind.is_rotation()).count() {
            0 => ["m", "mm"],
            all if all == links.len() => ["rad", "mrad"],
            _ => ["rad or m", "mrad or mm"],
        }
    }

    /// What errors of the tracking are, as they are printed.
    pub(crate) fn tracked_unit(&self) -> ClaimUnit {
        ClaimUnit { scale: 1e3, unit: self.position_units()[1] }
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
