use askama::Template;
use experiment::ForwardWindow;

use crate::diagnosis::forward::{drift_in_page, drifts};
use crate::run::charts::GainChart;
use crate::run::claims::{ClaimRow, claim_rows};
use crate::run::hidden::{HiddenRow, hidden_rows, score_sentence, stray_sentence};
use crate::run::rows::{GainRow, gain_rows};
use crate::run::run_report::{RunReport, THOUSANDTHS};
use pages::{
    Cell, HtmlGrid, Provenance, ReportError, TABLE_DIGITS, escape_json, render_html, render_page,
    significant,
};

#[derive(Template)]
#[template(path = "run/run.html")]
struct Page<'a> {
    robot: &'a str,
    class: &'a str,
    sentence: &'a str,
    bottom_line: &'a str,
    score: String,
    stray: Option<String>,
    warnings: &'a [String],
    hidden: Vec<HiddenRow>,
    unseen: String,
    gains: Vec<GainRow>,
    remarks: Vec<String>,
    charts: Vec<GainChart>,
    drift: String,
    tables: Vec<(String, String)>,
    motion: &'a str,
    /// What is claimed of the tracking with every model, and its errors.
    claims: Vec<ClaimRow>,
    all_tracked: String,
    sections: &'a str,
    motions: &'a [String],
    next: &'a [[String; 2]],
    provenance: &'a Provenance,
    json: String,
}

impl RunReport<'_> {
    /// `report.html`: what was put in beside what was found, what finding it gains, and the
    /// diagnosis, in one file that opens offline, and without scripts too.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn page(&self) -> Result<String, ReportError> {
        let (metrics, summary) = (self.metrics, self.diagnosis);
        let provenance = self.provenance.without_folders();
        let page = Page {
            robot: &metrics.robot,
            class: &summary.class,
            sentence: &summary.sentence,
            bottom_line: &summary.bottom_line,
            score: score_sentence(&metrics.score),
            stray: stray_sentence(&metrics.score),
            warnings: &summary.warnings,
            hidden: hidden_rows(&metrics.score, self.robot),
            unseen: self.test_runs(),
            gains: gain_rows(metrics),
            remarks: self.remarks(),
            charts: self.charts()?,
            drift: drift_in_page(Some(&metrics.forward))?,
            tables: self.tables()?,
            motion: self.motion,
            claims: claim_rows(&metrics.claims, self.tracked_unit()),
            all_tracked: self.tracking_dots()?,
            sections: &summary.sections,
            motions: &summary.motions,
            next: self.next,
            provenance: &provenance,
            json: escape_json(&self.json()?),
        };
        render_page(&page)
    }

    /// Every number joint by joint, one column a model.
    fn tables(&self) -> Result<Vec<(String, String)>, ReportError> {
        let metrics = self.metrics;
        let nmse = metrics.torque.iter().map(|model| {
            let nmse = model.nmse.iter().map(|nmse| nmse.unwrap_or(f64::NAN)).collect();
            (model.model.clone(), nmse)
        });
        let rms = metrics.torque.iter().map(|model| (model.model.clone(), model.rms_nm.clone()));
        let tracked = metrics.tracking.iter().map(|run| {
            (run.model.clone(), run.rms.iter().flatten().map(|rms| THOUSANDTHS * rms).collect())
        });
        let unit = self.position_unit();
        Ok(vec![
            ("Torque, nMSE".to_owned(), self.by_joint(nmse.collect())?),
            ("Torque, RMS error (N·m or N)".to_owned(), self.by_joint(rms.collect())?),
            (format!("Drift of the simulation ({unit})"), self.by_joint(self.drift_columns())?),
            (format!("Tracking, RMS error ({unit})"), self.by_joint(tracked.collect())?),
        ])
    }

    fn drift_columns(&self) -> Vec<(String, Vec<f64>)> {
        let columns = |window: &ForwardWindow| {
            let ms = format!("{:.0}", 1e3 * window.window_s);
            let [nominal, extended] = drifts(window)
                .map(|drift| drift.rms.iter().flatten().map(|rms| THOUSANDTHS * rms).collect());
            [(format!("{ms} ms, nominal"), nominal), (format!("{ms} ms, extended"), extended)]
        };
        self.metrics.forward.windows.iter().flat_map(columns).collect()
    }

    /// One row a joint; a number that is not there is a dash.
    fn by_joint(&self, columns: Vec<(String, Vec<f64>)>) -> Result<String, ReportError> {
        let row = |(joint, name): (usize, &String)| {
            let number = |(_, numbers): &(String, Vec<f64>)| {
                let number = numbers.get(joint).copied().unwrap_or(f64::NAN);
                Cell::plain(significant(number, TABLE_DIGITS))
            };
            (name.clone(), columns.iter().map(number).collect())
        };
        render_html(&HtmlGrid {
            corner: "Joint".to_owned(),
            header: columns.iter().map(|(name, _)| name.clone()).collect(),
            rows: self.metrics.joints.iter().enumerate().map(row).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::run::sample;

    #[test]
    fn the_page_is_self_contained_and_holds_both_sides_and_the_diagnosis() {
        let sample = sample::run();
        let page = sample.report().page().unwrap();
        assert!(!page.contains("http://") && !page.contains("https://"));
        assert!(page.contains("default-src 'none'") && page.matches("<script>").count() == 1);
        for expected in [
            "1 of 2 effects that were put in were found",
            "2.00 (1.80 to 2.20)",
            "not found",
            "payload at &#60;elbow&#62;",
            "Named, but not put in: TR01 backlash at elbow",
            "20x",
            "What was ruled out",
            "plumbline view out",
            "plumbline.run/1",
        ] {
            assert!(page.contains(expected), "{expected} is missing");
        }
        assert!(!page.contains("NaN"));
        assert_eq!(page, sample.report().page().unwrap());
    }

    #[test]
    fn names_cannot_end_the_embedded_json_and_nothing_at_all_is_still_a_page() {
        let mut sample = sample::run();
        sample.metrics.robot = "</script><img>".into();
        sample.metrics.joints.clear();
        sample.metrics.torque.clear();
        sample.metrics.forward.windows.clear();
        sample.metrics.tracking.clear();
        sample.metrics.score.injected.clear();
        let page = sample.report().page().unwrap();
        assert_eq!(page.matches("</script>").count(), 2);
        assert!(!page.contains("<img>") && page.contains("Nothing was put in"));
    }
}
