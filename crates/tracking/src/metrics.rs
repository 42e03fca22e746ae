use nalgebra::{Point3, distance};
use robot::Robot;

use crate::error::{TrackingError, same_joints};
use crate::rows::{Signal, TrackingRows};
use crate::tip::tip_in_base;

/// Tracking errors of a run, and the torque that they took. A run without ticks has zeros.
#[derive(Debug, Clone, PartialEq)]
pub struct TrackingMetrics {
    /// Joint by joint, in the order of the robot.
    pub joints: Vec<JointMetrics>,
    /// How far a point of the last link was from where it should be, by the joints' readings.
    pub end_effector: Distance,
    /// The same by the positions of the links, where the machine knows them.
    pub end_effector_of_links: Option<Distance>,
}

/// Tracking errors of one joint, and its torque.
///
/// ```text
/// error = q_ref - q,   RMS(x) = sqrt(mean over the ticks of x²)
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct JointMetrics {
    /// RMS of the error (rad or m).
    pub rmse: f64,
    /// RMS of the error in the first ten seconds (rad or m).
    pub rmse_first_10_s: f64,
    /// Largest error (rad or m).
    pub max_error: f64,
    /// The errors of the link, where the machine knows its position.
    pub link: Option<LinkMetrics>,
    /// RMS of the command (N m or N).
    pub command_rms: f64,
    /// RMS of the feedback (N m or N).
    pub feedback_rms: f64,
    /// That over the RMS of the command; 0 without a command.
    pub feedback_share: f64,
    /// Largest change of the feedforward from one tick to the next (N m or N), what the motion
    /// itself asks for included.
    pub jump_max: f64,
    /// RMS of those changes (N m or N).
    pub jump_rms: f64,
    /// The largest over the RMS of the command; 0 without a command.
    pub jump_share: f64,
    /// Ticks in which the command was brought within the limits.
    pub ticks_limited: usize,
}

/// Errors of a link: `q_ref` minus the position of the link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkMetrics {
    /// RMS (rad or m).
    pub rmse: f64,
    /// RMS in the first ten seconds (rad or m).
    pub rmse_first_10_s: f64,
    /// Largest (rad or m).
    pub max_error: f64,
}

/// Distance between two points.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Distance {
    /// RMS over the ticks (m).
    pub rms_m: f64,
    /// Largest (m).
    pub max_m: f64,
}

/// The first stretch of a run that is looked at alone (s).
const FIRST_S: f64 = 10.0;

impl TrackingMetrics {
    /// The metrics of a run of `robot`, and of a point of its last link (m).
    ///
    /// # Errors
    ///
    /// [`TrackingError::JointCount`] when the run is of another number of joints.
    pub fn of(
        rows: &TrackingRows,
        robot: &Robot,
        point_in_link: &Point3<f64>,
    ) -> Result<Self, TrackingError> {
        same_joints("the run", rows.joints(), robot.joint_count())?;
        let off = |actual: Signal| {
            let tip = |signal, tick| tip_in_base(robot, point_in_link, rows.row(tick, signal));
            let far = |tick| distance(&tip(Signal::QRef, tick), &tip(actual, tick));
            let far = (0..rows.len()).map(far);
            Distance { rms_m: rms(far.clone()), max_m: largest(far) }
        };
        Ok(Self {
            joints: (0..rows.joints()).map(|joint| JointMetrics::of(rows, joint)).collect(),
            end_effector: off(Signal::Q),
            end_effector_of_links: rows.knows_links().then(|| off(Signal::Link)),
        })
    }
}

impl JointMetrics {
    fn of(rows: &TrackingRows, joint: usize) -> Self {
        let signal = |signal| rows.column(signal, joint);
        let errors = LinkMetrics::of(rows, joint, Signal::Q);
        let feedforward = signal(Signal::Feedforward);
        let jumps =
            feedforward.clone().zip(feedforward.skip(1)).map(|(before, after)| after - before);
        let (command_rms, feedback_rms) =
            (rms(signal(Signal::Command)), rms(signal(Signal::Feedback)));
        let share = |part: f64| if command_rms > 0.0 { part / command_rms } else { 0.0 };
        let jump_max = largest(jumps.clone());
        Self {
            rmse: errors.rmse,
            rmse_first_10_s: errors.rmse_first_10_s,
            max_error: errors.max_error,
            link: rows.knows_links().then(|| LinkMetrics::of(rows, joint, Signal::Link)),
            command_rms,
            feedback_rms,
            feedback_share: share(feedback_rms),
            jump_max,
            jump_rms: rms(jumps),
            jump_share: share(jump_max),
            ticks_limited: signal(Signal::Limited).filter(|limited| *limited > 0.0).count(),
        }
    }
}

impl LinkMetrics {
    fn of(rows: &TrackingRows, joint: usize, actual: Signal) -> Self {
        let (q_ref, q) = (rows.column(Signal::QRef, joint), rows.column(actual, joint));
        let errors = q_ref.zip(q).map(|(q_ref, q)| q_ref - q);
        let first = rows.time_s().take_while(|time_s| *time_s < FIRST_S).count();
        Self {
            rmse: rms(errors.clone()),
            rmse_first_10_s: rms(errors.clone().take(first)),
            max_error: largest(errors),
        }
    }
}

/// Root of the mean square; 0 of nothing.
fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (count, sum) = values.fold((0.0, 0.0), |(count, sum), v| (count + 1.0, sum + v * v));
    if count > 0.0 { f64::sqrt(sum / count) } else { 0.0 }
}

/// Largest absolute value; 0 of nothing.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most: f64, v| most.max(v.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        rows::tests::rows_of,
        testing::{pendulum, slider},
    };

    fn assert_near(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-14, "{found} instead of {expected}");
    }

    #[test]
    fn metrics_are_those_worked_out_by_hand() {
        // Twelve seconds: an error of 3 in the first ten, then of -4.
        let mut ticks = vec![[1.0, -2.0, 2.0, 0.0]; 10];
        ticks.extend([[1.0, 5.0, 2.0, 0.0]; 2]);
        (ticks[3], ticks[11][3]) = ([1.0, -2.0, -4.0, 1.0], 6.0);
        let metrics =
            TrackingMetrics::of(&rows_of(&ticks, Some(0.5)), &slider(), &Point3::origin());
        let metrics = metrics.unwrap();
        let joint = &metrics.joints[0];
        assert_near(joint.rmse, f64::sqrt((90.0 + 32.0) / 12.0));
        assert_near(joint.rmse_first_10_s, 3.0);
        assert_near(joint.max_error, 4.0);
        // Ten commands of 2, one of -3, one of 8; feedback of 1 and 6.
        assert_near(joint.command_rms, f64::sqrt((40.0 + 9.0 + 64.0) / 12.0));
        assert_near(joint.feedback_rms, f64::sqrt(37.0 / 12.0));
        assert_near(joint.feedback_share, f64::sqrt(37.0 / 113.0));
        // From 2 to -4 and back, among eleven changes.
        assert_near(joint.jump_max, 6.0);
        assert_near(joint.jump_rms, f64::sqrt(72.0 / 11.0));
        assert_near(joint.jump_share, 6.0 / joint.command_rms);
        assert_eq!(joint.ticks_limited, 1);
        let link = LinkMetrics { rmse: 0.5, rmse_first_10_s: 0.5, max_error: 0.5 };
        assert_eq!(joint.link, Some(link));
        // A slider's point is where its joint is.
        assert_near(metrics.end_effector.rms_m, joint.rmse);
        assert_near(metrics.end_effector.max_m, 4.0);
        assert_eq!(metrics.end_effector_of_links, Some(Distance { rms_m: 0.5, max_m: 0.5 }));
    }

    #[test]
    fn the_point_of_a_hinge_is_off_by_the_chord() {
        let rows = rows_of(&[[0.9, 0.5, 0.0, 0.0], [0.4, 0.4, 0.0, 0.0]], None);
        let point = Point3::new(0.0, 0.0, -0.5);
        let metrics = TrackingMetrics::of(&rows, &pendulum(), &point).unwrap();
        let chord = 2.0 * 0.5 * f64::sin(0.5 * 0.4);
        assert_near(metrics.end_effector.max_m, chord);
        assert_near(metrics.end_effector.rms_m, chord / f64::sqrt(2.0));
        assert_eq!((metrics.end_effector_of_links, metrics.joints[0].link), (None, None));
        // Without a command nothing is a share of it.
        assert_eq!((metrics.joints[0].feedback_share, metrics.joints[0].jump_share), (0.0, 0.0));
    }

    #[test]
    fn a_run_without_ticks_has_zeros_and_one_of_other_joints_is_refused() {
        let metrics =
            TrackingMetrics::of(&rows_of(&[], None), &slider(), &Point3::origin()).unwrap();
        assert_eq!(metrics.end_effector, Distance::default());
        assert_eq!((metrics.joints[0].rmse, metrics.joints[0].jump_max), (0.0, 0.0));
        let error = TrackingMetrics::of(&TrackingRows::new(2, 0), &slider(), &Point3::origin())
            .unwrap_err();
        assert_eq!(error.to_string(), "the run is for 2 joints, 1 were expected");
    }
}
