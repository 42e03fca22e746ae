use std::{collections::BTreeMap, path::PathBuf};

use logs::{Channels, Run};
use robot::Robot;

use crate::{Rows, Signal, Tracking, TrackingError, error::same_joints};

impl Tracking {
    /// The run as a motion log with the name `name`, on the clock of the machine.
    ///
    /// `effort` and `commanded_effort` are what the machine was told from that row on. Further
    /// columns are `<joint>.feedforward`, `<joint>.feedback`, where the machine knows it
    /// `<joint>.link_position`, and `prediction_age` (s).
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
            if rows.knows_links() {
                add("link_position", Signal::Link);
            }
        }
        Ok(Run {
            name: name.to_owned(),
            source: PathBuf::new(),
            sha256: String::new(),
            time: rows.reading_time_s().collect(),
            joints,
            extra,
        })
    }
}

fn channels(rows: &Rows, joint: usize, name: &str) -> Channels {
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
    }
}
