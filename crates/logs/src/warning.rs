/// Something about a log that its reader should know; it can be used nevertheless.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LogWarning {
    /// The log has a joint that the robot does not have.
    #[error("run {run}: joint {joint} of the log is not in the robot, it is left out")]
    UnknownJoint {
        /// The run.
        run: String,
        /// The joint of the log.
        joint: String,
    },
    /// Two runs have the same samples.
    #[error(
        "run {run} has the same positions and efforts as run {of}: held-out results would be too good"
    )]
    Duplicate {
        /// The run.
        run: String,
        /// The earlier run it equals.
        of: String,
    },
    /// The measured velocity is not the derivative of the position.
    #[error("run {run}: the velocity of joint {joint} is {scale:.3} times the derivative of its position and {}; \
        the derivative of the position is used in all runs", late(*lag_s))]
    VelocityDisagrees {
        /// The run in which it differs most.
        run: String,
        /// The joint.
        joint: String,
        /// Lag of the velocity column behind the derivative (s).
        lag_s: f64,
        /// Scale of the velocity column against the derivative.
        scale: f64,
    },
    /// The measured acceleration is not the derivative of the velocity.
    #[error("run {run}: the acceleration of joint {joint} is {scale:.3} times the derivative of its velocity and {}; \
        the derivative of the velocity is used in all runs", late(*lag_s))]
    AccelerationDisagrees {
        /// The run in which it differs most.
        run: String,
        /// The joint.
        joint: String,
        /// Lag of the acceleration column behind the derivative (s).
        lag_s: f64,
        /// Scale of the acceleration column against the derivative.
        scale: f64,
    },
    /// The clock was not uniform.
    #[error("run {run}: its clock is not uniform (steps differ by up to {:.3} ms from the usual one); it was resampled at {rate_hz} Hz", 1e3 * deviation_s)]
    Resampled {
        /// The run.
        run: String,
        /// Largest difference between a step and the usual step (s).
        deviation_s: f64,
        /// Rate of the uniform clock (Hz).
        rate_hz: f64,
    },
    /// A run has gaps that are too long to be filled.
    #[error(
        "run {run}: {gaps} gaps of more than {longest_filled} samples; it was split there, pieces under {shortest_s:.3} s left out"
    )]
    Split {
        /// The run.
        run: String,
        /// Number of gaps.
        gaps: usize,
        /// The longest gap that is filled (samples).
        longest_filled: usize,
        /// The shortest piece kept (s).
        shortest_s: f64,
    },
    /// Many samples of the effort sit at its extreme values.
    #[error("run {run}: {:.1} % of the effort of joint {joint} sits at its extreme values: the drive or its sensor may saturate", 100.0 * share)]
    Saturated {
        /// The run.
        run: String,
        /// The joint.
        joint: String,
        /// Share of the samples, 0 to 1.
        share: f64,
    },
}

/// A lag in words, such as `6.50 ms late`.
fn late(lag_s: f64) -> String {
    format!("{:.2} ms {}", 1e3 * lag_s.abs(), if lag_s < 0.0 { "early" } else { "late" })
}
