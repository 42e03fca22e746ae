use askama::Template;

use crate::charts::chart::{Axis, Chart, CurveShape, Series};
use crate::charts::chart::{AxisBegin, Ink};
use crate::charts::decimate::column_extremes;
use crate::charts::inks::{Medium, Palette};
use crate::charts::linear_axis::LinearAxis;
use crate::charts::log_axis::{AxisTick, round_px};
use crate::html::render::render_html;
use crate::output::error::ReportError;
use colours::Role;

/// Width of the curves, which a page stretches to its own (px).
const WIDTH: f64 = 1000.0;

/// Share of the height that stays free above and below the curves.
const ROOM: f64 = 0.05;

/// Pixel columns that a curve is drawn on at most.
const COLUMNS: usize = 700;

/// The area between the axes; numbers and names stand outside of it, so that letters have the same
/// size however wide it is.
#[derive(Template)]
#[template(path = "plot.svg")]
struct Plot<'a> {
    chart: &'a Chart,
    words: String,
    colours: Palette,
    width: f64,
    height: f64,
    /// Ends of the axes, in their units.
    x: [f64; 2],
    y: [f64; 2],
    /// Places of numbers: shares of the width (%), and heights (px).
    x_ticks: Vec<AxisTick>,
    y_ticks: Vec<AxisTick>,
    /// Upper edge and height of the noise (px).
    floor: Option<(f64, f64)>,
    curves: Vec<Curve<'a>>,
}

struct Curve<'a> {
    name: &'a str,
    colour: String,
    path: String,
    is_area: bool,
    width: f64,
    opacity: f64,
}

impl Chart {
    /// The figure for a page, as wide as it; empty when there is nothing to draw.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn in_page(&self) -> Result<String, ReportError> {
        let svg = self.draw(Medium::Page)?;
        Ok(if svg.is_empty() { svg } else { format!("<div class=\"chart\">{svg}</div>") })
    }

    /// The area between the axes of a figure, as wide as what it is put into; empty when there is
    /// nothing to draw. Letters need [`CHART_MARGINS`] around it.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn draw(&self, medium: Medium) -> Result<String, ReportError> {
        Plot::new(self, medium).map_or_else(|| Ok(String::new()), |plot| render_html(&plot))
    }

    /// The figure at a place of a drawing that stands alone (px), letters included.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn draw_at(&self, [x, y]: [f64; 2], medium: Medium) -> Result<String, ReportError> {
        let [top, right, bottom, left] = CHART_MARGINS;
        let (width, height) = (self.size.0 - left - right, self.size.1 - top - bottom);
        let inner = Self { size: (width, height), ..self.clone() };
        let drawn = inner.draw(medium)?;
        let [x, y] = [x + left, y + top];
        Ok(format!(
            "<svg x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
             overflow=\"visible\">{drawn}</svg>"
        ))
    }
}

/// Room for letters above, right of, below and left of the area between the axes (px).
pub const CHART_MARGINS: [f64; 4] = [24.0, 12.0, 36.0, 52.0];

impl<'a> Plot<'a> {
    /// The plot of a chart; none where there is nothing to draw.
    fn new(chart: &'a Chart, medium: Medium) -> Option<Self> {
        let (ranges, height) = (chart.ranges(), chart.size.1);
        let x = ends(&chart.x, ranges[0], 0.0);
        let y = ends(&chart.y, ranges[1], ROOM);
        let share = LinearAxis::over(x.into_iter(), [0.0, 100.0])?;
        let [across, up] = [
            LinearAxis::over(x.into_iter(), [0.0, WIDTH])?,
            LinearAxis::over(y.into_iter(), [height, 0.0])?,
        ];
        let colours = medium.palette();
        let floor = chart.floor.filter(|floor| *floor > 0.0).map(|floor| {
            let edge = |value: f64| up.at(value).clamp(0.0, height);
            (edge(floor), round_px(edge(-floor) - edge(floor)))
        });
        let curve = |series: &'a Series| Curve::new(series, &colours, &across, &up);
        Some(Self {
            chart,
            words: chart.alt_text(),
            colours,
            width: WIDTH,
            height,
            x,
            y,
            x_ticks: share.ticks(),
            y_ticks: up.ticks(),
            floor,
            curves: chart.series.iter().map(curve).collect(),
        })
    }
}

/// Where an axis ends, with room beyond the numbers; never two times at the same place.
fn ends(axis: &Axis, [low, high]: [f64; 2], room: f64) -> [f64; 2] {
    let low = if axis.begin == AxisBegin::Zero { low.min(0.0) } else { low };
    let size = low.abs().max(high.abs());
    let is_flat = high - low <= 1e-9 * size;
    let room = if is_flat { (0.1 * size).max(0.01) } else { room * (high - low) };
    let below = if axis.begin == AxisBegin::Zero && low >= 0.0 { 0.0 } else { room };
    [low - below, high + room].map(short)
}

/// A number with as many digits as a drawing shows.
fn short(value: f64) -> f64 {
    format!("{value:.6e}").parse().unwrap_or(value)
}

impl<'a> Curve<'a> {
    fn new(series: &'a Series, colours: &Palette, across: &LinearAxis, up: &LinearAxis) -> Self {
        let at = |[x, y]: [f64; 2]| format!("{} {}", across.at(x), up.at(y));
        let line =
            |points: &[[f64; 2]]| points.iter().map(|p| at(*p)).collect::<Vec<_>>().join(" ");
        let (points, is_area) = match &series.shape {
            CurveShape::Line(points) => (column_extremes(points, COLUMNS), false),
            CurveShape::Band(band) => {
                let low = band.iter().map(|&[x, low, _]| [x, low]);
                (low.chain(band.iter().rev().map(|&[x, _, high]| [x, high])).collect(), true)
            }
        };
        let (width, opacity) = match series.ink {
            // What was asked for shows beneath what follows it.
            Ink::Role(Role::Desired) => (5.0, 0.6),
            Ink::Role(Role::Measured) => (1.8, 1.0),
            _ => (1.4, 1.0),
        };
        let path = if points.is_empty() { String::new() } else { format!("M{}", line(&points)) };
        Self { name: &series.name, colour: colours.of(series.ink), path, is_area, width, opacity }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart(series: Vec<Series>) -> Chart {
        Chart {
            title: "a < b".into(),
            x: Axis::from_zero("time", "s"),
            y: Axis::new("torque", "N·m"),
            series,
            floor: None,
            size: (300.0, 200.0),
        }
    }

    fn line(points: &[[f64; 2]]) -> Series {
        Series::of(Role::Nominal, CurveShape::Line(points.to_vec()))
    }

    #[test]
    fn a_point_lies_where_its_numbers_say() {
        let chart = chart(vec![line(&[[2.0, -1.0], [4.0, 1.0]])]);
        let plot = Plot::new(&chart, Medium::Page).unwrap();
        assert_eq!((plot.x, plot.y), ([0.0, 4.0], [-1.1, 1.1]));
        assert_eq!(plot.curves[0].path, "M500 190.9 1000 9.1");
        let labels: Vec<&str> = plot.x_ticks.iter().map(|tick| tick.label.as_str()).collect();
        assert_eq!((labels, plot.x_ticks[1].at), (vec!["0", "1", "2", "3", "4"], 25.0));
    }

    #[test]
    fn a_quantity_that_begins_at_zero_has_nothing_below_and_noise_lies_about_zero() {
        let mut chart = chart(vec![line(&[[0.0, 1.0], [4.0, 2.0]])]);
        chart.y = Axis::from_zero("drift", "mm");
        assert!(Plot::new(&chart, Medium::Page).unwrap().y[0].abs() < 1e-12);
        chart.y = Axis::new("residual", "N·m");
        chart.series = vec![line(&[[0.0, -2.0], [4.0, 2.0]])];
        chart.floor = Some(1.1);
        assert_eq!(Plot::new(&chart, Medium::Page).unwrap().floor, Some((50.0, 100.0)));
    }

    #[test]
    fn a_figure_has_words_and_no_address() {
        let svg = chart(vec![line(&[[0.0, 0.0], [1.0, 0.0]])]).in_page().unwrap();
        assert!(svg.contains("aria-label=\"a &#60; b:") && svg.contains("var(--nominal)"), "{svg}");
        assert!(!svg.contains("http") && !svg.contains("NaN"), "{svg}");
        assert!(chart(vec![line(&[])]).in_page().unwrap().is_empty());
        let alone = chart(vec![line(&[[0.0, 0.0], [1.0, 0.0]])]).draw_at([5.0, 7.0], Medium::Alone);
        let alone = alone.unwrap();
        assert!(
            alone.starts_with("<svg x=\"57\" y=\"31\" width=\"236\" height=\"140\""),
            "{alone}"
        );
        assert!(!alone.contains("var("), "{alone}");
    }
}
