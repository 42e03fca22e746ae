use std::ops::Range;

use logs::Run;
use robot::Robot;

use crate::observation::{Observation, ObservationKind, RunStretch};
use crate::pieces::usual_step;
use crate::thresholds::{InspectionThresholds, MomentThresholds};

/// Signals that stand still while time goes on, and the rows that they spoil.
///
/// A joint that comes to rest has small steps before it stands. A freeze breaks the motion off, or the motion goes on
/// elsewhere when the freeze ends.
pub(crate) fn frozen(
    robot: &Robot,
    run: &Run,
    index: usize,
    t: &InspectionThresholds,
) -> (Vec<Observation>, Vec<Range<usize>>) {
    let usual = usual_step(&run.time);
    let rows = |s: f64| {
        if usual > 0.0 { ((s / usual) as usize).max(t.moments.held_rows) } else { usize::MAX }
    };
    let mut spoilt = Vec::new();
    let mut observations = Vec::new();
    for rows in constant_rows(run, rows(t.moments.held_s)) {
        if (0..run.joints.len()).any(|j| breaks_off(run, j, &rows, t)) {
            let stretches = vec![RunStretch::of_rows(run, index, &rows)];
            observations.push(Observation {
                kind: ObservationKind::Held,
                joints: (0..run.joints.len()).collect(),
                ..Observation::of_seconds(ObservationKind::Held, 0, stretches)
            });
            spoilt.push(rows);
        }
    }
    for j in 0..run.joints.len() {
        for rows in still(&run.joints[j].position, rows(t.moments.stuck_s)) {
            let known =
                spoilt.iter().any(|s: &Range<usize>| s.start <= rows.end && rows.start <= s.end);
            let rotates = robot.links().get(j).is_none_or(|link| link.joint.kind.is_rotation());
            let least = t.moves[usize::from(!rotates)];
            let broken =
                breaks_off(run, j, &rows, t) || has_speed(run, j, &rows, least, &t.moments);
            if !known
                && range(&run.joints[j].position) > least
                && broken
                && goes_on(run, j, &rows, t.moments.goes_on)
            {
                observations.push(Observation::of_seconds(
                    ObservationKind::StuckEncoder,
                    j,
                    vec![RunStretch::of_rows(run, index, &rows)],
                ));
                spoilt.push(rows);
            }
        }
    }
    (observations, spoilt)
}

/// Runs of rows in which a signal has exactly one value, `least` or more.
fn still(x: &[f64], least: usize) -> Vec<Range<usize>> {
    same(x.len(), least, |k| x[k].to_bits() == x[k - 1].to_bits())
}

/// Rows in which all positions and efforts have exactly one value.
fn constant_rows(run: &Run, least: usize) -> Vec<Range<usize>> {
    same(run.time.len(), least, |k| {
        run.joints.iter().all(|joint| {
            joint.position[k].to_bits() == joint.position[k - 1].to_bits()
                && joint.effort[k].to_bits() == joint.effort[k - 1].to_bits()
        })
    })
}

fn same(length: usize, least: usize, is_same: impl Fn(usize) -> bool) -> Vec<Range<usize>> {
    let mut all = Vec::new();
    let mut start = 0;
    for k in 1..=length {
        if k == length || !is_same(k) {
            if k - start >= least {
                all.push(start..k);
            }
            start = k;
        }
    }
    all
}

/// Whether a joint's motion breaks off between two rows, or goes on elsewhere.
///
/// ```text
/// step into the freeze > freeze[0] x the largest change from a step to the next, elsewhere
/// step out of it       > freeze[1] x the largest step elsewhere
/// ```
///
/// with steps over one row, or the mean of three for an encoder of coarse steps. A joint that brakes has small
/// steps before it rests.
fn breaks_off(run: &Run, j: usize, rows: &Range<usize>, t: &InspectionThresholds) -> bool {
    let q = &run.joints[j].position;
    let [stops, resumes] = t.moments.freeze;
    let beside = |k: usize| {
        k + t.moments.beside_freeze < rows.start || k > rows.end + t.moments.beside_freeze
    };
    let usual = usual_step(&run.time);
    // Over a gap a step is as large as the gap is long; stamps with jitter say nothing of when a row was read.
    let step = |k: usize, span: usize| {
        let rows = ((run.time[k] - run.time[k - span]) / usual).round().max(span as f64);
        (q[k] - q[k - span]) / rows
    };
    let largest =
        (1..q.len()).filter(|&k| beside(k)).fold(0.0_f64, |most, k| most.max(step(k, 1).abs()));
    if rows.end < q.len() && largest > 0.0 && step(rows.end, 1).abs() > resumes * largest {
        return true;
    }
    let breaks = |span: usize| {
        let change = |k: usize| (step(k + span, span) - step(k, span)).abs();
        let all = (span..q.len().saturating_sub(span)).filter(|&k| beside(k));
        let usual = all.fold(0.0_f64, |most, k| most.max(change(k)));
        rows.start >= span && usual > 0.0 && step(rows.start, span).abs() > stops * usual
    };
    t.moments.step_rows.into_iter().any(breaks)
}

/// Whether the velocity column of a joint shows motion while its position stands still, over more than the steps of the
/// encoder that a slow joint may stay within.
///
/// ```text
/// way = sum |qd| over the freeze * sum |dq| elsewhere / sum |qd| elsewhere
/// ```
///
/// which holds for any unit of time.
fn has_speed(run: &Run, j: usize, rows: &Range<usize>, least: f64, t: &MomentThresholds) -> bool {
    let joint = &run.joints[j];
    let Some(velocity) = joint.velocity.as_deref() else { return false };
    let steps: Vec<f64> = joint.position.windows(2).map(|q| (q[1] - q[0]).abs()).collect();
    let count = steps.iter().copied().filter(|s| *s > 0.0).fold(f64::INFINITY, f64::min);
    let speed = |v: &[f64]| v.iter().map(|v| v.abs()).sum::<f64>();
    let here = speed(&velocity[rows.clone()]);
    let way = here * steps.iter().sum::<f64>() / (speed(velocity) - here);
    way.is_finite()
        && way > (t.stuck_counts * count).max(least)
        && way > t.hidden_way * range(&joint.position)
}

/// Whether another signal shows that the arm moves on: another position, or the effort of the joint.
fn goes_on(run: &Run, j: usize, rows: &Range<usize>, least: f64) -> bool {
    let of = |x: &[f64]| range(&x[rows.clone()]) > least * range(x) && range(x) > 0.0;
    of(&run.joints[j].effort)
        || run.joints.iter().enumerate().any(|(k, joint)| k != j && of(&joint.position))
}

fn range(x: &[f64]) -> f64 {
    let low = x.iter().copied().fold(f64::INFINITY, f64::min);
    x.iter().copied().fold(f64::NEG_INFINITY, f64::max) - low
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{pendulum, swing};

    fn observe(run: &Run) -> Vec<ObservationKind> {
        let (observations, _) = frozen(&pendulum(), run, 0, &InspectionThresholds::default());
        observations.iter().map(|o| o.kind).collect()
    }

    /// At row 1000 the pendulum swings at half a radian per second or more.
    #[test]
    fn an_encoder_that_stops_in_motion_is_stuck() {
        let mut run = swing(0.3);
        assert_eq!(observe(&run), []);
        let q = &mut run.joints[0].position;
        let still = q[1000];
        q[1000..].fill(still);
        run.joints[0].velocity = None;
        assert_eq!(observe(&run), [ObservationKind::StuckEncoder]);
    }

    #[test]
    fn a_joint_that_comes_to_rest_is_not_stuck() {
        let mut run = swing(0.3);
        let turns = run.joints[0].velocity.as_ref().unwrap();
        let rest = (1000..).find(|&k| turns[k] * turns[k + 1] <= 0.0).unwrap();
        let q = &mut run.joints[0].position;
        let still = q[rest];
        q[rest..].fill(still);
        run.joints[0].velocity = None;
        assert_eq!(observe(&run), []);
    }

    #[test]
    fn all_signals_that_stop_in_motion_are_held() {
        let mut run = swing(0.3);
        let joint = &mut run.joints[0];
        for signal in [&mut joint.position, &mut joint.effort] {
            let still = signal[1000];
            signal[1000..1500].fill(still);
        }
        assert_eq!(observe(&run), [ObservationKind::Held]);
    }
}
