use log_formats::quote;

use crate::runs::{repair::Repair, run::of_run};

/// A problem of a log that is still usable.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LogWarning {
    /// The log has a joint that is not in the robot.
    #[error("{of_run}: joint {joint} of the log is not in the robot, it is left out", of_run = of_run(run), joint = quote(joint))]
    UnknownJoint {
        /// The run.
        run: String,
        /// The joint of the log.
        joint: String,
    },
    /// The file ended in the middle of a row.
    #[error("{of_run}: its last row was cut off while it was written, it is left out", of_run = of_run(run))]
    TornLastRow {
        /// The run.
        run: String,
    },
    /// The run was changed while it was read.
    #[error("{of_run}: {mend}", of_run = of_run(run))]
    Mended {
        /// The run.
        run: String,
        /// The change.
        mend: Repair,
    },
    /// The values of runs come at a lower rate than their rows.
    #[error("{}: {mend}", of_runs(runs))]
    OtherRate {
        /// The runs.
        runs: Vec<String>,
        /// The change.
        mend: Repair,
    },
    /// Only part of the logs is used.
    #[error("{mend}")]
    Thinned {
        /// The change, with the share that is used.
        mend: Repair,
    },
    /// Two runs have the same samples.
    #[error(
        "{of_run} has the same positions and efforts as {of_it}: held-out results would be too good", of_run = of_run(run), of_it = of_run(of))]
    Duplicate {
        /// The run.
        run: String,
        /// The earlier run with the same samples.
        of: String,
    },
    /// The measured velocity is not the derivative of the position.
    #[error("{of_run}: the velocity of {} is {scale:.3} times the derivative of the position and {}; \
        the derivative of the position is used in all runs", joint_words(joints), lag_words(*lag_s), of_run = of_run(run))]
    VelocityDisagrees {
        /// The run in which the first joint differs most.
        run: String,
        /// The joints with the same lag and scale.
        joints: Vec<String>,
        /// Lag of the velocity column relative to the derivative (s).
        lag_s: f64,
        /// Factor from the derivative to the velocity column.
        scale: f64,
    },
    /// The measured acceleration is not the derivative of the velocity.
    #[error("{of_run}: the acceleration of {} is {scale:.3} times the derivative of the velocity and {}; \
        the derivative of the velocity is used in all runs", joint_words(joints), lag_words(*lag_s), of_run = of_run(run))]
    AccelerationDisagrees {
        /// The run in which the first joint differs most.
        run: String,
        /// The joints with the same lag and scale.
        joints: Vec<String>,
        /// Lag of the acceleration column relative to the derivative (s).
        lag_s: f64,
        /// Factor from the derivative to the acceleration column.
        scale: f64,
    },
    /// Only some of the runs have a second encoder of a joint.
    #[error(
        "{of_run}: joint {joint} has no link_position here, as it has in other runs; it is left out of all", of_run = of_run(run))]
    LinkPositionMissing {
        /// The first run without the encoder.
        run: String,
        /// The joint.
        joint: String,
    },
    /// The clock of a joint's second encoder differs from that of the first.
    #[error("joint {joint}: its link_position is {} (standard error {:.2} ms) against its position; it was moved by that", lag_words(*lag_s), 1e3 * lag_std_s)]
    LinkLag {
        /// The joint.
        joint: String,
        /// Lag of the second encoder (s).
        lag_s: f64,
        /// Standard error of the lag (s).
        lag_std_s: f64,
    },
    /// The clock was not uniform.
    #[error("{of_run}: its clock is not uniform (steps differ by up to {:.3} ms from the usual one); it was resampled at {rate_hz} Hz", 1e3 * deviation_s, of_run = of_run(run))]
    Resampled {
        /// The run.
        run: String,
        /// Largest difference between a step and the usual step (s).
        deviation_s: f64,
        /// Rate of the uniform clock (Hz).
        rate_hz: f64,
    },
    /// A run has gaps that are too long for interpolation.
    #[error(
        "{of_run}: {gaps} gaps of more than {:.0} ms; it was split there, pieces under {shortest_s:.3} s left out",
        1e3 * longest_s, of_run = of_run(run))]
    Split {
        /// The run.
        run: String,
        /// Number of gaps.
        gaps: usize,
        /// The longest gap that is filled (s).
        longest_s: f64,
        /// The shortest piece kept (s).
        shortest_s: f64,
    },
    /// Much of the acceleration of a joint is noise.
    #[error("joint {joint}: noise is {:.0} % of its acceleration below {cutoff_hz:.1} Hz; what its inertia does cannot be told from it", 100.0 * share)]
    NoisyAcceleration {
        /// The joint.
        joint: String,
        /// Ratio of noise to acceleration, both RMS.
        share: f64,
        /// Cut-off of the low-pass (Hz).
        cutoff_hz: f64,
    },
    /// Many samples of the effort are at its extreme values.
    #[error("{of_run}: {:.1} % of the effort of joint {joint} sits at its extreme values: the drive or its sensor may saturate", 100.0 * share, of_run = of_run(run))]
    Saturated {
        /// The run.
        run: String,
        /// The joint.
        joint: String,
        /// Share of the samples, 0 to 1.
        share: f64,
    },
}

impl LogWarning {
    /// Adds the joints of `other` where both have the same lag and scale in print; otherwise returns `other`.
    pub(crate) fn join(&mut self, other: Self) -> Option<Self> {
        use LogWarning::{AccelerationDisagrees, VelocityDisagrees};
        let alike = |a: (f64, f64), b: (f64, f64)| {
            (a.0 - b.0).abs() < SAME_LAG_S && (a.1 - b.1).abs() < SAME_SCALE
        };
        match (self, &other) {
            (
                VelocityDisagrees { joints, lag_s, scale, .. },
                VelocityDisagrees { joints: more, lag_s: lag, scale: by, .. },
            )
            | (
                AccelerationDisagrees { joints, lag_s, scale, .. },
                AccelerationDisagrees { joints: more, lag_s: lag, scale: by, .. },
            ) if alike((*lag_s, *scale), (*lag, *by)) => {
                joints.extend_from_slice(more);
                None
            }
            _ => Some(other),
        }
    }
}

/// Differences of lags (s) and scales below which they count as the same in a warning.
const SAME_LAG_S: f64 = 5e-5;
const SAME_SCALE: f64 = 5e-3;

/// Joints in words: `joint a`, `joints a, b and c`.
fn joint_words(joints: &[String]) -> String {
    match joints {
        [] => "no joint".to_owned(),
        [one] => format!("joint {one}"),
        [first @ .., last] => format!("joints {} and {last}", first.join(", ")),
    }
}

/// Runs in words: `run wipe`, `runs log_1, log_2 and log_3`.
fn of_runs(runs: &[String]) -> String {
    match runs {
        [first @ .., last] if !first.is_empty() => {
            format!("runs {} and {last}", first.join(", "))
        }
        _ => of_run(runs.first().map_or("", String::as_str)),
    }
}

/// A lag in words, such as `6.50 ms late`.
fn lag_words(lag_s: f64) -> String {
    format!("{:.2} ms {}", 1e3 * lag_s.abs(), if lag_s < 0.0 { "early" } else { "late" })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn late_by(joint: &str, lag_s: f64) -> LogWarning {
        let (run, joints) = ("a".to_owned(), vec![joint.to_owned()]);
        LogWarning::VelocityDisagrees { run, joints, lag_s, scale: 1.0 }
    }

    #[test]
    fn what_is_true_of_several_joints_is_said_once() {
        let mut first = late_by("j1", 5.62e-3);
        assert_eq!(first.join(late_by("j2", 5.63e-3)), None);
        assert_eq!(first.join(late_by("j3", 5.60e-3)), None);
        assert_eq!(first.join(late_by("j4", 7.0e-3)), Some(late_by("j4", 7.0e-3)));
        let said = first.to_string();
        assert!(said.starts_with("run a: the velocity of joints j1, j2 and j3 is 1.000"), "{said}");
    }
}
