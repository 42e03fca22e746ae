use askama::Template;

use crate::tracking::comparison::{TrackedModel, TrackingComparison};
use pages::{
    Cell, HtmlGrid, Medium, Provenance, ReportError, TABLE_DIGITS, escape_json, mark_least,
    render_html, render_page, significant,
};

#[derive(Template)]
#[template(path = "tracking/tracking.html")]
struct Page<'a> {
    robot: &'a str,
    circumstances: String,
    sentence: String,
    warnings: &'a [String],
    errors: String,
    error_table: String,
    costs: String,
    notes: Vec<String>,
    motion: String,
    /// The first seconds of the joints that figure 4 leaves out.
    other_motions: Option<String>,
    sweep: Option<String>,
    tables: Vec<(&'static str, String)>,
    models: Vec<(&'a str, &'a str)>,
    gains: String,
    provenance: &'a Provenance,
    json: String,
}

/// Which of the numbers of a row stand out.
#[derive(Clone, Copy)]
enum Best {
    Least,
    Nothing,
}

impl TrackingComparison {
    /// `report.html`: the three figures, the tables behind them and the JSON in one file that
    /// opens offline, and without scripts too.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn page(&self) -> Result<String, ReportError> {
        let shown = self.shown_joints();
        let others: Vec<usize> = (0..self.joints.len()).filter(|i| !shown.contains(i)).collect();
        let errors = |model: &TrackedModel, joint| 1e3 * model.error(joint);
        let provenance = self.provenance.without_folders();
        let shared = Self { provenance: provenance.clone(), ..self.clone() };
        let whole = Page {
            robot: &self.robot,
            circumstances: self.circumstances(),
            sentence: self.sentence(),
            warnings: &self.warnings,
            errors: self.draw_errors(Medium::Page)?,
            error_table: self.by_joint(self.thousandths(), errors, Best::Least)?,
            costs: self.cost_table()?,
            notes: self.notes(),
            motion: self.draw_motion(&shown, Medium::Page)?,
            other_motions: if others.is_empty() {
                None
            } else {
                Some(self.draw_motion(&others, Medium::Page)?)
            },
            sweep: self.draw_sweep(Medium::Page)?,
            tables: self.more_tables()?,
            models: self.models.iter().map(|m| (m.name.as_str(), m.words.as_str())).collect(),
            gains: self.gain_table()?,
            provenance: &provenance,
            json: escape_json(&shared.json()?),
        };
        render_page(&whole)
    }

    /// One row a joint and one column a model.
    fn by_joint(
        &self,
        unit: &str,
        number: impl Fn(&TrackedModel, usize) -> f64,
        best: Best,
    ) -> Result<String, ReportError> {
        let rows = self.joints.iter().enumerate().map(|(i, joint)| {
            let numbers: Vec<f64> = self.models.iter().map(|model| number(model, i)).collect();
            let cells = match best {
                Best::Least => mark_least(&numbers),
                Best::Nothing => plain(&numbers),
            };
            (joint.name.clone(), cells)
        });
        render_html(&HtmlGrid {
            corner: format!("Joint ({unit})"),
            header: self.models.iter().map(|model| model.name.clone()).collect(),
            rows: rows.collect(),
        })
    }

    fn cost_table(&self) -> Result<String, ReportError> {
        let costs: Vec<Vec<Cell>> = self.models.iter().map(|model| self.costs(model)).collect();
        let rows = self.cost_labels().iter().enumerate().skip(1).map(|(row, label)| {
            ((*label).to_owned(), costs.iter().map(|costs| costs[row].clone()).collect())
        });
        render_html(&HtmlGrid {
            corner: String::new(),
            header: self.models.iter().map(|model| model.name.clone()).collect(),
            rows: rows.collect(),
        })
    }

    /// What is told joint by joint beside the errors of the whole runs.
    fn more_tables(&self) -> Result<Vec<(&'static str, String)>, ReportError> {
        type Numbers = fn(&TrackedModel) -> &[f64];
        let lengths = self.thousandths();
        let efforts = "N·m or N";
        let mut all: Vec<(&'static str, &str, f64, Numbers)> = vec![
            ("RMS error of the first ten seconds", lengths, 1e3, |m| &m.rmse_first_10_s_rad),
            ("Largest error", lengths, 1e3, |m| &m.max_error_rad),
            ("RMS effort", efforts, 1.0, |m| &m.effort_rms_nm),
            ("RMS effort of the feedback", efforts, 1.0, |m| &m.feedback_rms_nm),
            ("Largest jump of the feedforward", efforts, 1.0, |m| &m.largest_jump_nm),
        ];
        if self.models.iter().any(|model| model.link_rmse_rad.is_some()) {
            let links: Numbers = |m| m.link_rmse_rad.as_deref().unwrap_or_default();
            all.insert(0, ("RMS error of the links behind the transmissions", lengths, 1e3, links));
        }
        let table = |(title, unit, scale, numbers): (&'static str, &str, f64, Numbers)| {
            let number = |model: &TrackedModel, joint: usize| {
                numbers(model).get(joint).map_or(f64::NAN, |number| scale * number)
            };
            Ok((title, self.by_joint(unit, number, Best::Nothing)?))
        };
        let mut tables: Vec<(&'static str, String)> =
            all.into_iter().map(table).collect::<Result<_, ReportError>>()?;
        if self.models.iter().any(|model| model.timing.is_some()) {
            tables.push(("How the loop kept its time", self.timing_table()?));
        }
        Ok(tables)
    }

    /// One row a run on the clock of the wall.
    fn timing_table(&self) -> Result<String, ReportError> {
        let header = [
            "samples",
            "missed deadlines",
            "latest (µs)",
            "without a newer prediction",
            "latency, 99 in 100 (µs)",
            "latency, longest (µs)",
        ];
        let rows = self.models.iter().filter_map(|model| {
            let timing = model.timing.as_ref()?;
            let counts = [timing.ticks, timing.missed_deadlines, timing.missed_updates];
            let [ticks, deadlines, updates] = counts.map(|count| Cell::plain(count.to_string()));
            let times = [timing.worst_late_us, timing.latency_99_us, timing.latency_max_us];
            let [late, usual, longest] = times.map(|us| Cell::plain(significant(us, TABLE_DIGITS)));
            Some((model.name.clone(), vec![ticks, deadlines, late, updates, usual, longest]))
        });
        render_html(&HtmlGrid {
            corner: "Model".into(),
            header: header.map(str::to_owned).to_vec(),
            rows: rows.collect(),
        })
    }

    fn gain_table(&self) -> Result<String, ReportError> {
        let rows = self.joints.iter().enumerate().map(|(i, joint)| {
            let at = |gains: &[f64]| gains.get(i).copied().unwrap_or(f64::NAN);
            (joint.name.clone(), plain(&[at(&self.gains.kp), at(&self.gains.kd)]))
        });
        render_html(&HtmlGrid {
            corner: format!("Gains {}", self.gains.name),
            header: ["Kp (N·m/rad or N/m)", "Kd (N·m·s/rad or N·s/m)"].map(str::to_owned).to_vec(),
            rows: rows.collect(),
        })
    }
}

fn plain(numbers: &[f64]) -> Vec<Cell> {
    numbers.iter().map(|&number| Cell::plain(significant(number, TABLE_DIGITS))).collect()
}

#[cfg(test)]
mod tests {
    use crate::tracking::sample;

    #[test]
    fn the_page_is_self_contained_and_holds_figures_and_numbers() {
        let comparison = sample::comparison();
        let page = comparison.page().unwrap();
        assert!(!page.contains("http://") && !page.contains("https://"));
        assert!(page.contains("default-src 'none'") && page.matches("<script>").count() == 1);
        assert_eq!(page.matches("<svg class=\"plot\"").count(), 2);
        for expected in [
            "RMS error of the end effector",
            "<td class=\"n best\">5.00</td>",
            "slide: its encoder failed",
            "plumbline.tracking/1",
            "seed 7",
        ] {
            assert!(page.contains(expected), "{expected} is missing");
        }
        assert!(!page.contains("NaN"));
        assert_eq!(page, comparison.page().unwrap());
    }

    #[test]
    fn names_cannot_end_the_embedded_json_and_nothing_at_all_is_still_a_page() {
        let mut comparison = sample::comparison();
        comparison.robot = "</script><img>".into();
        comparison.sweep = None;
        let page = comparison.page().unwrap();
        assert_eq!(page.matches("</script>").count(), 2);
        assert!(!page.contains("<img>") && !page.contains("How low can the gains be"));
        comparison.models.clear();
        comparison.joints.clear();
        assert!(comparison.page().unwrap().contains("No run came to its end."));
    }
}
