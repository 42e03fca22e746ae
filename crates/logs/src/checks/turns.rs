use std::f64::consts::TAU;

use crate::runs::run::median;

/// Largest distance of a link from its motor (rad), far more than any transmission deflects.
const APART: f64 = 0.5;

/// Adds full turns to the position of a rotation's link (rad), so that it is on the turn of its motor's `position`.
/// A single-turn encoder starts again at zero after each turn.
///
/// ```text
/// link + 2 pi round((position - link) / 2 pi)
/// ```
///
/// A link position that is still far from the motor's after that is left unchanged: it belongs to another link.
pub(crate) fn to_turn_of(position: &[f64], link: Vec<f64>) -> Vec<f64> {
    let to_turn = |(q, link): (&f64, &f64)| {
        let turns = ((q - link) / TAU).round();
        if turns.abs() > 0.0 { link + TAU * turns } else { *link }
    };
    let found: Vec<f64> = position.iter().zip(&link).map(to_turn).collect();
    let keeps = found.iter().zip(position).all(|(link, q)| (link - q).abs() < APART);
    if keeps { found } else { link }
}

/// A position after removal of the full turns by which it jumped.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Unwrapped {
    /// The position (rad).
    pub position: Vec<f64>,
    /// The samples after each jump.
    pub jumps: Vec<usize>,
}

/// Removes from a rotation's position (rad) the full turns by which a counter jumps; `None` without such jumps.
///
/// ```text
/// n = round(step / 2 pi) /= 0,   |n| <= 4096,   |step - 2 pi n| < 10 usual steps,   |step| > 10 usual steps
/// ```
///
/// The usual step is the largest of all but one in fifty. The rest of a jump, without its turns, is thus a step of the
/// motion. Steps are counted in rows of the usual clock.
pub(crate) fn unwrap_turns(time: &[f64], position: &[f64]) -> Option<Unwrapped> {
    const USUAL_STEPS: f64 = 10.0;
    /// Most turns that a multi-turn encoder counts, with 12 bits. A larger jump is not one of a counter.
    const MOST_TURNS: f64 = 4096.0;
    /// Bounds of the rest of a jump after removal of its turns (rad).
    const LEFT: [f64; 2] = [0.02, 0.5];
    if position.len() < 3 || time.len() != position.len() {
        return None;
    }
    let times: Vec<f64> = time.windows(2).map(|t| t[1] - t[0]).collect();
    let usual_s = median(&times);
    let rows = |k: usize| (times[k - 1] / usual_s).round().max(1.0);
    let step = |k: usize| position[k] - position[k - 1];
    let mut sizes: Vec<f64> = (1..position.len()).map(|k| step(k).abs() / rows(k)).collect();
    let at = (0.98 * (sizes.len() - 1) as f64) as usize;
    let usual = *sizes.select_nth_unstable_by(at, f64::total_cmp).1;
    let mut found = Unwrapped { position: position.to_vec(), jumps: Vec::new() };
    let mut turns = 0.0;
    for k in 1..position.len() {
        let near = USUAL_STEPS * usual * rows(k);
        let full = (step(k) / TAU).round();
        let left = (step(k) - full * TAU).abs();
        let counts = full.abs() > 0.0 && full.abs() <= MOST_TURNS;
        if counts && left < near.clamp(LEFT[0], LEFT[1]) && step(k).abs() > near {
            turns += full;
            found.jumps.push(k);
        }
        found.position[k] -= turns * TAU;
    }
    (!found.jumps.is_empty()).then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn swing() -> Vec<f64> {
        (0..1000).map(|k| 5.0 * (0.01 * f64::from(k)).sin()).collect()
    }

    #[test]
    fn an_encoder_of_one_turn_is_taken_to_that_of_its_motor() {
        let link: Vec<f64> = swing().iter().map(|q| q - 0.01).collect();
        let wrapped = link.iter().map(|q| q.rem_euclid(TAU)).collect();
        let found = to_turn_of(&swing(), wrapped);
        assert!(found.iter().zip(&link).all(|(a, b)| (a - b).abs() < 1e-12));
        assert_eq!(to_turn_of(&swing(), link.clone()), link);
    }

    #[test]
    fn what_does_not_keep_to_the_motor_stays_as_it_is() {
        let reversed: Vec<f64> = swing().iter().map(|q| -q).collect();
        assert_eq!(to_turn_of(&swing(), reversed.clone()), reversed);
    }

    #[test]
    fn a_counter_of_one_turn_is_unwrapped_and_a_motion_is_left_alone() {
        let time: Vec<f64> = (0..1000).map(|k| 0.002 * f64::from(k)).collect();
        assert_eq!(unwrap_turns(&time, &swing()), None);
        let wrapped: Vec<f64> = swing().iter().map(|q| q.rem_euclid(TAU)).collect();
        let found = unwrap_turns(&time, &wrapped).unwrap();
        assert!(found.position.iter().zip(swing()).all(|(a, b)| (a - b).abs() < 1e-9));
        assert_eq!(found.jumps.len(), 3);
    }

    #[test]
    fn a_jump_that_is_no_full_turn_stays() {
        let time: Vec<f64> = (0..1000).map(|k| 0.002 * f64::from(k)).collect();
        let mut q = swing();
        q[400..].iter_mut().for_each(|q| *q += 5.0);
        assert_eq!(unwrap_turns(&time, &q), None);
    }
}
