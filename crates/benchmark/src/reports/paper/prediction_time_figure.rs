use experiment::Claim;
use pages::{BOLD, Medium, ReportError, with_schema};
use report::{ClaimUnit, claim_text, claims_sentence};
use serde::Serialize;

use crate::paper::time_claims::ModelTime;
use crate::reports::paper::page::{Contents, Drawing, page, table};
use crate::reports::times::prediction_times::PredictionTimes;

/// Name and version of the schema of the `metrics.json` of figure 1.
pub const PREDICTION_TIME_FIGURE_SCHEMA: &str = "plumbline.figure_prediction_time/1";

/// Figure 1 of Nguyen-Tuong & Peters 2010, for readers and programs.
#[derive(Debug, Clone, Copy)]
pub struct PredictionTimeFigureReport<'a> {
    /// The times.
    pub times: &'a PredictionTimes,
    /// The judged claims about the times.
    pub claims: &'a [Claim],
}

#[derive(Serialize)]
struct Json<'a> {
    #[serde(flatten)]
    times: &'a PredictionTimes,
    claims: &'a [Claim],
}

impl PredictionTimeFigureReport<'_> {
    /// `metrics.json`, in the schema [`PREDICTION_TIME_FIGURE_SCHEMA`].
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn json(&self) -> Result<String, ReportError> {
        let json = Json { times: self.times, claims: self.claims };
        with_schema(PREDICTION_TIME_FIGURE_SCHEMA, &json)
    }

    /// `report.html`: the claims, the figure and its table in one file that opens offline and without scripts.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn page(&self) -> Result<String, ReportError> {
        let provenance = self.times.provenance.without_folders();
        let times = &PredictionTimes { provenance, ..self.times.clone() };
        let (labels, columns) = times.table();
        let drawing = Drawing {
            title: "Time of one prediction".to_owned(),
            words: format!(
                "Median for all {} joints ({}), against the number of training points. Both axes \
                 are logarithmic.",
                times.joints, times.machine
            ),
            svg: times.draw(Medium::Page)?,
            table: table("Training points (time in µs)", &labels, &columns)?,
        };
        page(Contents {
            kicker: format!("{}: figure 1 of Nguyen-Tuong & Peters 2010", times.robot),
            claims: self.claims,
            quantity: ClaimUnit::MICROSECONDS,
            drawings: vec![drawing],
            remarks: &times.remarks,
            provenance: &times.provenance,
            json: (
                "figure_prediction_time",
                PredictionTimeFigureReport { times, claims: self.claims }.json()?,
            ),
        })
    }

    /// The claims and the table as text for a terminal of 100 columns.
    pub fn text(&self) -> String {
        format!(
            "{BOLD}{}.{BOLD:#}\n\n{}\n{}",
            claims_sentence(self.claims),
            claim_text(self.claims, ClaimUnit::MICROSECONDS),
            self.times.text()
        )
    }
}

impl PredictionTimes {
    /// The times one by one.
    pub fn each(&self) -> Vec<ModelTime> {
        let curves = self.curves.iter().flat_map(|curve| {
            curve.points.iter().map(|point| ModelTime {
                model: curve.name.clone(),
                points: point.n,
                microseconds: point.microseconds,
            })
        });
        curves.collect()
    }
}

#[cfg(test)]
mod tests {
    use crate::paper::time_claims::time_claims;
    use experiment::ClaimVerdict;

    use super::*;
    use crate::reports::sample;
    use pages::without_escapes;

    #[test]
    fn claims_are_judged_by_the_curves_and_told_above_the_table() {
        let times = sample::times();
        assert_eq!(times.each().len(), 5);
        let claims = time_claims(&times.each(), "scikit-learn");
        assert_eq!(claims[0].verdict, ClaimVerdict::Holds);
        assert_eq!(claims[1].verdict, ClaimVerdict::NotJudged, "no gp-rbd");
        let report = PredictionTimeFigureReport { times: &times, claims: &claims };
        let text = without_escapes(&report.text());
        assert!(
            text.contains("holds: rigid bodies alone predict fastest (in all of 3 cases"),
            "{text}"
        );
        assert!(text.contains("\n   100  1.10    3.20           830\n"), "{text}");
        let page = report.page().unwrap();
        assert!(page.contains("not judged") && page.contains("Training points (time in µs)"));
        assert!(page.matches("<svg").count() == 1 && !page.contains("http://"));
        let value: serde_json::Value = serde_json::from_str(&report.json().unwrap()).unwrap();
        assert_eq!(value["schema"], "plumbline.figure_prediction_time/1");
        assert_eq!(value["curves"][1]["points"][0]["n"], 100);
        assert_eq!(value["claims"][1]["verdict"], "not_judged");
    }
}
