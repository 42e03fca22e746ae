use askama::Template;

use crate::tracking::comparison::{ErrorSweep, SweptFeedforward, TrackingComparison};
use pages::{
    AxisTick, FIGURE_EDGES, FigureSheet, LegendKey, LogAxis, Medium, Palette, ReportError,
    round_px, significant,
};

/// Joints beside each other, height of a panel, and what stands between two panels, across and
/// down (px).
const COLUMNS: usize = 4;
const PANEL: f64 = 200.0;
const BETWEEN: [f64; 2] = [18.0, 62.0];

/// Below the last panel (px).
const BELOW: f64 = 52.0;

/// Least distance of two numbers at the axis of the gains (px).
const APART: f64 = 30.0;

/// Powers of ten that the axis of the errors spans at most.
const MOST_DECADES: i32 = 6;

#[derive(Template)]
#[template(path = "tracking/sweep.svg")]
struct Drawing {
    sheet: FigureSheet,
    edges: [f64; 2],
    axis: &'static str,
    gains: String,
    panels: Vec<Panel>,
}

/// The errors of one joint.
struct Panel {
    x: [f64; 2],
    y: [f64; 2],
    name: String,
    is_first_in_row: bool,
    x_ticks: Vec<AxisTick>,
    y_ticks: Vec<AxisTick>,
    curves: Vec<Curve>,
}

struct Curve {
    /// Straight lines between the numbers that there are.
    path: String,
    dots: Vec<Dot>,
    colour: String,
}

struct Dot {
    at: [f64; 2],
    words: String,
}

impl TrackingComparison {
    /// `gains.svg`: the error of every model at every joint against the gains of the feedback,
    /// both logarithmic, one panel a joint on the same axes, in a drawing that stands alone.
    ///
    /// How low the gains of a model may be for an error is where its curve meets the line of
    /// that error. None where there was no sweep.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn sweep_figure(&self) -> Result<Option<String>, ReportError> {
        self.draw_sweep(Medium::Alone)
    }

    pub(crate) fn draw_sweep(&self, medium: Medium) -> Result<Option<String>, ReportError> {
        let Some(sweep) = &self.sweep else { return Ok(None) };
        let drawing = Drawing::new(self, sweep, medium);
        let svg = drawing.render();
        svg.map(Some).map_err(|e| ReportError::Format { format: "SVG", reason: e.to_string() })
    }
}

impl Drawing {
    fn new(comparison: &TrackingComparison, sweep: &ErrorSweep, medium: Medium) -> Self {
        let key = |model: &SweptFeedforward| LegendKey {
            name: model.name.clone(),
            ink: comparison.ink_of(&model.name),
        };
        let title = format!("{}: how low can the gains be?", comparison.robot);
        let subtitle = format!(
            "RMS error over {} s of {} against Kp over that of the gains {}, Kd with its square \
             root; both logarithmic, lower left is better",
            significant(sweep.duration_s, 3),
            comparison.motion,
            sweep.gains
        );
        let keys = sweep.models.iter().map(key).collect();
        let sheet = FigureSheet::new(&title, &subtitle, keys, medium);
        let panels = panels(comparison, sweep, sheet.bottom() + 42.0, &medium.palette());
        let bottom = panels.last().map_or(sheet.bottom(), |panel| panel.y[1]);
        let axis = comparison.thousandths();
        let gains = sweep.gains.clone();
        Self { sheet: sheet.down_to(bottom + BELOW), edges: FIGURE_EDGES, axis, gains, panels }
    }
}

fn panels(
    comparison: &TrackingComparison,
    sweep: &ErrorSweep,
    top: f64,
    colours: &Palette,
) -> Vec<Panel> {
    let columns = comparison.joints.len().clamp(1, COLUMNS);
    let step = (FIGURE_EDGES[1] - FIGURE_EDGES[0] + BETWEEN[0]) / columns as f64;
    let panels = comparison.joints.iter().enumerate().map_while(|(joint, compared)| {
        let (row, column) = (joint / columns, joint % columns);
        let left = FIGURE_EDGES[0] + step * column as f64;
        let x = [round_px(left), round_px(left + step - BETWEEN[0])];
        let top = top + row as f64 * (PANEL + BETWEEN[1]);
        let y = [top, top + PANEL];
        let errors = sweep.models.iter().flat_map(|model| model.rmse_rad.iter().flatten());
        let errors = errors.map(|error| 1e3 * error);
        let y_axis = LogAxis::over_decades(errors, MOST_DECADES, [y[1], y[0]])?;
        let x_axis = LogAxis::over(sweep.scales.iter().copied(), [x[0] + 10.0, x[1] - 10.0])?;
        let curve = |model: &SweptFeedforward| Curve {
            colour: colours.of(comparison.ink_of(&model.name)),
            ..Curve::new(&sweep.scales, model, joint, [x_axis, y_axis])
        };
        Some(Panel {
            x,
            y,
            name: compared.name.clone(),
            is_first_in_row: column == 0,
            x_ticks: gain_ticks(&sweep.scales, &x_axis),
            y_ticks: y_axis.ticks(),
            curves: sweep.models.iter().map(curve).collect(),
        })
    });
    panels.collect()
}

impl Curve {
    fn new(scales: &[f64], model: &SweptFeedforward, joint: usize, [x, y]: [LogAxis; 2]) -> Self {
        let mut points: Vec<(f64, Option<f64>)> = scales
            .iter()
            .zip(&model.rmse_rad)
            .map(|(&scale, errors)| {
                let error = errors.get(joint).map(|error| 1e3 * error);
                (scale, error.filter(|&error| y.holds(error)))
            })
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut curve = Self { path: String::new(), dots: Vec::new(), colour: String::new() };
        let mut command = 'M';
        for (scale, error) in points {
            // What is not known is a gap.
            let Some(error) = error else {
                command = 'M';
                continue;
            };
            let at = [x.at(scale), y.at(error)];
            curve.path.push_str(&format!("{command}{} {}", at[0], at[1]));
            let [gain, error] = [scale, error].map(|number| significant(number, 3));
            let words = format!("{}, gains times {gain}: {error}", model.name);
            curve.dots.push(Dot { at, words });
            command = 'L';
        }
        curve
    }
}

/// The gains that were tried, with the numbers that find room.
fn gain_ticks(scales: &[f64], axis: &LogAxis) -> Vec<AxisTick> {
    let mut scales: Vec<f64> = scales.iter().copied().filter(|&scale| axis.holds(scale)).collect();
    scales.sort_by(f64::total_cmp);
    let mut free = f64::NEG_INFINITY;
    let tick = |scale: f64| {
        let at = axis.at(scale);
        let label = if at < free { String::new() } else { short(scale) };
        free = if label.is_empty() { free } else { at + APART };
        AxisTick { at, label }
    };
    scales.into_iter().map(tick).collect()
}

/// A scale with at most two digits and no zeros at its end.
fn short(scale: f64) -> String {
    let text = significant(scale, 2);
    if !text.contains('.') || text.contains('e') {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::text_of_xml;
    use crate::tracking::sample;

    #[test]
    fn equal_ratios_are_equal_lengths_and_what_is_not_known_is_a_gap() {
        let mut comparison = sample::comparison();
        let sweep = comparison.sweep.as_mut().unwrap();
        sweep.scales = vec![0.01, 0.1, 1.0];
        sweep.models[0].rmse_rad = [10.0, 1.0, 0.1].map(|error| vec![error, f64::NAN]).to_vec();
        sweep.models[1].rmse_rad = [1.0, f64::NAN, 0.1].map(|error| vec![error; 2]).to_vec();
        let drawing = Drawing::new(&comparison, comparison.sweep.as_ref().unwrap(), Medium::Alone);
        let [hinge, slide] = &drawing.panels[..] else { panic!("two joints") };
        let dots: Vec<[f64; 2]> = hinge.curves[0].dots.iter().map(|dot| dot.at).collect();
        let (across, down) = (dots[1][0] - dots[0][0], dots[1][1] - dots[0][1]);
        assert!((dots[2][0] - dots[1][0] - across).abs() < 0.2 && across > 50.0);
        assert!((dots[2][1] - dots[1][1] - down).abs() < 0.2 && down > 20.0);
        assert_eq!(hinge.curves[0].dots[1].words, "rbd, gains times 0.100: 1000");
        assert_eq!(hinge.curves[1].path.matches('M').count(), 2);
        assert_eq!(
            (slide.curves[0].path.as_str(), hinge.curves[0].colour.as_str()),
            ("", "#999933")
        );
    }

    #[test]
    fn gains_that_lie_close_have_one_number() {
        let axis = LogAxis::over([0.1, 10.0].into_iter(), [0.0, 200.0]).unwrap();
        let labels = |scales: &[f64]| -> Vec<String> {
            gain_ticks(scales, &axis).into_iter().map(|tick| tick.label).collect()
        };
        assert_eq!(labels(&[0.1, 0.11, 1.0, 0.25, 10.0]), ["0.1", "", "0.25", "1", "10"]);
        assert_eq!(short(250.0), "250");
    }

    #[test]
    fn the_figure_is_xml_and_there_is_none_without_a_sweep() {
        let mut comparison = sample::comparison();
        let svg = comparison.sweep_figure().unwrap().unwrap();
        let text = text_of_xml(&svg);
        for expected in ["how low can the gains be", "slide", "0.25", "rbd, gains times 1.00: 20.0"]
        {
            assert!(text.contains(expected), "{expected} is missing in {text}");
        }
        assert_eq!(svg.matches("http").count(), 1, "only the name space");
        let sweep = comparison.sweep.as_mut().unwrap();
        sweep.scales.clear();
        sweep.models[0].rmse_rad.clear();
        text_of_xml(&comparison.sweep_figure().unwrap().unwrap());
        comparison.sweep = None;
        assert_eq!(comparison.sweep_figure(), Ok(None));
    }
}
