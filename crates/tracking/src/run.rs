use std::{collections::BTreeMap, path::PathBuf};

use logs::{Channels, Run};
use robot::Robot;

use crate::error::{TrackingError, same_joints};
use crate::rows::{Signal, TrackingRows};
use crate::tracking::Tracking;

impl Tracking {
    /// The run as a motion log with the name `name`, on the clock of the machine.
    ///
    /// `effort` and `commanded_effort` are what the machine was told from that row on. Further
    /// columns are `<joint>.feedforward`, `<joint>.feedback` and `prediction_age` (s);
    /// `<joint>.link_position` is there where the machine knows it.
    ///
    /// # Errors
    ///
    /// [`TrackingError::JointCount`] when the run is of another number of joints than `robot`.
    pub fn to_run(&self, name: &str, robot: &Robot) -> Result<Run, TrackingError> {
        let rows = &self.rows;
        same_joints("the run", rows.joints(), robot.joint_count())?;
        let mut extra = BTreeMap::from([("prediction_age".to_owned(), rows.age_s().collect())]);
        let mut joints = Vec::new();
        for (joint, name) in robot.joint_names().enumerate() {
            joints.push(channels(rows, joint, name));
            let mut add = |suffix: &str, signal: Signal| {
                extra.insert(format!("{name}.{suffix}"), rows.column(signal, joint).collect());
            };
            add("feedforward", Signal::Feedforward);
            add("feedback", Signal::Feedback);
        }
        Ok(Run {
            name: name.to_owned(),
            source: PathBuf::new(),
            sha256: String::new(),
            is_torn: false,
            mended: Vec::new(),
            time: rows.reading_time_s().collect(),
            joints,
            extra,
        })
    }
}

fn channels(rows: &TrackingRows, joint: usize, name: &str) -> Channels {
    let signal = |signal| rows.column(signal, joint).collect::<Vec<f64>>();
    Channels {
        name: name.to_owned(),
        position: signal(Signal::Q),
        effort: signal(Signal::Command),
        velocity: Some(signal(Signal::Qd)),
        acceleration: None,
        desired_position: Some(signal(Signal::QRef)),
        desired_velocity: Some(signal(Signal::QdRef)),
        desired_acceleration: Some(signal(Signal::QddRef)),
        commanded_effort: Some(signal(Signal::Command)),
        link_position: rows.knows_links().then(|| signal(Signal::Link)),
        goal_effort: None,
    }
}

#[cfg(test)]
mod tests {
    use logs::{ReadOptions, read_run, write_parquet};

    use super::*;
    use crate::error::TrackingError;
    use crate::rows::Signal;
    use crate::settings::TrackingSettings;
    use crate::testing::{Of, TestPlant, controller, pendulum, slider, swing};
    use crate::track;

    fn tracking() -> Tracking {
        let motion = swing(&slider(), 3.0);
        let mut machine = TestPlant::slider(&motion);
        machine.link = Some([0.0]);
        let (pd, usual) = (controller(90.0, 9.0), TrackingSettings::default());
        track(&mut machine, &motion, &pd, &mut Of(f64::cos), &usual, &mut ()).unwrap()
    }

    #[test]
    fn a_run_is_a_log_that_reads_back_as_it_was() {
        let tracking = tracking();
        let run = tracking.to_run("swing", &slider()).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("swing.parquet");
        write_parquet(&path, &run).unwrap();
        let back = read_run(&path, &slider(), &ReadOptions::default()).unwrap();
        let none = (PathBuf::new(), String::new());
        let back = Run { source: none.0, sha256: none.1, ..back };
        assert_eq!(back, run);
        assert_eq!((run.time.len(), run.joints[0].name.as_str()), (1500, "x"));
        let column = |signal| tracking.rows.column(signal, 0).collect::<Vec<_>>();
        assert_eq!(run.joints[0].effort, column(Signal::Command));
        assert_eq!(run.joints[0].position, column(Signal::Q));
        assert_eq!(run.extra["x.feedforward"], column(Signal::Feedforward));
        let links = run.joints[0].link_position.iter().flatten();
        let behind = links.zip(&run.joints[0].position);
        assert!(behind.into_iter().all(|(link, q)| (link - q - 0.01).abs() < 1e-12));
    }

    #[test]
    fn a_robot_of_other_joints_is_refused() {
        let two = Tracking { rows: TrackingRows::new(2, 0), ..tracking() };
        let error = two.to_run("swing", &pendulum()).unwrap_err();
        let expected = TrackingError::JointCount { what: "the run", got: 2, expected: 1 };
        assert_eq!(error, expected);
    }
}
