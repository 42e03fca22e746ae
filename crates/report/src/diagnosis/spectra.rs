use askama::Template;
use diagnosis::{JointReport, Verdict};

use crate::diagnosis::places::JointUnits;
use crate::diagnosis::report::Report;
use pages::{AxisTick, LogAxis, Medium, Palette, ReportError, render_html, shorten, significant};

/// Left and right, lower and upper edge of what a panel shows (px).
const X: [f64; 2] = [58.0, 330.0];
const Y: [f64; 2] = [168.0, 24.0];

/// Powers of ten that the densities span at most.
const MOST_DECADES: i32 = 8;

/// Powers of ten among which the named frequencies are sought (Hz).
const DECADES_HZ: std::ops::RangeInclusive<i32> = -3..=4;

/// Characters of a name.
const NAME_CHARACTERS: usize = 40;

/// What is left of the effort of every adequate joint and its noise with a source, as one-sided
/// densities over frequency: an SVG element a joint, in the order of the joints. The frequencies
/// have one axis, the densities one a joint; a joint without a density above zero has no panel.
///
/// # Errors
///
/// [`ReportError::Format`].
pub(crate) fn spectra(report: &Report) -> Result<Vec<String>, ReportError> {
    panels(report).iter().map(render_html).collect()
}

/// The spectra of one joint.
#[derive(Template)]
#[template(path = "diagnosis/spectrum.svg")]
struct Panel {
    name: String,
    /// Unit of the densities.
    unit: &'static str,
    /// For those who cannot see the lines.
    words: String,
    colours: Palette,
    x: [f64; 2],
    y: [f64; 2],
    x_ticks: Vec<AxisTick>,
    y_ticks: Vec<AxisTick>,
    /// The lines, as the `d` of a path.
    left: String,
    noise: String,
    /// Why there is no line of the noise; empty where there is one.
    note: &'static str,
}

fn panels(report: &Report) -> Vec<Panel> {
    let joints = report.diagnosis.joints.iter();
    let adequate = joints.filter(|joint| joint.verdict != Verdict::DataInadequate);
    let all_hz = adequate.clone().flat_map(|joint| joint.spectrum.hz.iter().copied());
    let Some(hz) = LogAxis::over(all_hz, X) else { return Vec::new() };
    let unit = |joint: &JointReport| JointUnits::of(report.robot, &joint.name).density;
    adequate.filter_map(|joint| panel(joint, unit(joint), hz)).collect()
}

fn panel(joint: &JointReport, unit: &'static str, hz: LogAxis) -> Option<Panel> {
    let spectrum = &joint.spectrum;
    let (left, noise) = (&spectrum.left_nm2_per_hz, &spectrum.noise_nm2_per_hz);
    let density = LogAxis::over_decades(left.iter().chain(noise).copied(), MOST_DECADES, Y)?;
    let path = |densities: &[f64]| path(&spectrum.hz, densities, [hz, density]);
    let (left_path, noise_path) = (path(left), path(noise));
    let is_drawn = !(left_path.is_empty() && noise_path.is_empty());
    is_drawn.then(|| Panel {
        name: shorten(&joint.name, NAME_CHARACTERS),
        unit,
        words: format!(
            "{}: what is left {} {unit}, noise {} {unit}, from {} Hz",
            joint.name,
            span(left),
            span(noise),
            span(&spectrum.hz)
        ),
        colours: Medium::Page.palette(),
        x: X,
        y: Y,
        x_ticks: ticks_hz(&hz),
        y_ticks: density.ticks().into_iter().filter(|tick| !tick.label.is_empty()).collect(),
        note: match (noise_path.is_empty(), noise.iter().any(|d| *d > 0.0)) {
            (false, _) => "",
            (true, true) => "the noise lies below",
            (true, false) => "noise not known over frequency",
        },
        left: left_path,
        noise: noise_path,
    })
}

/// A line through the points that lie on both axes, `M58 24 194 96`. What does not, such as a zero,
/// is a gap; a point between two gaps is a dot, `M194 96h0`.
fn path(hz: &[f64], densities: &[f64], [x, y]: [LogAxis; 2]) -> String {
    let place = |(&hz, &density): (&f64, &f64)| {
        (x.holds(hz) && y.holds(density)).then(|| format!("{} {}", x.at(hz), y.at(density)))
    };
    let places: Vec<Option<String>> = hz.iter().zip(densities).map(place).collect();
    let piece = |piece: &[Option<String>]| {
        let points: Vec<&str> = piece.iter().flatten().map(String::as_str).collect();
        match points.as_slice() {
            [] => String::new(),
            [only] => format!("M{only}h0"),
            _ => format!("M{}", points.join(" ")),
        }
    };
    places.split(Option::is_none).map(piece).collect()
}

/// One, two and five times the powers of ten that are on the axis (Hz).
fn ticks_hz(axis: &LogAxis) -> Vec<AxisTick> {
    let numbers = DECADES_HZ.flat_map(|decade| [1.0, 2.0, 5.0].map(|digit| (digit, decade)));
    let ticks = numbers.filter_map(|(digit, decade)| {
        let (hz, decimals) = (digit * 10_f64.powi(decade), (-decade).max(0) as usize);
        axis.holds(hz).then(|| AxisTick { at: axis.at(hz), label: format!("{hz:.decimals$}") })
    });
    ticks.collect()
}

/// The least and the largest of the positive numbers, in words.
fn span(values: &[f64]) -> String {
    let positive = values.iter().copied().filter(|v| *v > 0.0 && v.is_finite());
    let ends = (positive.clone().reduce(f64::min), positive.reduce(f64::max));
    let (Some(low), Some(high)) = ends else { return "none".to_owned() };
    format!("{} to {}", significant(low, 2), significant(high, 2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::{self, DiagnosisSample, text_of_xml};

    const HZ: [f64; 3] = [0.1, 1.0, 10.0];

    /// An arm whose shoulder has these densities of what is left and of the noise.
    fn with(left: [f64; 3], noise: [f64; 3]) -> DiagnosisSample {
        let mut sample = sample::arm();
        let spectrum = &mut sample.diagnosis.joints[0].spectrum;
        spectrum.hz = HZ.to_vec();
        (spectrum.left_nm2_per_hz, spectrum.noise_nm2_per_hz) = (left.to_vec(), noise.to_vec());
        sample
    }

    /// The lines of the shoulder and what is said where there is none of the noise.
    fn lines(left: [f64; 3], noise: [f64; 3]) -> [String; 3] {
        let panel = panels(&with(left, noise).report()).remove(0);
        [panel.left, panel.noise, panel.note.to_owned()]
    }

    #[test]
    fn equal_ratios_of_density_and_of_frequency_are_equal_lengths() {
        // Three powers of ten over 144 px, two over 272 px.
        let expected = ["M58 24 194 72 330 120", "M58 120 194 120 330 120", ""];
        assert_eq!(lines([1.0, 0.1, 0.01], [0.01; 3]), expected);
    }

    #[test]
    fn what_has_no_logarithm_is_a_gap() {
        let expected = ["M58 24h0M330 120h0", "", "noise not known over frequency"];
        assert_eq!(lines([1.0, 0.0, 0.01], [0.0; 3]), expected);
        let [left, noise, _] = lines([1.0, f64::NAN, f64::INFINITY], [-1.0, 0.01, 0.01]);
        assert_eq!([left.as_str(), &noise], ["M58 24h0", "M194 120 330 120"]);
    }

    #[test]
    fn noise_far_below_what_is_left_is_told_and_not_drawn_at_the_edge() {
        let [_, noise, note] = lines([1.0; 3], [1e-12; 3]);
        assert_eq!([noise.as_str(), &note], ["", "the noise lies below"]);
    }

    #[test]
    fn a_joint_without_a_density_or_without_data_has_no_panel() {
        assert!(panels(&with([0.0; 3], [0.0; 3]).report()).is_empty());
        let mut sample = with([1.0; 3], [0.1; 3]);
        assert_eq!(panels(&sample.report()).len(), 1);
        sample.diagnosis.joints[0].verdict = Verdict::DataInadequate;
        assert!(panels(&sample.report()).is_empty());
    }

    #[test]
    fn a_panel_has_a_name_units_and_round_frequencies() {
        let mut sample = with([1.0, 0.1, 0.01], [0.01; 3]);
        sample.diagnosis.joints[0].name = "a < \"b\"".into();
        let svg = spectra(&sample.report()).unwrap().remove(0);
        let text = text_of_xml(&svg);
        let words: Vec<_> = text.split_whitespace().collect();
        let (y, x) = (["0.001", "0.01", "0.1", "1"], ["0.1", "0.2", "0.5", "1", "2", "5", "10"]);
        let has = |part: &[&str]| words.windows(part.len()).any(|w| w == part);
        assert!(has(&y) && has(&x) && has(&["Hz"]) && has(&["(N·m)²/Hz"]), "{text}");
        assert!(svg.contains("noise 0.010 to 0.010 (N·m)²/Hz, from 0.10 to 10 Hz"), "{svg}");
        assert!(!svg.contains("a < ") && !svg.contains("NaN"), "{svg}");
    }
}
