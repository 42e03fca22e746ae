use askama::Template;

use crate::replay::replay_report::{ReplayReport, ReplayedRun, ReplayedWindow};

use colours::Role;
use pages::{
    Cell, Dots, HtmlGrid, Ink, JointDots, LegendKey, Medium, Provenance, ReportError, TABLE_DIGITS,
    escape_json, render_html, render_page, significant,
};

#[derive(Template)]
#[template(path = "replay/replay.html")]
struct Page<'a> {
    report: &'a ReplayReport,
    sections: Vec<Section<'a>>,
    provenance: &'a Provenance,
    json: String,
}

/// One run.
struct Section<'a> {
    run: &'a ReplayedRun,
    drift: String,
    torque: String,
    table: String,
}

impl ReplayReport {
    /// `report.html`: the drift and the torque of every run, in one file that opens offline, and
    /// without scripts too.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn page(&self) -> Result<String, ReportError> {
        let provenance = self.provenance.without_folders();
        let shared = Self { provenance: provenance.clone(), ..self.clone() };
        let sections = self.runs.iter().map(|run| {
            Ok(Section {
                run,
                drift: self.drift(run)?,
                torque: self.torque(run)?,
                table: self.table(run)?,
            })
        });
        render_page(&Page {
            report: self,
            sections: sections.collect::<Result<_, ReportError>>()?,
            provenance: &provenance,
            json: escape_json(&shared.json()?),
        })
    }

    /// The drift of a run as dots, one a length of time.
    fn drift(&self, run: &ReplayedRun) -> Result<String, ReportError> {
        let key = |(index, window): (usize, &ReplayedWindow)| LegendKey {
            name: format!("{} ms", window.window_ms),
            ink: Ink::Model(index),
        };
        let at = |window: &ReplayedWindow, joint: usize| {
            let drift = window.drift_rms.as_ref().and_then(|rms| rms.get(joint));
            1e3 * drift.copied().unwrap_or(f64::NAN)
        };
        let keys = run.windows.iter().enumerate().map(key).collect();
        let values = |joint| run.windows.iter().map(|window| at(window, joint)).collect();
        self.dots(run, "drift of the simulation", "RMS drift (mrad or mm)", (keys, &values))
    }

    /// The torque of a run as dots: how far off it is, beside how large it is.
    fn torque(&self, run: &ReplayedRun) -> Result<String, ReportError> {
        let Some(torque) = &run.torque else { return Ok(String::new()) };
        let key = |name: &str, role| LegendKey { name: name.to_owned(), ink: Ink::Role(role) };
        let at = |values: &[f64], joint: usize| values.get(joint).copied().unwrap_or(f64::NAN);
        let keys =
            vec![key("simulated minus measured", Role::Error), key("measured", Role::Measured)];
        let values =
            |joint| vec![at(&torque.error_rms_nm, joint), at(&torque.measured_rms_nm, joint)];
        self.dots(run, "torque along the measured motion", "RMS torque (N·m or N)", (keys, &values))
    }

    fn dots(
        &self,
        run: &ReplayedRun,
        title: &str,
        axis: &'static str,
        (keys, values): (Vec<LegendKey>, &dyn Fn(usize) -> Vec<f64>),
    ) -> Result<String, ReportError> {
        let joints = self.joints.iter().enumerate().map(|(joint, name)| JointDots {
            name: name.clone(),
            values: values(joint),
            floor: None,
        });
        let dots = Dots {
            title: format!("{}: {title}", run.name),
            subtitle: String::new(),
            axis,
            keys,
            joints: joints.collect(),
            mark: None,
        };
        dots.draw(Medium::Page)
    }

    /// Every number of a run, one row a joint.
    fn table(&self, run: &ReplayedRun) -> Result<String, ReportError> {
        let mut header: Vec<String> = run
            .windows
            .iter()
            .map(|w| format!("Drift in {} ms (mrad or mm)", w.window_ms))
            .collect();
        if run.torque.is_some() {
            header.extend(["Torque error", "Measured torque"].map(str::to_owned));
        }
        let row = |(joint, name): (usize, &String)| {
            let number = |column: &[f64]| column.get(joint).copied().unwrap_or(f64::NAN);
            let drifts = run.windows.iter().map(|w| w.drift_rms.as_deref().unwrap_or_default());
            let drifts = drifts.map(|drift| 1e3 * number(drift));
            let torques = run.torque.iter().flat_map(|t| [&t.error_rms_nm, &t.measured_rms_nm]);
            let values = drifts.chain(torques.map(|torque| number(torque)));
            let cells = values.map(|value| Cell::plain(significant(value, TABLE_DIGITS)));
            (name.clone(), cells.collect())
        };
        let tip = run.windows.iter().map(|w| w.tip_rms_m.map_or(f64::NAN, |m| 1e3 * m));
        let torques = run.torque.iter().flat_map(|_| [f64::NAN; 2]);
        let tip = tip.chain(torques).map(|x| Cell::plain(significant(x, TABLE_DIGITS)));
        let tip = ("tip (mm)".to_owned(), tip.collect());
        render_html(&HtmlGrid {
            corner: "Joint".to_owned(),
            header,
            rows: self.joints.iter().enumerate().map(row).chain([tip]).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::replay::sample::sample;

    #[test]
    fn the_page_tells_drift_and_torque_of_every_run() {
        let page = sample().page().unwrap();
        for expected in [
            "<h2 id=\"run-1\">run_1</h2>",
            "&#60;elbow&#62;, 50 ms: 2.00",
            "<td class=\"n\">1.00</td>",
            "Drift in 50 ms (mrad or mm)",
            "shoulder, simulated minus measured: 0.500",
            "<td class=\"n\">12.0</td>",
            "a joint ran away",
            "tip (mm)",
            "<td class=\"n\">8.00</td>",
            "plumbline.replay/1",
        ] {
            assert!(page.contains(expected), "{expected} is missing in {page}");
        }
        assert!(!page.contains("NaN") && !page.contains("<elbow>"));
    }

    #[test]
    fn a_robot_without_gains_has_no_torque() {
        let mut report = sample();
        report.runs[0].torque = None;
        let page = report.page().unwrap();
        assert!(!page.contains("Torque along") && page.contains("kp_nm_per_rad"));
    }
}
