use diagnosis::DiagnosisProgress;
use logs::{LogError, PrepareSettings, PreparedRun, Run, prepare, without_repeats};
use nalgebra::Point3;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simulator::{ForwardReplay, SimulatorError, Windows, replay_torque};

use crate::replay::replayed::first;

/// Drift of two simulations from the measurement, after several lengths of time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ForwardGap {
    /// One entry a length of time, the shortest first.
    pub windows: Vec<ForwardWindow>,
}

/// Drift of two simulations after one length of time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ForwardWindow {
    /// Length of a window (s): the simulation starts from a measured state and is driven by the measured torque.
    pub window_s: f64,
    /// Number of such windows that were simulated, without overlap.
    pub windows: usize,
    /// Drift of the robot as described.
    pub nominal: Drift,
    /// Drift of the extended robot.
    pub extended: Drift,
}

/// Drift of a simulation over windows, at their ends and on the way.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct Drift {
    /// RMS of simulated minus measured position, by joint (rad or m); `None` where a joint ran away in every window.
    pub rms: Option<Vec<f64>>,
    /// RMS of the distance between the simulated and the measured origin of the last link (m).
    pub tip_rms_m: Option<f64>,
    /// The same at twenty equal steps through the windows, the last step at their ends (m).
    #[serde(default)]
    pub tip_course_m: Vec<f64>,
    /// Number of windows in which a joint ran away. The values above leave these out.
    pub runaways: usize,
    /// Why the robot could not be simulated, if it could not.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub trouble: Option<String>,
}

/// Simulates the robot as described and the extended one under the measured torques, from measured states on, for 50,
/// 200 and 1000 ms.
///
/// ```text
/// (q, qd)(t_start) = measured,   tau(t) = measured,   drift = q_simulated - q_measured
/// ```
///
/// Of the windows of 50 ms one in six is simulated, of those of 200 ms one in three, of those of 1 s each. A record
/// shorter than a length of time has no windows of it.
pub fn forward_gap(
    robots: [&Robot; 2],
    records: &[PreparedRun],
    progress: &dyn DiagnosisProgress,
) -> ForwardGap {
    progress.stage("simulating the measured torque", 2 * WINDOWS.len() * records.len());
    let windows = WINDOWS.map(|windows| {
        let window_s = windows.window_s;
        let [nominal, extended] = robots.map(|robot| Sum::of(robot, records, windows, progress));
        let windows = nominal.windows.max(extended.windows);
        let [nominal, extended] = [nominal, extended].map(Sum::drift);
        ForwardWindow { window_s, windows, nominal, extended }
    });
    ForwardGap { windows: windows.into() }
}

/// [`forward_gap`] on the logs of a diagnosis, in which the extended robot was found. Half a minute of all logs
/// together is simulated, the same time from the beginning of each.
///
/// # Errors
///
/// [`LogError`] when the runs were diagnosed with another cut-off (Hz).
pub fn forward_gap_of_logs(
    robots: [&Robot; 2],
    runs: &[Run],
    cutoff_hz: f64,
    progress: &dyn DiagnosisProgress,
) -> Result<ForwardGap, LogError> {
    let records =
        prepare(&without_repeats(runs), &PrepareSettings { cutoff_hz: Some(cutoff_hz) })?.runs;
    let each_s = TOTAL_S / records.len().max(1) as f64;
    let records: Vec<PreparedRun> = records.iter().map(|record| first(record, each_s)).collect();
    Ok(forward_gap(robots, &records, progress))
}

/// Total time of all logs of a diagnosis that is simulated for each length of time (s).
const TOTAL_S: f64 = 30.0;

/// Lengths of time that are simulated from a measured state. Of the shorter ones a part is enough: of half a minute
/// 100, 50 and 30 windows, whose RMS has an error of 7, 10 and 13 %.
const WINDOWS: [Windows; 3] = [
    Windows { window_s: 0.05, one_in: 6 },
    Windows { window_s: 0.2, one_in: 3 },
    Windows { window_s: 1.0, one_in: 1 },
];

/// Number of steps at which the drift within a window is taken.
const STEPS: usize = 20;

/// Sums of squares over the windows of several records.
#[derive(Default)]
struct Sum {
    windows: usize,
    runaways: usize,
    joints: Vec<f64>,
    /// Sum for the tip, at every step through the windows.
    tip: [f64; STEPS],
    trouble: Option<String>,
}

impl Sum {
    /// The sums over all windows of all records that can be simulated.
    fn of(
        robot: &Robot,
        records: &[PreparedRun],
        windows: Windows,
        progress: &dyn DiagnosisProgress,
    ) -> Self {
        let mut sum = Self { joints: vec![0.0; robot.joint_count()], ..Self::default() };
        for record in records {
            match replay_torque(robot, record, windows) {
                Ok(replay) => sum.add(robot, record, &replay),
                Err(SimulatorError::TooShort { .. }) => {}
                Err(error) => sum.trouble = Some(error.to_string()),
            }
            progress.step();
        }
        sum
    }

    fn add(&mut self, robot: &Robot, record: &PreparedRun, replay: &ForwardReplay) {
        self.windows += replay.starts.len();
        self.runaways += replay.runaways.len();
        let kept = (replay.starts.len() - replay.runaways.len()) as f64;
        for (sum, rms) in self.joints.iter_mut().zip(replay.drift_rms.iter().flatten()) {
            *sum += kept * rms * rms;
        }
        for courses in courses(replay, record) {
            for (sum, [a, b]) in self.tip.iter_mut().zip(courses) {
                *sum += distance(robot, &a, &b).powi(2);
            }
        }
    }

    fn drift(self) -> Drift {
        let kept = self.windows - self.runaways;
        let rms = |sum: &f64| (sum / kept as f64).sqrt();
        Drift {
            rms: (kept > 0).then(|| self.joints.iter().map(rms).collect()),
            tip_rms_m: self.tip.last().filter(|_| kept > 0).map(rms),
            tip_course_m: self.tip.iter().filter(|_| kept > 0).map(rms).collect(),
            runaways: self.runaways,
            trouble: self.trouble,
        }
    }
}

/// Simulated and measured positions at every step through every window in which no joint ran away.
fn courses<'a>(
    replay: &'a ForwardReplay,
    record: &'a PreparedRun,
) -> impl Iterator<Item = Vec<[Vec<f64>; 2]>> + 'a {
    let samples = (replay.window_s * record.rate_hz).round() as usize;
    let step = move |start: usize, k: usize| {
        let sample = start + (k * samples).div_ceil(STEPS);
        let time_s = record.time[sample];
        // A window that was cut short has no row at its end.
        let row = replay.motion.time.partition_point(|t| *t < time_s);
        if replay.motion.time.get(row).is_none_or(|t| *t > time_s) {
            return None;
        }
        let simulated = replay.motion.joints.iter().map(|joint| joint.position[row]).collect();
        let measured = record.joints.iter().map(|joint| joint.q[sample]).collect();
        Some([simulated, measured])
    };
    replay.starts.iter().filter_map(move |&start| (1..=STEPS).map(|k| step(start, k)).collect())
}

/// How far the tip of a simulation is from the measured one at the ends of the windows in which no joint ran away: RMS
/// of the distance between the origins of the last link (m); none where every window ran away.
pub fn tip_drift_rms_m(robot: &Robot, record: &PreparedRun, replay: &ForwardReplay) -> Option<f64> {
    let square = |course: Vec<[Vec<f64>; 2]>| {
        let [simulated, measured] = course.last()?;
        Some(distance(robot, simulated, measured).powi(2))
    };
    let squares: Vec<f64> = courses(replay, record).filter_map(square).collect();
    (!squares.is_empty()).then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
}

/// Distance of the origin of the last link between two positions of the joints (m).
fn distance(robot: &Robot, a: &[f64], b: &[f64]) -> f64 {
    let [a, b] = [a, b].map(|q| tracking::tip_in_base(robot, &Point3::origin(), q));
    (a - b).norm()
}

#[cfg(test)]
mod tests {
    use super::*;
    use diagnosis::Silent;
    use logs::PreparedJoint;

    const FORCE: f64 = 4.0;
    const MASS: f64 = 2.0;

    /// A slide of this mass, along the ground.
    fn slide(mass: f64) -> Robot {
        let text = format!(
            r#"<robot name="slide"><link name="base"/><joint name="x" type="prismatic">
            <parent link="base"/><child link="cart"/><axis xyz="1 0 0"/>
            <limit lower="-9" upper="9" velocity="90" effort="90"/></joint>
            <link name="cart"><inertial><mass value="{mass}"/><inertia ixx="1" ixy="0" ixz="0"
            iyy="1" iyz="0" izz="1"/></inertial></link></robot>"#
        );
        Robot::from_urdf(&text).unwrap()
    }

    /// A second and a little more of the slide of [`MASS`] under a constant force, from rest.
    fn record() -> PreparedRun {
        let acceleration = FORCE / MASS;
        let time: Vec<f64> = (0..520).map(|k| 0.002 * f64::from(k)).collect();
        let of = |f: &dyn Fn(f64) -> f64| -> Vec<f64> { time.iter().map(|t| f(*t)).collect() };
        let q = of(&|t| 0.5 * acceleration * t * t);
        let state = [q, of(&|t| acceleration * t), of(&|_| acceleration)];
        let joint = PreparedJoint::exact(state, of(&|_| FORCE));
        PreparedRun {
            name: "run".into(),
            rate_hz: 500.0,
            time,
            session_start_s: 0.0,
            joints: vec![joint],
        }
    }

    #[test]
    fn a_wrong_mass_drifts_by_half_the_error_of_the_acceleration_times_time_squared() {
        let gap = forward_gap([&slide(MASS / 2.0), &slide(MASS)], &[record()], &Silent);
        for (window, count) in gap.windows.iter().zip([4, 2, 1]) {
            let expected = 0.5 * (FORCE / MASS) * window.window_s.powi(2);
            assert_eq!(window.windows, count);
            // The engine's steps are of first order.
            let close = |drift: f64, at: f64| (drift - at).abs() < 0.05 * expected;
            let [nominal, extended] = [&window.nominal, &window.extended];
            assert!(close(nominal.rms.as_ref().unwrap()[0], expected), "{window:?}");
            assert!(close(nominal.tip_rms_m.unwrap(), expected), "{window:?}");
            assert!(close(extended.rms.as_ref().unwrap()[0], 0.0), "{window:?}");
            // Half the window is a quarter of the way, to the next sample.
            let half = nominal.tip_course_m[STEPS / 2 - 1] / expected;
            assert!((0.24..0.3).contains(&half), "{half}");
            assert!(close(nominal.tip_course_m[STEPS - 1], expected), "{window:?}");
        }
    }

    #[test]
    fn what_is_too_short_or_cannot_be_simulated_is_said_and_no_number() {
        let short = record().part(0..200);
        // A drive of 1 kg on a spring: it rings too fast for 1 ms, and too fast for all.
        let on_spring = |stiffness: f64| {
            let mut robot = slide(MASS);
            let drive = &mut robot.link_mut(0).unwrap().actuator;
            (drive.elasticity, drive.rotor_inertia) = (Some(stiffness), 1.0);
            robot
        };
        let robots = [&on_spring(5e5), &on_spring(5e9)];
        let gap = forward_gap(robots, &[short], &Silent);
        assert_eq!(gap.windows[2].nominal, Drift::default(), "0.4 s hold no second");
        let [soft, stiff] = [&gap.windows[0].nominal, &gap.windows[0].extended];
        assert!(soft.rms.is_some() && soft.trouble.is_none(), "{soft:?}");
        assert!(stiff.rms.is_none() && stiff.trouble.is_some(), "{stiff:?}");
    }
}
