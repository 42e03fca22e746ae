use crate::simulator::Simulator;

/// What the joints of an arm do at one instant, in the order of the robot.
#[derive(Debug, Clone, PartialEq)]
pub struct ArmState {
    /// Position of the motors, referred to the joint (rad or m).
    pub motor_q: Vec<f64>,
    /// Velocity of the motors, referred to the joint (rad/s or m/s).
    pub motor_qd: Vec<f64>,
    /// Position of the links (rad or m).
    pub q: Vec<f64>,
    /// Velocity of the links (rad/s or m/s).
    pub qd: Vec<f64>,
    /// Torque that each transmission carried to its link (N m or N); zero unless an effect or the sensor needs it.
    pub load: Vec<f64>,
}

impl ArmState {
    pub(crate) fn of(simulator: &Simulator) -> Self {
        Self {
            motor_q: simulator.motor_q_true().to_vec(),
            motor_qd: simulator.motor_qd_true().to_vec(),
            q: simulator.q_true().to_vec(),
            qd: simulator.qd_true().to_vec(),
            load: simulator.load_true().to_vec(),
        }
    }

    /// The state between this one and another, linear: this one at 0, the other at 1.
    pub(crate) fn towards(&self, other: &Self, part: f64) -> Self {
        let between = |a: &[f64], b: &[f64]| -> Vec<f64> {
            a.iter().zip(b).map(|(a, b)| a + part * (b - a)).collect()
        };
        Self {
            motor_q: between(&self.motor_q, &other.motor_q),
            motor_qd: between(&self.motor_qd, &other.motor_qd),
            q: between(&self.q, &other.q),
            qd: between(&self.qd, &other.qd),
            load: between(&self.load, &other.load),
        }
    }
}
