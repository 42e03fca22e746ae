use askama::Template;

use super::comparison::TrackingComparison;
use crate::ReportError;
use crate::linear_axis::LinearAxis;
use crate::log_axis::Tick;
use crate::sheet::{EDGES, Key, Place, Sheet};

/// Height of the curves of one joint, of what stands between two, and below the last (px).
const PANEL: f64 = 170.0;
const BETWEEN: f64 = 38.0;
const BELOW: f64 = 52.0;

/// Part of the height that stays free above and below the curves (px).
const MARGIN: f64 = 8.0;

#[derive(Template)]
#[template(path = "motion.svg")]
struct Drawing {
    sheet: Sheet,
    edges: [f64; 2],
    panels: Vec<Panel>,
    x_ticks: Vec<Tick>,
}

/// The curves of one joint.
struct Panel {
    top: f64,
    bottom: f64,
    name: String,
    unit: &'static str,
    ticks: Vec<Tick>,
    desired: String,
    models: Vec<Curve>,
}

struct Curve {
    points: String,
    colour: &'static str,
}

impl TrackingComparison {
    /// `figure4.svg`: the motion of some joints over the first ten seconds, as it should be and
    /// as it was with every model, after figure 4 of Nguyen-Tuong & Peters 2010, in a drawing
    /// that stands alone.
    ///
    /// `joints` counts from 0; a joint that the robot does not have is left out. Shows the
    /// first ten models.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn motion_figure(&self, joints: &[usize]) -> Result<String, ReportError> {
        self.motion_drawn(joints, Place::Alone)
    }

    /// The same of the three joints with the largest errors, for a page of the program's own.
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
        self.motion_drawn(&joints, Place::Page)
    }

    pub(crate) fn motion_drawn(
        &self,
        joints: &[usize],
        place: Place,
    ) -> Result<String, ReportError> {
        let drawing = Drawing::new(self, joints, place);
        drawing.render().map_err(|e| ReportError::Format { format: "SVG", reason: e.to_string() })
    }

    /// The joints of figure 4 of Nguyen-Tuong & Peters 2010, the fourth to the sixth; the last
    /// three of a robot that has fewer.
    pub fn shown_joints(&self) -> Vec<usize> {
        let end = self.joints.len().min(6);
        (end.saturating_sub(3)..end).collect()
    }

    /// The desired positions of a joint, of the longest run.
    fn desired(&self, joint: usize) -> &[[f64; 2]] {
        let runs = self.models.iter().filter_map(|model| model.first_seconds.desired.get(joint));
        runs.max_by_key(|points| points.len()).map_or(&[], Vec::as_slice)
    }

    /// The measured positions of a joint with each of the models.
    fn measured(&self, joint: usize) -> impl Iterator<Item = (&[[f64; 2]], &'static str)> {
        self.keyed().map(move |(model, colour)| {
            (model.first_seconds.measured.get(joint).map_or(&[][..], Vec::as_slice), colour)
        })
    }
}

impl Drawing {
    fn new(comparison: &TrackingComparison, joints: &[usize], place: Place) -> Self {
        let mut keys = comparison.keys();
        let title = format!("{}: the first ten seconds", comparison.robot);
        keys.insert(0, Key { name: "desired".into(), colour: place.colours().ink });
        let sheet = Sheet::new(&title, &comparison.circumstances(), keys, place);
        let known = joints.iter().copied().filter(|&joint| joint < comparison.joints.len());
        let curves = |joint| {
            let measured = comparison.measured(joint).map(|(points, _)| points);
            measured.chain([comparison.desired(joint)]).flatten()
        };
        let time = known.clone().flat_map(curves).map(|point| point[0]);
        let time = LinearAxis::over(time, EDGES);
        let top = sheet.bottom() + BETWEEN;
        let panels = known.enumerate().filter_map(|(row, joint)| {
            Panel::new(comparison, joint, &time?, top + row as f64 * (PANEL + BETWEEN))
        });
        let panels: Vec<Panel> = panels.collect();
        let bottom = panels.last().map_or(sheet.bottom(), |panel| panel.bottom);
        Self {
            sheet: sheet.down_to(bottom + BELOW),
            edges: EDGES,
            panels,
            x_ticks: time.map(|axis| axis.ticks()).unwrap_or_default(),
        }
    }
}

impl Panel {
    /// The curves below `top`; none where nothing was measured.
    fn new(
        comparison: &TrackingComparison,
        joint: usize,
        time: &LinearAxis,
        top: f64,
    ) -> Option<Self> {
        let desired = comparison.desired(joint);
        let all = comparison.measured(joint).flat_map(|(points, _)| points).chain(desired);
        let bottom = top + PANEL;
        let y = LinearAxis::over(all.map(|point| point[1]), [bottom - MARGIN, top + MARGIN])?;
        let drawn = |points: &[[f64; 2]]| {
            let at = |p: &[f64; 2]| format!("{},{}", time.at(p[0]), y.at(p[1]));
            points.iter().map(at).collect::<Vec<_>>().join(" ")
        };
        let models = comparison.measured(joint).filter(|(points, _)| !points.is_empty());
        let joint = comparison.joints.get(joint)?;
        Some(Self {
            top,
            bottom,
            name: joint.name.clone(),
            unit: joint.position_unit(),
            ticks: y.ticks(),
            desired: drawn(desired),
            models: models
                .map(|(points, colour)| Curve { points: drawn(points), colour })
                .collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::text_of_xml;
    use crate::tracking::sample;

    #[test]
    fn a_curve_lies_where_its_positions_do() {
        let mut comparison = sample::comparison();
        let model = &mut comparison.models[2].first_seconds;
        model.measured[0] = vec![[0.0, -1.0], [10.0, 1.0]];
        let drawing = Drawing::new(&comparison, &[0, 9], Place::Alone);
        let [panel] = &drawing.panels[..] else { panic!("the arm has no tenth joint") };
        let (low, high) = (panel.bottom - MARGIN, panel.top + MARGIN);
        assert_eq!(panel.models[2].points, format!("70,{low} 876,{high}"));
        let labels: Vec<&str> = drawing.x_ticks.iter().map(|tick| tick.label.as_str()).collect();
        assert_eq!(labels, ["0", "2", "4", "6", "8", "10"]);
    }

    #[test]
    fn the_figure_is_xml_with_or_without_signals() {
        let mut comparison = sample::comparison();
        let svg = comparison.motion_figure(&comparison.shown_joints()).unwrap();
        let text = text_of_xml(&svg);
        for expected in ["shoulder (rad)", "slide (m)", "desired", "gp-rbd", "time (s)"] {
            assert!(text.contains(expected), "{expected} is missing in {text}");
        }
        assert_eq!(svg.matches("<polyline").count(), 2 * (1 + 3));
        comparison.models.iter_mut().for_each(|m| m.first_seconds = Default::default());
        let svg = comparison.motion_figure(&[0, 1]).unwrap();
        text_of_xml(&svg);
        assert!(!svg.contains("NaN") && !svg.contains("polyline"));
    }

    #[test]
    fn the_elbow_and_the_wrist_of_a_long_arm_are_shown() {
        let mut comparison = sample::comparison();
        assert_eq!(comparison.shown_joints(), [0, 1]);
        comparison.joints = vec![comparison.joints[0].clone(); 7];
        assert_eq!(comparison.shown_joints(), [3, 4, 5]);
    }
}
