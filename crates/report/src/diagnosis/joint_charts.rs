use std::ops::Range;

use diagnosis::{JointTraces, RunTraces};

use crate::diagnosis::places::JointUnits;
use crate::diagnosis::report::Report;
use crate::diagnosis::tables::known_floor;
use colours::Role;
use pages::{Axis, Chart, CurveShape, Series, column_extremes, percentile_bands};

/// Size of a figure over time and of one of three beside each other (px).
const WIDE: (f64, f64) = (1040.0, 180.0);
const NARROW: (f64, f64) = (345.0, 180.0);

/// Height of what is left over time (px).
const LOW: f64 = 110.0;

/// A stretch that begins within this share of its end is shown from zero.
const NEAR: f64 = 0.1;

/// Length of the stretch that is shown enlarged (s).
const DETAIL_S: f64 = 8.0;

/// Periods of the cut-off at either end of a run that are not drawn over time: efforts are low-passed from a run's first sample
/// to its last, where they have not settled.
const EDGE_PERIODS: f64 = 1.0;

/// Points that all figures over time may hold together; about ten bytes each.
const POINTS_IN_ALL: usize = 90_000;

/// Slices of velocity, position or load.
const SLICES: usize = 40;

/// The figures of one joint.
pub(crate) struct JointFigures {
    /// The worst stretch enlarged, if the runs are longer than it, then run by run: torque over
    /// time, and below it what the models leave of it.
    pub time: Vec<[Chart; 2]>,
    /// What is left against velocity, position and load, over all runs.
    pub residual: Vec<Chart>,
}

/// The signals of a joint in a run, and the samples that are drawn over time.
type Part<'a> = (&'a RunTraces, &'a JointTraces, Range<usize>);

fn runs_of<'a>(report: &Report<'a>, joint: usize) -> Vec<Part<'a>> {
    let edge_s = EDGE_PERIODS / report.diagnosis.data.cutoff_hz;
    let of =
        |run: &'a RunTraces| Some((run, run.joints.get(joint)?, inner_samples(&run.time, edge_s)));
    report.traces.iter().filter_map(of).collect()
}

/// The samples farther than `edge_s` (s) from both ends of a run; all where none is, or the edge has no length.
fn inner_samples(time: &[f64], edge_s: f64) -> Range<usize> {
    let ends = time.first().zip(time.last()).filter(|_| edge_s.is_finite() && edge_s > 0.0);
    let inner = ends.map(|(first, last)| {
        let begin = time.partition_point(|t| *t < first + edge_s);
        begin..time.partition_point(|t| *t <= last - edge_s)
    });
    inner.filter(|inner| inner.start < inner.end).unwrap_or(0..time.len())
}

/// The torque of one joint over the stretch of [`DETAIL_S`] where the nominal model errs
/// most, over the worst run where all are shorter; with the name of its run.
pub(crate) fn worst_of<'a>(report: &Report<'a>, joint: usize) -> Option<(Chart, &'a str)> {
    let name = &report.diagnosis.joints.get(joint)?.name;
    let runs = runs_of(report, joint);
    let (run, trace, part) = worst_stretch(&runs).or_else(|| worst_run(&runs))?;
    let units = JointUnits::of(report.robot, name);
    let chart = over_time(worst_title(name, run), units, slice_of(run, trace, part), 400);
    (!chart.is_empty()).then_some((chart, run.name.as_str()))
}

fn worst_title(joint: &str, run: &RunTraces) -> String {
    format!("Torque of {joint}, where the nominal model errs most: {}", run.name)
}

/// The figures of the joint with this index; those without data are left out.
pub(crate) fn figures_of(report: &Report, joint: usize) -> JointFigures {
    let Some(name) = report.diagnosis.joints.get(joint).map(|j| j.name.as_str()) else {
        return JointFigures { time: Vec::new(), residual: Vec::new() };
    };
    let units = JointUnits::of(report.robot, name);
    let curves = 6 * report.traces.len().max(1) * report.diagnosis.joints.len();
    let width = (POINTS_IN_ALL / curves).clamp(60, 400);
    let runs = runs_of(report, joint);
    let floor = report.diagnosis.joints.get(joint).and_then(known_floor);
    let both = |title: String, stretch: Stretch| {
        let left = left_over_time(units, &stretch, (width, floor));
        [over_time(title, units, stretch, width), left]
    };
    let detail = worst_stretch(&runs)
        .map(|(run, trace, part)| both(worst_title(name, run), slice_of(run, trace, part)));
    let whole = runs.iter().map(|(run, trace, part)| {
        let title = format!("Torque of {name}: {}", run.name);
        both(title, slice_of(run, trace, part.clone()))
    });
    let mut time: Vec<[Chart; 2]> = detail.into_iter().chain(whole).collect();
    time.retain(|[torque, _]| !torque.is_empty());

    let nominal = format!("nominal {}", units.load);
    let against: [(&str, &'static str, Signal); 3] = [
        ("velocity", units.velocity, |t| &t.velocity),
        ("position", units.position, |t| &t.position),
        (nominal.as_str(), units.effort, |t| &t.nominal),
    ];
    let residual = against.into_iter().map(|(label, unit, signal)| {
        let x = Axis::new(label, unit);
        residual_against(format!("Residual of {name} against {label}"), x, units, &runs, signal)
    });
    JointFigures { time, residual: residual.filter(|chart| !chart.is_empty()).collect() }
}

type Signal = fn(&JointTraces) -> &Vec<f64>;

/// Time and the three torques over a stretch of a run.
struct Stretch<'a> {
    time: &'a [f64],
    torques: [(Role, &'a [f64]); 3],
}

fn slice_of<'a>(run: &'a RunTraces, trace: &'a JointTraces, part: Range<usize>) -> Stretch<'a> {
    let slice = |values: &'a [f64]| values.get(part.clone()).unwrap_or(&[]);
    Stretch {
        time: slice(&run.time),
        torques: [
            (Role::Measured, slice(&trace.measured)),
            (Role::Nominal, slice(&trace.nominal)),
            (Role::Extended, slice(&trace.extended)),
        ],
    }
}

/// The axis of time: from zero where the stretch begins near it.
fn time_axis(time: &[f64]) -> Axis {
    match (time.first(), time.last()) {
        (Some(first), Some(last)) if *first > 0.0 && *first < NEAR * last => {
            Axis::from_zero("time", "s")
        }
        _ => Axis::new("time", "s"),
    }
}

fn over_time(title: String, units: JointUnits, stretch: Stretch, width: usize) -> Chart {
    let line = |(role, torque): (Role, &[f64])| {
        let points: Vec<[f64; 2]> =
            stretch.time.iter().zip(torque).map(|(&t, &tau)| [t, tau]).collect();
        Series::of(role, CurveShape::Line(column_extremes(&points, width)))
    };
    Chart {
        title,
        x: time_axis(stretch.time),
        y: Axis::new(units.load, units.effort),
        series: stretch.torques.into_iter().map(line).collect(),
        floor: None,
        size: WIDE,
    }
}

/// Measured minus nominal and measured minus extended torque, with the noise about zero.
fn left_over_time(
    units: JointUnits,
    stretch: &Stretch,
    (width, floor): (usize, Option<f64>),
) -> Chart {
    let [(_, measured), models @ ..] = stretch.torques;
    let line = |(role, predicted): (Role, &[f64])| {
        let left = measured.iter().zip(predicted).map(|(m, p)| m - p);
        let points: Vec<[f64; 2]> =
            stretch.time.iter().copied().zip(left).map(Into::into).collect();
        Series::of(role, CurveShape::Line(column_extremes(&points, width)))
    };
    Chart {
        title: format!("What the models leave of the {}", units.load),
        x: time_axis(stretch.time),
        y: Axis::new("measured − model", units.effort),
        series: models.into_iter().map(line).collect(),
        floor,
        size: (WIDE.0, LOW),
    }
}

/// The run in which the nominal residual has the most power.
fn worst_run<'a>(runs: &[Part<'a>]) -> Option<Part<'a>> {
    let power = |(_, trace, part): &&Part| power_of_residual(trace, part.clone());
    runs.iter().max_by(|a, b| power(a).total_cmp(&power(b))).cloned()
}

/// The stretch of [`DETAIL_S`] in which the nominal residual has the most power; none when
/// no run is twice as long.
fn worst_stretch<'a>(runs: &[Part<'a>]) -> Option<Part<'a>> {
    let mut worst = None;
    let mut most = 0.0;
    for (run, trace, drawn) in runs {
        let (Some(first), Some(last)) = (run.time.first(), run.time.last()) else { continue };
        if last - first < 2.0 * DETAIL_S {
            continue;
        }
        let length = (DETAIL_S / (last - first) * run.time.len() as f64) as usize;
        let last_start = drawn.end.saturating_sub(length);
        for start in (drawn.start..=last_start).step_by((length / 2).max(1)) {
            let part = start..start + length;
            let power = power_of_residual(trace, part.clone());
            if power > most {
                most = power;
                worst = Some((*run, *trace, part));
            }
        }
    }
    worst
}

fn power_of_residual(trace: &JointTraces, part: Range<usize>) -> f64 {
    let (measured, nominal) = (trace.measured.get(part.clone()), trace.nominal.get(part));
    let pairs = measured.unwrap_or(&[]).iter().zip(nominal.unwrap_or(&[]));
    pairs.map(|(m, n)| (m - n).powi(2)).filter(|p| p.is_finite()).sum()
}

fn residual_against(
    title: String,
    x: Axis,
    units: JointUnits,
    runs: &[Part],
    signal: Signal,
) -> Chart {
    let all =
        |of: Signal| -> Vec<f64> { runs.iter().flat_map(|(_, t, _)| of(t).clone()).collect() };
    let (signal, measured) = (all(signal), all(|t| &t.measured));
    let mut areas = Vec::new();
    let mut lines = Vec::new();
    for (role, predicted) in
        [(Role::Nominal, all(|t| &t.nominal)), (Role::Extended, all(|t| &t.extended))]
    {
        let left: Vec<f64> = measured.iter().zip(&predicted).map(|(m, p)| m - p).collect();
        let bands = percentile_bands(&signal, &left, SLICES);
        let area = bands.iter().map(|&[x, low, _, high]| [x, low, high]).collect();
        let line = bands.iter().map(|&[x, _, middle, _]| [x, middle]).collect();
        areas.push(Series::of(role, CurveShape::Band(area)));
        lines.push(Series::of(role, CurveShape::Line(line)));
    }
    areas.append(&mut lines);
    let y = Axis::new("measured − model", units.effort);
    Chart { title, x, y, series: areas, floor: None, size: NARROW }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    #[test]
    fn every_run_and_every_view_has_a_figure_that_keeps_the_spike() {
        let sample = sample::arm();
        let figures = figures_of(&sample.report(), 0);
        assert_eq!(figures.time.len(), 3, "one enlarged, two runs");
        assert_eq!(figures.residual.len(), 3);
        let CurveShape::Line(measured) = &figures.time[1][0].series[0].shape else {
            panic!("no line")
        };
        let highest = measured.iter().map(|p| p[1]).fold(0.0, f64::max);
        assert!(highest > 10.0, "{highest}");
    }

    #[test]
    fn what_the_filter_has_not_settled_on_is_not_drawn() {
        let mut sample = sample::arm();
        sample.diagnosis.data.cutoff_hz = 8.0;
        for trace in &mut sample.traces[0].joints {
            // 40 samples are .2 s; a period of the cut-off is .125 s.
            let last = trace.measured.len() - 1;
            (trace.measured[20], trace.measured[last - 20]) = (900.0, 900.0);
            (trace.measured[40], trace.measured[last - 40]) = (700.0, 700.0);
        }
        for chart in figures_of(&sample.report(), 0).time.iter().flatten() {
            for series in &chart.series {
                let CurveShape::Line(points) = &series.shape else { continue };
                assert!(points.iter().all(|[_, y]| *y < 800.0), "{}", chart.title);
            }
        }
        let time: Vec<f64> = (0..100).map(f64::from).collect();
        assert_eq!(inner_samples(&time, 10.0), 10..90);
        assert_eq!(
            [inner_samples(&time, 60.0), inner_samples(&time, f64::INFINITY)],
            [0..100, 0..100]
        );
        assert_eq!(inner_samples(&[], 1.0), 0..0);
    }

    #[test]
    fn what_is_left_stands_below_the_torque_with_the_noise() {
        let mut sample = sample::arm();
        sample.diagnosis.joints[0].noise_floor_from = diagnosis::NoiseFloorSource::Effort;
        sample.diagnosis.joints[0].noise_floor_rms_nm = 0.02;
        let trace = &mut sample.traces[0].joints[0];
        trace.measured.iter_mut().for_each(|m| *m = 3.0);
        trace.nominal.iter_mut().for_each(|n| *n = 1.0);
        trace.extended.iter_mut().for_each(|e| *e = 2.5);
        let [torque, left] = &figures_of(&sample.report(), 0).time[1];
        let values: Vec<f64> = left
            .series
            .iter()
            .map(|series| match &series.shape {
                CurveShape::Line(points) => points[0][1],
                CurveShape::Band(_) => f64::NAN,
            })
            .collect();
        assert_eq!((values, left.floor, torque.floor), (vec![2.0, 0.5], Some(0.02), None));
    }

    #[test]
    fn time_begins_at_zero_where_a_run_does() {
        let begin = |time: &[f64]| time_axis(time).begin;
        assert_eq!(begin(&[0.33, 15.0]), pages::AxisBegin::Zero);
        assert_eq!(begin(&[7.0, 15.0]), pages::AxisBegin::Least);
        assert_eq!(begin(&[]), pages::AxisBegin::Least);
    }

    #[test]
    fn a_joint_without_traces_has_no_figures() {
        let mut sample = sample::arm();
        sample.traces.clear();
        let figures = figures_of(&sample.report(), 0);
        assert!(figures.time.is_empty() && figures.residual.is_empty());
    }
}
