use askama::Template;
use colours::Role;

use crate::tracking::comparison::TrackingComparison;
use pages::{
    Axis, Chart, CurveShape, FIGURE_EDGES, FigureSheet, Ink, LegendKey, Medium, ReportError,
    Series, render_html,
};

/// Height of the curves of one joint with their letters, and what stands above the first (px).
const PANEL: f64 = 200.0;
const ABOVE: f64 = 10.0;

/// Drawings below each other on a sheet.
#[derive(Template)]
#[template(path = "tracking/motion.svg")]
struct Alone {
    sheet: FigureSheet,
    panels: Vec<String>,
}

/// Plots of a page with one axis of time.
#[derive(Template)]
#[template(path = "tracking/motion.html")]
struct InPage {
    keys: Vec<LegendKey>,
    panels: Vec<String>,
}

impl TrackingComparison {
    /// `figure4.svg`: the motion of some joints over the first ten seconds, as it should be and
    /// as it was with every model, after figure 4 of Nguyen-Tuong & Peters 2010, in a drawing
    /// that stands alone.
    ///
    /// `joints` counts from 0; a joint that the robot does not have is left out.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn motion_figure(&self, joints: &[usize]) -> Result<String, ReportError> {
        self.draw_motion(joints, Medium::Alone)
    }

    /// The errors of the three joints with the largest ones over the same time, for a page of the program's own.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn motion_in_page(&self) -> Result<String, ReportError> {
        let error =
            |joint: &usize| self.models.iter().map(|model| model.error(*joint)).fold(0.0, f64::max);
        let mut joints: Vec<usize> = (0..self.joints.len()).collect();
        joints.sort_by(|a, b| error(b).total_cmp(&error(a)));
        joints.truncate(3);
        joints.sort_unstable();
        self.draw_motion(&joints, Medium::Page)
    }

    pub(crate) fn draw_motion(
        &self,
        joints: &[usize],
        medium: Medium,
    ) -> Result<String, ReportError> {
        let known = joints.iter().copied().filter(|&joint| joint < self.joints.len());
        let drawn = |of: fn(&Self, usize) -> Chart| {
            known.map(move |joint| of(self, joint)).filter(|chart| !chart.is_empty())
        };
        match medium {
            Medium::Page => {
                let panels = drawn(Self::error_of).map(|chart| chart.in_page());
                let panels = panels.collect::<Result<_, _>>()?;
                render_html(&InPage { keys: self.keys(), panels })
            }
            Medium::Alone => {
                let charts = drawn(Self::motion_of);
                let desired =
                    LegendKey { name: "desired".to_owned(), ink: Ink::Role(Role::Desired) };
                let keys: Vec<LegendKey> = std::iter::once(desired).chain(self.keys()).collect();
                let title = format!("{}: the first ten seconds", self.robot);
                let sheet = FigureSheet::new(&title, &self.circumstances(), keys, medium);
                let top = |row: usize| sheet.bottom() + ABOVE + PANEL * row as f64;
                let panels = charts.enumerate().map(|(row, chart)| {
                    let chart = Chart { size: (FIGURE_EDGES[1] - 10.0, PANEL), ..chart };
                    chart.draw_at([FIGURE_EDGES[0] - 52.0, top(row)], medium)
                });
                let panels: Vec<String> = panels.collect::<Result<_, _>>()?;
                let bottom = top(panels.len());
                render_html(&Alone { sheet: sheet.down_to(bottom + ABOVE), panels })
            }
        }
    }

    /// Measured minus desired position of one joint over the first ten seconds, in thousandths of its unit.
    fn error_of(&self, joint: usize) -> Chart {
        let models = self.models.iter().zip(self.inks()).map(|(model, ink)| {
            let errors = model.first_seconds.error.get(joint).into_iter().flatten();
            let points = errors.map(|[time_s, error]| [*time_s, 1e3 * error]).collect();
            Series { name: model.name.clone(), ink, shape: CurveShape::Line(points) }
        });
        let (name, unit) = self.joints.get(joint).map_or(("", "mrad"), |joint| {
            (joint.name.as_str(), if joint.position_unit() == "m" { "mm" } else { "mrad" })
        });
        Chart {
            title: format!("Tracking error of {name} over the first ten seconds"),
            x: Axis::new("time", "s"),
            y: Axis::new(name, unit),
            series: models.collect(),
            floor: None,
            size: (1000.0, 140.0),
        }
    }

    /// The positions of one joint over the first ten seconds.
    fn motion_of(&self, joint: usize) -> Chart {
        let desired =
            Series::of(Role::Desired, CurveShape::Line(self.desired_positions(joint).to_vec()));
        let models = self.models.iter().zip(self.inks()).map(|(model, ink)| Series {
            name: model.name.clone(),
            ink,
            shape: CurveShape::Line(
                model.first_seconds.measured.get(joint).cloned().unwrap_or_default(),
            ),
        });
        let (name, unit) = self
            .joints
            .get(joint)
            .map_or(("", ""), |joint| (joint.name.as_str(), joint.position_unit()));
        Chart {
            title: format!("The first ten seconds of {name}"),
            x: Axis::new("time", "s"),
            y: Axis::new(name, unit),
            series: std::iter::once(desired).chain(models).collect(),
            floor: None,
            size: (1000.0, 140.0),
        }
    }

    /// The joints of figure 4 of Nguyen-Tuong & Peters 2010, the fourth to the sixth; the last
    /// three of a robot that has fewer.
    pub fn shown_joints(&self) -> Vec<usize> {
        let end = self.joints.len().min(6);
        (end.saturating_sub(3)..end).collect()
    }

    /// The desired positions of a joint, of the longest run.
    fn desired_positions(&self, joint: usize) -> &[[f64; 2]] {
        let runs = self.models.iter().filter_map(|model| model.first_seconds.desired.get(joint));
        runs.max_by_key(|points| points.len()).map_or(&[], Vec::as_slice)
    }
}

#[cfg(test)]
mod tests {
    use crate::sample::text_of_xml;
    use crate::tracking::sample;

    #[test]
    fn the_figure_is_xml_with_or_without_signals() {
        let mut comparison = sample::comparison();
        let svg = comparison.motion_figure(&comparison.shown_joints()).unwrap();
        let text = text_of_xml(&svg);
        for expected in ["shoulder (rad)", "slide (m)", "desired", "gp-rbd", "time (s)"] {
            assert!(text.contains(expected), "{expected} is missing in {text}");
        }
        assert_eq!(svg.matches("data-name=").count(), 2 * (1 + 3));
        comparison.models.iter_mut().for_each(|m| m.first_seconds = Default::default());
        let svg = comparison.motion_figure(&[0, 1]).unwrap();
        text_of_xml(&svg);
        assert!(!svg.contains("NaN") && !svg.contains("data-name"));
    }

    #[test]
    fn a_page_shows_the_errors_of_the_motion_in_thousandths() {
        let mut comparison = sample::comparison();
        for model in &mut comparison.models {
            let half = |at: f64| vec![[0.0, 0.0], [1.0, at]];
            model.first_seconds.error = vec![half(0.25), half(0.5)];
        }
        let page = comparison.motion_in_page().unwrap();
        for expected in ["shoulder (mrad)", "slide (mm)", "250", "500"] {
            assert!(page.contains(expected), "{expected} is missing in {page}");
        }
        assert!(!page.contains("desired"));
    }

    #[test]
    fn the_elbow_and_the_wrist_of_a_long_arm_are_shown() {
        let mut comparison = sample::comparison();
        assert_eq!(comparison.shown_joints(), [0, 1]);
        comparison.joints = vec![comparison.joints[0].clone(); 7];
        assert_eq!(comparison.shown_joints(), [3, 4, 5]);
    }
}
