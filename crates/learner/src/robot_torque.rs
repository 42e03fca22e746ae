use dynamics::{Dynamics, Workspace};
use effects::drive_torque;
use robot::Robot;

use crate::samples::SampleState;

/// The effort that a description of the robot predicts, from rigid bodies and drives. The robot is
/// the nominal one or one that a diagnosis has extended.
///
/// ```text
/// effort = torque_gain (M qdd + C qd + g + drive(q, qd, qdd, direction)) + torque_offset
/// direction_j = clamp(qd_j / rest_speed_j, -1, 1)
/// ```
///
/// with the drive's law of [`effects::drive_torque`].
#[derive(Debug, Clone)]
pub struct RobotTorque {
    robot: Robot,
    dynamics: Dynamics,
    rest_speed: Vec<f64>,
}

impl RobotTorque {
    /// The torque of `robot`, whose joints count as at rest below `rest_speed` (rad/s or
    /// m/s, one entry a joint).
    pub fn new(robot: Robot, rest_speed: Vec<f64>) -> Self {
        Self { dynamics: Dynamics::new(&robot), robot, rest_speed }
    }

    /// The robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Speed below which each joint counts as at rest (rad/s or m/s).
    pub fn rest_speed(&self) -> &[f64] {
        &self.rest_speed
    }

    /// Fills `tau` with the effort of every joint (N m or N); allocates nothing.
    ///
    /// # Panics
    ///
    /// When the state or `tau` is of another number of joints.
    pub fn fill(&self, ws: &mut Workspace, state: SampleState, tau: &mut [f64]) {
        let SampleState { q, qd, qdd } = state;
        self.dynamics.inverse_dynamics_into(ws, q, qd, qdd, tau);
        for (j, (tau, link)) in tau.iter_mut().zip(self.robot.links()).enumerate() {
            let drive = &link.actuator;
            let direction = (qd[j] / self.rest_speed[j]).clamp(-1.0, 1.0);
            let torque = *tau + drive_torque(drive, [q[j], qd[j], qdd[j]], direction, *tau);
            *tau = drive.torque_gain * torque + drive.torque_offset;
        }
    }
}
