use logs::{LogError, PreparedRun};

use crate::torque::band::Band;

/// Speed below which dry friction may hold a joint with any part of its level (rad/s or m/s).
const HELD_SPEED: f64 = 5e-3;

/// Time that a joint must stay slower to count as held rather than turning (s).
const HELD_S: f64 = 0.2;

/// Number of samples beside a held stretch that the low-pass mixes with it: 0.35 periods of the cut-off, at 2.5
/// samples a period.
const MIXED: usize = 1;

/// Fewest samples of a moving joint for which an error is stated.
const FEWEST: usize = 10;

/// RMS torque errors, by joint, while the joints move.
///
/// A joint that stands is held by dry friction of any size up to its level. No model predicts that torque, and a
/// model without friction may by chance have the smallest error.
#[derive(Debug, Clone, PartialEq)]
pub struct TurningError {
    squares: Vec<f64>,
    samples: Vec<usize>,
}

impl TurningError {
    /// No errors yet, for this number of joints.
    pub fn new(joints: usize) -> Self {
        Self { squares: vec![0.0; joints], samples: vec![0; joints] }
    }

    /// Adds the errors of a run, `[joint][sample]`, in the band below the cut-off and at its rate.
    ///
    /// # Errors
    ///
    /// [`LogError`] for a cut-off that the rate of the run does not allow.
    pub fn add(
        &mut self,
        run: &PreparedRun,
        cutoff_hz: f64,
        errors: &[Vec<f64>],
    ) -> Result<(), LogError> {
        let band = Band::new(cutoff_hz, run.rate_hz)?;
        let rate_hz = run.rate_hz / band.whole_stride() as f64;
        for (j, (joint, errors)) in run.joints.iter().zip(errors).enumerate() {
            let moves = moves(&band.of_log(joint.qd.clone()), rate_hz);
            let told = errors.iter().zip(moves).filter(|(_, moves)| *moves);
            for (error, _) in told {
                self.squares[j] += error * error;
                self.samples[j] += 1;
            }
        }
        Ok(())
    }

    /// RMS by joint (N m or N); `None` for a joint that moves in fewer than ten samples.
    pub fn rms(&self) -> Vec<Option<f64>> {
        let of = |(square, samples): (&f64, &usize)| {
            (*samples >= FEWEST).then(|| (square / *samples as f64).sqrt())
        };
        self.squares.iter().zip(&self.samples).map(of).collect()
    }
}

/// The samples in which a joint with these velocities moves or turns.
fn moves(qd: &[f64], rate_hz: f64) -> Vec<bool> {
    let shortest = (HELD_S * rate_hz).ceil() as usize;
    let mut moves = vec![true; qd.len()];
    let mut start = 0;
    for stretch in qd.chunk_by(|a, b| (a.abs() < HELD_SPEED) == (b.abs() < HELD_SPEED)) {
        let end = start + stretch.len();
        if stretch[0].abs() < HELD_SPEED && stretch.len() >= shortest {
            moves[start.saturating_sub(MIXED)..(end + MIXED).min(qd.len())].fill(false);
        }
        start = end;
    }
    moves
}

#[cfg(test)]
mod tests {
    use logs::PreparedJoint;

    use super::*;

    /// 10 s at 100 Hz of a joint that moves for the first five, and of one that does not.
    fn run() -> PreparedRun {
        let joint = |speed: f64| {
            let qd: Vec<f64> = (0..1000).map(|k| if k < 500 { speed } else { 0.0 }).collect();
            PreparedJoint::exact([vec![0.0; 1000], qd, vec![0.0; 1000]], vec![0.0; 1000])
        };
        let time = (0..1000).map(|k| 0.01 * f64::from(k)).collect();
        PreparedRun {
            name: "run".into(),
            rate_hz: 100.0,
            time,
            session_start_s: 0.0,
            joints: vec![joint(1.0), joint(0.0)],
        }
    }

    #[test]
    fn what_a_standing_joint_is_held_by_is_no_error() {
        // 25 Hz, of a cut-off of 10 Hz: an error of .3 while the joint moves and the low-pass rings, and
        // of 5 while it stands.
        let error: Vec<f64> = (0..250).map(|k| if k < 135 { 0.3 } else { 5.0 }).collect();
        let mut errors = TurningError::new(2);
        errors.add(&run(), 10.0, &[error.clone(), error]).unwrap();
        let [moving, standing] = errors.rms()[..] else { panic!("two joints") };
        assert!((moving.unwrap() - 0.3).abs() < 1e-12, "{moving:?}");
        assert_eq!(standing, None);
    }

    #[test]
    fn a_turn_is_no_rest() {
        let qd: Vec<f64> = (0..100).map(|k| (0.1 * f64::from(k)).sin()).collect();
        assert!(moves(&qd, 100.0).iter().all(|moves| *moves));
        assert!(moves(&[0.0; 100], 100.0).iter().all(|moves| !moves));
    }
}
