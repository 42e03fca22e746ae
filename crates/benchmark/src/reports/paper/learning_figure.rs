use experiment::Claim;
use pages::{
    BOLD, GridColumn, Medium, Provenance, ReportError, push_entry, text_grid, with_schema,
};
use report::{ClaimUnit, claim_text, claims_sentence};
use serde::Serialize;

use crate::paper::learning_errors::LearningErrors;
use crate::reports::paper::error_tables::{ErrorTable, worse_than_named};
use crate::reports::paper::page::{Contents, Drawing, page, table};

/// Name and version of the schema of the `metrics.json` of figure 2.
pub const LEARNING_FIGURE_SCHEMA: &str = "plumbline.figure_learning/1";

/// Figure 2 of Nguyen-Tuong & Peters 2010, for readers and programs.
#[derive(Debug, Clone, Copy)]
pub struct LearningFigureReport<'a> {
    /// The errors.
    pub errors: &'a LearningErrors,
    /// The judged claims about the errors.
    pub claims: &'a [Claim],
    /// The motion outside, in a sentence.
    pub outside: &'a str,
    /// Program, command and inputs behind the results.
    pub provenance: &'a Provenance,
}

#[derive(Serialize)]
struct Json<'a> {
    #[serde(flatten)]
    errors: &'a LearningErrors,
    claims: &'a [Claim],
}

impl LearningFigureReport<'_> {
    /// `metrics.json`, in the schema [`LEARNING_FIGURE_SCHEMA`].
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn json(&self) -> Result<String, ReportError> {
        with_schema(LEARNING_FIGURE_SCHEMA, &Json { errors: self.errors, claims: self.claims })
    }

    /// The figures that stand alone, by the names of their files.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn figures(&self) -> Result<[(&'static str, String); 3], ReportError> {
        let [simulated, real, outside] = self.tables();
        Ok([
            ("figure2b_simulated.svg", simulated.dots(Medium::Alone)?),
            ("figure2c_real.svg", real.dots(Medium::Alone)?),
            ("outside.svg", outside.dots(Medium::Alone)?),
        ])
    }

    /// `report.html`: the claims, the three figures and their tables in one file that opens offline and without
    /// scripts.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn page(&self) -> Result<String, ReportError> {
        let drawings = self.tables().into_iter().zip(self.more()).map(|(errors, more)| {
            Ok(Drawing {
                svg: errors.dots(Medium::Page)?,
                table: table("nMSE", errors.joints, &errors.columns(more))?,
                title: errors.title,
                words: format!("{}.", errors.words),
            })
        });
        page(Contents {
            kicker: format!("{}: figure 2 of Nguyen-Tuong & Peters 2010", self.errors.robot),
            claims: self.claims,
            quantity: ClaimUnit::NMSE,
            drawings: drawings.collect::<Result<_, ReportError>>()?,
            remarks: &[],
            provenance: self.provenance,
            json: ("figure_learning", self.json()?),
        })
    }

    /// The tables and the claims as text for a terminal of 100 columns.
    pub fn text(&self) -> String {
        let mut out = format!("{BOLD}{}.{BOLD:#}\n\n", claims_sentence(self.claims));
        out.push_str(&claim_text(self.claims, ClaimUnit::NMSE));
        for (errors, more) in self.tables().into_iter().zip(self.more()) {
            out.push_str(&format!("\n{BOLD}{}{BOLD:#}\n", errors.title));
            out.push_str(&text_grid("nMSE", errors.joints, &errors.columns(more)));
        }
        out.push('\n');
        push_entry(
            &mut out,
            "nMSE",
            "mean square error over the variance of the torque, on held-out runs",
        );
        push_entry(&mut out, "*", "the least error at the joint");
        push_entry(
            &mut out,
            "best gp / named",
            "least error of a Gaussian process over that of named",
        );
        out
    }

    /// The errors, one table a data set.
    fn tables(&self) -> [ErrorTable<'_>; 3] {
        let errors = self.errors;
        let counts = format!(
            "trained on {} points, tested on {} of another run",
            errors.points, errors.test_points
        );
        let of = |title: &str, words: String, models| ErrorTable {
            title: title.to_owned(),
            words,
            joints: &errors.joints,
            models,
        };
        [
            of("Simulated data, which rigid bodies describe", counts.clone(), &errors.simulated),
            of("\"Real\" data, of the arm with its effects", counts, &errors.real),
            of("Outside what was learned from", self.outside.to_owned(), &errors.outside),
        ]
    }

    /// The rightmost columns of the tables.
    fn more(&self) -> [Option<GridColumn>; 3] {
        [None, None, Some(worse_than_named(self.errors))]
    }
}

#[cfg(test)]
mod tests {
    use crate::reports::paper::sample;
    use pages::without_escapes;

    #[test]
    fn the_text_has_the_claims_the_tables_and_what_the_named_effects_gain() {
        let sample = sample::learning();
        let text = without_escapes(&sample.report().text());
        let lines: Vec<String> =
            text.lines().map(|l| l.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
        assert_eq!(lines[0], "1 of 2 of the claims hold on this arm.");
        assert!(
            text.contains(
                "does not hold: rbd is small (in 0 of 1 case, not rbd at shoulder: 0.500)."
            )
        );
        for expected in [
            "nMSE rbd gp gp-rbd named",
            "shoulder 0.500 0.0500 0.0100* 0.0200",
            "nMSE rbd gp gp-rbd named best gp / named",
            "shoulder 0.900 0.300 0.200 0.0100* 20.0x",
        ] {
            assert!(lines.iter().any(|line| line == expected), "{expected} is missing: {text}");
        }
        assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
    }

    #[test]
    fn the_page_is_self_contained_and_holds_claims_figures_and_numbers() {
        let mut sample = sample::learning();
        sample.errors.joints[1] = "</script><b>".into();
        let page = sample.report().page().unwrap();
        assert!(!page.contains("http://") && !page.contains("https://") && !page.contains("<b>"));
        assert_eq!((page.matches("<svg").count(), page.matches("</script>").count()), (3, 2));
        for expected in ["does not hold", "20.0x", "plumbline.figure_learning/1", "a far motion."] {
            assert!(page.contains(expected), "{expected} is missing");
        }
        assert!(!page.contains("NaN"));
    }

    #[test]
    fn the_json_holds_every_number_and_every_claim() {
        let sample = sample::learning();
        let value: serde_json::Value =
            serde_json::from_str(&sample.report().json().unwrap()).unwrap();
        assert_eq!(value["schema"], "plumbline.figure_learning/1");
        assert_eq!(value["real"][2]["model"], "gp-rbd");
        assert!(value["real"][2]["nmse"][1].is_null());
        assert_eq!(value["claims"][1]["verdict"], "does_not_hold");
        assert_eq!(value["claims"][1]["cases"][0]["value"], 0.5);
    }
}
