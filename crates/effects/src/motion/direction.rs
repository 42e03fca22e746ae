/// Longest stand between two movements that counts as a reversal (s).
const BRIEF_S: f64 = 0.2;

/// Direction of a motion with speeds `qd`, in [-1, 1]: the sign of the speed. Below `rest` it is estimated as
/// follows.
///
/// Over a stand of at most 0.2 s the direction changes linearly from its value before to its value after: noise hides
/// the instant of the reversal, and friction is as large there as around it. In a longer stand, and in a stand at
/// either end of the run, the direction is `qd / rest`: a joint at rest holds less than its full friction.
pub(crate) fn direction(qd: impl Iterator<Item = f64>, rest: f64, period_s: f64) -> Vec<f64> {
    let mut direction: Vec<f64> = qd.map(|v| (v / rest).clamp(-1.0, 1.0)).collect();
    let mut moved = None;
    for t in 0..direction.len() {
        if direction[t].abs() < 1.0 {
            continue;
        }
        if let Some(last) = moved.replace(t) {
            turn(&mut direction[last..=t], period_s);
        }
    }
    direction
}

/// Interpolates linearly from the first to the last sample of a brief stretch.
fn turn(stretch: &mut [f64], period_s: f64) {
    let steps = stretch.len() - 1;
    if steps as f64 * period_s > BRIEF_S {
        return;
    }
    let (from, to) = (stretch[0], stretch[steps]);
    for (k, s) in stretch.iter_mut().enumerate() {
        *s = from + (to - from) * k as f64 / steps as f64;
    }
}

/// Samples in which a joint stands for longer than 0.2 s or at either end of the run. The friction that holds it
/// there may have any value up to its level.
pub(crate) fn stands(qd: &[f64], rest: f64, period_s: f64) -> Vec<bool> {
    let mut stands: Vec<bool> = qd.iter().map(|v| v.abs() < rest).collect();
    let brief = |from: usize, to: usize| (to - from + 1) as f64 * period_s <= BRIEF_S;
    let mut from = 0;
    while from < stands.len() {
        let length = stands[from..].iter().take_while(|s| **s == stands[from]).count();
        let end = from + length;
        if stands[from] && from > 0 && end < stands.len() && brief(from, end) {
            stands[from..end].fill(false);
        }
        from = end;
    }
    stands
}

#[cfg(test)]
mod tests {
    use super::{direction, stands};

    fn of(qd: &[f64]) -> Vec<f64> {
        direction(qd.iter().copied(), 1.0, 0.05)
    }

    #[test]
    fn a_brief_stand_turns_evenly_from_the_direction_before_to_the_one_after() {
        assert_eq!(of(&[3.0, 0.9, 0.8, -0.1, -2.0]), [1.0, 0.5, 0.0, -0.5, -1.0]);
        assert_eq!(of(&[-2.0, 0.1, -0.3, -2.0]), [-1.0; 4]);
    }

    #[test]
    fn a_long_stand_and_one_at_either_end_are_in_proportion_to_the_speed() {
        let long = [2.0, 0.5, 0.25, 0.0, -0.25, -0.5, -2.0];
        assert_eq!(of(&long), [1.0, 0.5, 0.25, 0.0, -0.25, -0.5, -1.0]);
        assert_eq!(of(&[0.5, 2.0, 0.25]), [0.5, 1.0, 0.25]);
    }

    #[test]
    fn a_joint_stands_where_it_is_slow_for_long_or_at_either_end() {
        let qd = [2.0, 0.5, 0.25, 0.0, -0.25, -0.5, -2.0, -0.5, 2.0, 0.0];
        let long = [false, true, true, true, true, true, false, false, false, true];
        assert_eq!(stands(&qd, 1.0, 0.05), long);
    }
}
