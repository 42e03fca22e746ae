use askama::Template;
use pages::{
    AxisTick, CHARACTER_WIDTH, FigureSheet, Ink, LogAxis, Medium, Palette, ReportError, round_px,
    shorten,
};

use crate::reports::times::prediction_times::{Maker, PredictionTimes, TimeCurve};

/// Height of the figure, edges of the curves (px): left, right, upper, lower.
const HEIGHT: f64 = 480.0;
const X: [f64; 2] = [78.0, 664.0];
const Y: [f64; 2] = [92.0, 420.0];

/// What a page saves at the top, where it tells the title itself (px).
const TITLE: f64 = 68.0;

/// Where the names of the curves begin, least distance between two of them, and characters
/// that fit (px).
const NAMES: f64 = 716.0;
const APART: f64 = 16.0;
const NAME_CHARACTERS: usize = ((876.0 - NAMES) / CHARACTER_WIDTH) as usize;

/// Period of a control loop of 1 kHz (us).
const PERIOD_US: f64 = 1000.0;

/// Most powers of ten on the time axis.
const MOST_DECADES: i32 = 9;

/// Dashes of the curves of peers, one after the other.
const DASHES: [&str; 3] = ["7 4", "2 3", "9 3 2 3"];

#[derive(Template)]
#[template(path = "times.svg")]
struct Drawing {
    sheet: FigureSheet,
    x: [f64; 2],
    y: [f64; 2],
    x_ticks: Vec<AxisTick>,
    y_ticks: Vec<AxisTick>,
    /// Position of the period of a fast control loop, if it is on the axis.
    period: Option<f64>,
    lines: Vec<Line>,
    names: f64,
}

/// A curve, and the position of its name.
struct Line {
    path: String,
    end: [f64; 2],
    name: String,
    name_y: f64,
    colour: String,
    dashes: &'static str,
}

impl PredictionTimes {
    /// `figure1.svg`: the time of a prediction against the number of training points as a self-contained drawing,
    /// both axes logarithmic, peers dashed.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn figure(&self) -> Result<String, ReportError> {
        self.draw(Medium::Alone)
    }

    pub(crate) fn draw(&self, medium: Medium) -> Result<String, ReportError> {
        let drawing = Drawing::new(self, medium);
        drawing.render().map_err(|e| ReportError::Format { format: "SVG", reason: e.to_string() })
    }
}

impl Drawing {
    fn new(times: &PredictionTimes, medium: Medium) -> Self {
        let points = || times.curves.iter().flat_map(|curve| &curve.points);
        let saved = match medium {
            Medium::Alone => 0.0,
            Medium::Page => TITLE,
        };
        let edges = Y.map(|y| y - saved);
        let [upper, lower] = edges;
        let x = LogAxis::over(points().map(|p| p.n as f64), X);
        let y =
            LogAxis::over_decades(points().map(|p| p.microseconds), MOST_DECADES, [lower, upper]);
        let axes = x.zip(y);
        let title =
            format!("Time of one prediction for the {} joints of {}", times.joints, times.robot);
        Self {
            sheet: FigureSheet::new(&title, &times.machine, Vec::new(), medium)
                .down_to(HEIGHT - saved),
            x: X,
            y: edges,
            x_ticks: x.map(|axis| axis.ticks()).unwrap_or_default(),
            y_ticks: y.map(|axis| axis.ticks()).unwrap_or_default(),
            period: y.filter(|axis| axis.holds(PERIOD_US)).map(|axis| axis.at(PERIOD_US)),
            lines: axes
                .map(|axes| lines(&times.curves, axes, (lower, &medium.palette())))
                .unwrap_or_default(),
            names: NAMES,
        }
    }
}

/// The curves that have points, their names far enough apart.
fn lines(
    curves: &[TimeCurve],
    (x, y): (LogAxis, LogAxis),
    (lower, colours): (f64, &Palette),
) -> Vec<Line> {
    let (mut models, mut dashes) = (0.., DASHES.iter().cycle());
    let mut lines: Vec<Line> = curves
        .iter()
        .filter_map(|curve| {
            let at = |p: &crate::reports::times::prediction_times::TimePoint| {
                [x.at(p.n as f64), y.at(p.microseconds)]
            };
            let end = at(curve.points.last()?);
            let path: Vec<String> =
                curve.points.iter().map(at).map(|[x, y]| format!("{x},{y}")).collect();
            let (colour, dashes) = match curve.maker {
                Maker::Plumbline => (colours.of(Ink::Model(models.next().unwrap_or(0))), ""),
                Maker::Peer => {
                    (colours.soft.to_owned(), dashes.next().copied().unwrap_or_default())
                }
            };
            let name = shorten(&curve.name, NAME_CHARACTERS);
            Some(Line { path: path.join(" "), end, name, name_y: end[1], colour, dashes })
        })
        .collect();
    lines.sort_by(|a, b| a.end[1].total_cmp(&b.end[1]));
    let places = spread(&lines.iter().map(|line| line.end[1]).collect::<Vec<_>>(), lower);
    lines.iter_mut().zip(places).for_each(|(line, place)| line.name_y = round_px(place));
    lines
}

/// Rising positions near the rising positions `wanted`, at least [`APART`] from each other and above the lower edge.
fn spread(wanted: &[f64], lower: f64) -> Vec<f64> {
    let mut places = wanted.to_vec();
    for i in 1..places.len() {
        places[i] = places[i].max(places[i - 1] + APART);
    }
    let mut most = lower;
    for place in places.iter_mut().rev() {
        *place = place.min(most);
        most = *place - APART;
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reports::sample;
    use crate::reports::sample::text_of_xml;

    #[test]
    fn names_keep_their_distance_and_their_order() {
        assert_eq!(spread(&[100.0, 101.0, 300.0], Y[1]), [100.0, 116.0, 300.0]);
        assert_eq!(spread(&[410.0, 419.0, 420.0], Y[1]), [388.0, 404.0, 420.0]);
        assert!(spread(&[], Y[1]).is_empty());
    }

    #[test]
    fn peers_are_dashed_and_equal_ratios_are_equal_lengths() {
        let times = sample::times();
        let drawing = Drawing::new(&times, Medium::Alone);
        let find = |name: &str| drawing.lines.iter().find(|line| line.name == name).unwrap();
        assert_eq!(find("scikit-learn").dashes, "7 4");
        assert_eq!((find("rbd").dashes, find("gp").dashes), ("", ""));
        // 1.1 us all along; 100 and 10000 points are the ends of the axis.
        let at = find("rbd").end[1];
        assert_eq!(find("rbd").path, format!("78,{at} 664,{at}"));
        // 0.1 to 10⁶ us are seven powers of ten: 1 ms is three below the top.
        assert_eq!(drawing.period, Some(round_px(92.0 + 328.0 * 3.0 / 7.0)));
        let in_page = Drawing::new(&times, Medium::Page);
        assert_eq!(in_page.period, Some(round_px(24.0 + 328.0 * 3.0 / 7.0)));
    }

    #[test]
    fn the_figure_is_xml_that_stands_alone_with_or_without_numbers() {
        let mut times = sample::times();
        let svg = times.figure().unwrap();
        let text = text_of_xml(&svg);
        for expected in ["7 joints of arm", "scikit-learn", "training points", "1000", "a machine"]
        {
            assert!(text.contains(expected), "{expected} is missing in {text}");
        }
        assert_eq!(svg.matches("http").count(), 1, "only the name space");
        times.curves.iter_mut().for_each(|curve| curve.points.clear());
        let svg = times.figure().unwrap();
        text_of_xml(&svg);
        assert!(!svg.contains("NaN") && !svg.contains("polyline"));
    }
}
