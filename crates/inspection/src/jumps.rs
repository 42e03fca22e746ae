use std::f64::consts::TAU;

use logs::Run;

use crate::observation::{Observation, ObservationKind, RunStretch};
use crate::pieces::usual_step;
use crate::thresholds::InspectionThresholds;

/// Jumps by full turns between two rows of a position, which are taken back.
///
/// A jump is a step within half a radian of full turns while no other step of the log is a quarter turn.
pub(crate) fn jumps(
    run: &Run,
    index: usize,
    joint: usize,
    position: &mut [f64],
    t: &InspectionThresholds,
) -> Option<Observation> {
    let usual = usual_step(&run.time);
    let mut turns = 0.0;
    let (mut rows, mut largest, mut fast) = (Vec::new(), 0.0_f64, 0.0_f64);
    let mut before = *position.first()?;
    for (k, q) in position.iter_mut().enumerate().skip(1) {
        let step = *q - before;
        before = *q;
        let full = (step / TAU).round();
        let even = run.time[k] - run.time[k - 1] < t.moments.next_row * usual;
        if full.abs() > 0.0 && (step - full * TAU).abs() < t.moments.full_turn && even {
            turns += full;
            largest = if full.abs() > largest.abs() { full } else { largest };
            rows.push(RunStretch::of_rows(run, index, &(k - 1..k + 1)));
        } else {
            fast = fast.max(step.abs());
        }
        *q -= turns * TAU;
    }
    let is_jump = !rows.is_empty() && fast < t.moments.fastest_turn * TAU;
    is_jump.then(|| {
        Observation::of_seconds(ObservationKind::TurnJump { turns: largest as i32 }, joint, rows)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::swing;

    #[test]
    fn a_jump_by_a_turn_is_told_and_taken_back() {
        let run = swing(0.3);
        let mut q = run.joints[0].position.clone();
        assert_eq!(jumps(&run, 0, 0, &mut q, &InspectionThresholds::default()), None);
        q[2000..].iter_mut().for_each(|q| *q -= TAU);
        let jump = jumps(&run, 0, 0, &mut q, &InspectionThresholds::default()).unwrap();
        assert_eq!(jump.kind, ObservationKind::TurnJump { turns: -1 });
        assert!(q.iter().zip(&run.joints[0].position).all(|(a, b)| (a - b).abs() < 1e-9));
    }
}
