use robot::{Actuator, PdGain};

use crate::runs::run::{Channels, GoalEffort, median};

/// Computes the effort that a servo's position loop commands, for logs without effort (N m or N).
///
/// ```text
/// effort[k] = kp (goal(t[k] - delay) - q[k]) - kd qd[k]
/// qd[k]     = (58 (q[k+1] - q[k-1]) + 67 (q[k+2] - q[k-2]) - 22 (q[k+3] - q[k-3])) / (252 dt)
/// ```
///
/// `goal` is `desired_position`. Where the description says how long a goal is held, it is its mean over half a row either
/// way, or the goal of half a hold before where goals are renewed more often than rows are logged. `delay` is that of the
/// description. `qd` is the velocity column where the log has one, else the slope of the quartic through seven positions
/// (Savitzky & Golay 1964), which passes less noise than `(q[k+1] - q[k-1]) / (t[k+1] - t[k-1])` and is exact to the fourth
/// order. The latter stands at the ends and in rows at uneven times, one-sided at the first and the last sample. Without a
/// goal there is no effort.
pub(crate) fn compute_effort(drive: &Actuator, time: &[f64], channels: &mut Channels) {
    let Some(PdGain { kp, kd }) = drive.position_loop else { return };
    let q = &channels.position;
    let goals = channels.desired_position.as_ref();
    let goals = goals.map(|goal| followed_goals(time, goal, drive));
    let qd = channels.velocity.clone().unwrap_or_else(|| velocity(time, q));
    let effort = |(k, goal): (usize, &f64)| kp * (goal - q[k]) - kd * qd[k];
    channels.effort = goals.iter().flatten().enumerate().map(effort).collect();
    channels.goal_effort = goals.map(|goals| GoalEffort {
        values: goals.iter().map(|goal| kp * goal).collect(),
        lead: 0,
        delay_s: drive.goal_delay_s,
    });
}

fn velocity(time: &[f64], q: &[f64]) -> Vec<f64> {
    let steps = steps(time);
    let usual = median(&steps);
    let last = time.len().saturating_sub(1);
    let is_even = |k: usize| {
        let reach = QUARTIC.len();
        let around = k.checked_sub(reach).and_then(|first| steps.get(first..k + reach));
        around.is_some_and(|s| s.iter().all(|step| (step - usual).abs() < SAME_RATE * usual))
    };
    let slope = |k: usize| {
        let pairs = QUARTIC.iter().enumerate().map(|(i, c)| c * (q[k + i + 1] - q[k - i - 1]));
        pairs.sum::<f64>() / usual
    };
    let difference = |k: usize| {
        let (before, after) = (k.saturating_sub(1), (k + 1).min(last));
        let step = time[after] - time[before];
        if step > 0.0 { (q[after] - q[before]) / step } else { 0.0 }
    };
    (0..time.len()).map(|k| if is_even(k) { slope(k) } else { difference(k) }).collect()
}

/// Weights of the differences over two, four and six rows in the slope of a quartic.
const QUARTIC: [f64; 3] = [58.0 / 252.0, 67.0 / 252.0, -22.0 / 252.0];

fn steps(time: &[f64]) -> Vec<f64> {
    time.windows(2).map(|t| t[1] - t[0]).collect()
}

/// The goals that a loop follows. Before the first row its goal was held.
fn followed_goals(time: &[f64], goal: &[f64], drive: &Actuator) -> Vec<f64> {
    let steps = steps(time);
    let row_s = median(&steps);
    if row_s.is_nan() || row_s <= 0.0 {
        return goal.to_vec();
    }
    match drive.goal_hold_s {
        Some(hold_s) if hold_s >= (1.0 - SAME_RATE) * row_s => {
            held_means(time, goal, &steps, [drive.goal_delay_s, row_s])
        }
        shorter => {
            let late_s = drive.goal_delay_s + 0.5 * shorter.unwrap_or(0.0);
            time.iter().map(|t| interpolate(time, goal, t - late_s)).collect()
        }
    }
}

/// Share by which rates of goals and rows, or two steps of a clock, may differ and be the same.
const SAME_RATE: f64 = 0.01;

/// The goal at a time, on lines between the rows.
fn interpolate(time: &[f64], goal: &[f64], at: f64) -> f64 {
    let next = time.partition_point(|t| *t <= at).min(time.len() - 1);
    let row = next.saturating_sub(1);
    let step = time[next] - time[row];
    let share = if step > 0.0 { ((at - time[row]) / step).clamp(0.0, 1.0) } else { 0.0 };
    goal[row] + share * (goal[next] - goal[row])
}

/// Means over a row, about each time less the delay, of goals that are held from row to row.
fn held_means(time: &[f64], goal: &[f64], steps: &[f64], [delay_s, row_s]: [f64; 2]) -> Vec<f64> {
    let mut integrals = vec![0.0; time.len()];
    for (k, step) in steps.iter().enumerate() {
        integrals[k + 1] = integrals[k] + goal[k] * step;
    }
    let integral = |t: f64| {
        let row = time.partition_point(|time| *time <= t).saturating_sub(1);
        integrals[row] + goal[row] * (t - time[row])
    };
    let mean = |t: &f64| {
        let [from, until] = [-0.5, 0.5].map(|half| integral(t - delay_s + half * row_s));
        (until - from) / row_s
    };
    time.iter().map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn loop_of(kp: f64, kd: f64, goal_delay_s: f64) -> Actuator {
        Actuator { position_loop: Some(PdGain { kp, kd }), goal_delay_s, ..Actuator::default() }
    }

    fn effort(drive: &Actuator, time: &[f64], mut channels: Channels) -> Vec<f64> {
        compute_effort(drive, time, &mut channels);
        channels.effort
    }

    #[test]
    fn the_effort_is_that_of_the_loop() {
        let channels = Channels {
            position: vec![0.0, 1.0, 4.0],
            desired_position: Some(vec![1.0, 1.0, 1.0]),
            ..Channels::default()
        };
        let (drive, time) = (loop_of(10.0, 2.0, 0.0), [0.0, 1.0, 3.0]);
        assert_eq!(effort(&drive, &time, channels.clone()), [8.0, -8.0 / 3.0, -33.0]);
        let channels = Channels { velocity: Some(vec![0.5; 3]), ..channels };
        assert_eq!(effort(&drive, &time, channels), [9.0, -1.0, -31.0]);
    }

    /// The slope of `t^4 - t^2 + t` in even rows, but for three at either end.
    #[test]
    fn the_velocity_of_a_quartic_is_exact() {
        let time: Vec<f64> = (0..30).map(|k| 0.02 * f64::from(k)).collect();
        let q: Vec<f64> = time.iter().map(|t| t.powi(4) - t * t + t).collect();
        let qd = velocity(&time, &q);
        for (qd, t) in qd.iter().zip(&time).skip(3).take(24) {
            let expected = 4.0 * t.powi(3) - 2.0 * t + 1.0;
            assert!((qd - expected).abs() < 1e-10, "{qd}, not {expected} at {t} s");
        }
    }

    /// A ramp of 3 rad/s in rows of .1 s: late by the delay, and by half the time for which each goal is held.
    #[test]
    fn goals_are_held_and_late() {
        let time: Vec<f64> = (0..40).map(|k| 0.1 * f64::from(k)).collect();
        let goal: Vec<f64> = time.iter().map(|t| 3.0 * t).collect();
        let holds = [(None, 0.0), (Some(0.02), 0.01), (Some(0.1), 0.05), (Some(0.5), 0.05)];
        for ((goal_hold_s, half), delay_s) in
            holds.into_iter().flat_map(|h| [0.0, 0.03, 0.25].map(|d| (h, d)))
        {
            let (position, desired_position) = (vec![0.0; 40], Some(goal.clone()));
            let channels = Channels { position, desired_position, ..Channels::default() };
            let drive = Actuator { goal_hold_s, ..loop_of(2.0, 0.0, delay_s) };
            let effort = effort(&drive, &time, channels);
            for (effort, t) in effort.iter().zip(&time).skip(5) {
                let expected = 2.0 * 3.0 * (t - delay_s - half);
                assert!((effort - expected).abs() < 1e-6, "{effort}, not {expected}, {delay_s} s");
            }
        }
    }

    /// Ten rows a goal: the staircase itself is logged, and is followed as it is with or without a described hold.
    #[test]
    fn a_staircase_of_goals_is_followed_as_it_is_logged() {
        let time: Vec<f64> = (0..200).map(|k| 0.01 * f64::from(k)).collect();
        let goal: Vec<f64> = (0..200).map(|k| f64::from(k / 10)).collect();
        let (position, desired_position) = (vec![0.0; 200], Some(goal.clone()));
        let channels = Channels { position, desired_position, ..Channels::default() };
        for goal_hold_s in [None, Some(0.1)] {
            let drive = Actuator { goal_hold_s, ..loop_of(1.0, 0.0, 0.0) };
            let effort = effort(&drive, &time, channels.clone());
            let mut inside = (1..200).filter(|k| k % 10 != 0);
            assert!(inside.all(|k| (effort[k] - goal[k]).abs() < 1e-9), "{goal_hold_s:?}");
        }
    }
}
