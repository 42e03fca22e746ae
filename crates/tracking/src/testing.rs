//! Machines, motions and models that the tests know by heart.

use learner::{Mean, Model, ModelKind, RobotTorque};
use motion::{Motion, MotionSpec};
use robot::{Machine, MachineFault, PdGain, Reading, Robot};

use crate::controller::{Controller, ErrorRate};
use crate::feedforward::{Feedforward, TorquePrediction};
use crate::torque_limits::TorqueLimits;

pub const PERIOD_S: f64 = 0.002;
/// Mass of a slider, and of a pendulum at the end of a rod of `ROD_M` (kg).
pub const MASS: f64 = 2.0;
pub const ROD_M: f64 = 0.5;
pub const INERTIA: f64 = 0.01;
pub const GRAVITY: f64 = 9.81;

fn body(at: &str) -> String {
    format!(
        r#"<inertial><origin xyz="{at}"/><mass value="{MASS}"/><inertia ixx="{INERTIA}" ixy="0"
        ixz="0" iyy="{INERTIA}" iyz="0" izz="{INERTIA}"/></inertial>"#
    )
}

/// A body that slides level: `tau = MASS qdd`.
pub fn slider() -> Robot {
    let urdf = format!(
        r#"<robot name="slider"><link name="base"/><link name="sled">{}</link>
        <joint name="x" type="prismatic"><parent link="base"/><child link="sled"/>
        <axis xyz="1 0 0"/><limit lower="-9" upper="9" velocity="9" effort="99"/></joint>
        </robot>"#,
        body("0 0 0")
    );
    Robot::from_urdf(&urdf).unwrap()
}

/// A body that hangs: `tau = (INERTIA + MASS ROD_M²) qdd + MASS GRAVITY ROD_M sin q`.
pub fn pendulum() -> Robot {
    let urdf = format!(
        r#"<robot name="pendulum"><link name="base"/><link name="rod">{}</link>
        <joint name="hinge" type="revolute"><parent link="base"/><child link="rod"/>
        <axis xyz="0 1 0"/><limit lower="-3" upper="3" velocity="9" effort="99"/></joint>
        </robot>"#,
        body(&format!("0 0 -{ROD_M}"))
    );
    Robot::from_urdf(&urdf).unwrap()
}

/// The robot as described.
pub fn model_of(robot: &Robot) -> Model {
    let torque = RobotTorque::new(robot.clone(), vec![0.01; robot.joint_count()]);
    let mean = Mean::Robot(Box::new(torque));
    Model::new(ModelKind::Cad, robot, mean, vec![1.0; robot.joint_count()])
}

/// Two sinusoids at the only joint, smoothly from rest to rest.
pub fn swing(robot: &Robot, duration_s: f64) -> Motion {
    let joint = robot.joint_names().next().unwrap();
    let spec = format!(
        "[fourier]\nduration_s = {duration_s}\nfade_s = 1.0\n[fourier.coefficients.inline]\n\
         base_hz = 0.4\njoint.{joint} = {{ offset_rad = 0.3, a_rad_per_s = [0.9, 0.0], \
         b_rad_per_s = [0.0, 0.7] }}"
    );
    let spec: MotionSpec = toml::from_str(&spec).unwrap();
    spec.build(robot, std::path::Path::new(".")).unwrap()
}

/// Rest at a position.
pub fn rest(robot: &Robot, position: f64, duration_s: f64) -> Motion {
    let joint = robot.joint_names().next().unwrap();
    let spec = format!("[hold]\nposture_rad.{joint} = {position}\nduration_s = {duration_s}");
    let spec: MotionSpec = toml::from_str(&spec).unwrap();
    spec.build(robot, std::path::Path::new(".")).unwrap()
}

/// One joint that moves by `qdd = acceleration(q, tau)`, by Runge and Kutta's rule.
pub struct TestPlant {
    acceleration: fn(f64, f64) -> f64,
    state: [f64; 2],
    ticks: usize,
    pub link: Option<[f64; 1]>,
}

impl TestPlant {
    /// At rest where the motion begins.
    pub fn new(acceleration: fn(f64, f64) -> f64, motion: &Motion) -> Self {
        Self { acceleration, state: [motion.at(0.0).q[0], 0.0], ticks: 0, link: None }
    }

    pub fn slider(motion: &Motion) -> Self {
        Self::new(|_, tau| tau / MASS, motion)
    }

    pub fn pendulum(motion: &Motion) -> Self {
        let qdd = |q: f64, tau: f64| {
            (tau - MASS * GRAVITY * ROD_M * q.sin()) / (INERTIA + MASS * ROD_M * ROD_M)
        };
        Self::new(qdd, motion)
    }

    fn step(&mut self, tau: f64, h: f64) {
        let rate = |[q, qd]: [f64; 2]| [qd, (self.acceleration)(q, tau)];
        let to = |[q, qd]: [f64; 2], [dq, dqd]: [f64; 2], h: f64| [q + h * dq, qd + h * dqd];
        let a = rate(self.state);
        let b = rate(to(self.state, a, 0.5 * h));
        let c = rate(to(self.state, b, 0.5 * h));
        let d = rate(to(self.state, c, h));
        let mean = [0, 1].map(|i| (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]) / 6.0);
        self.state = to(self.state, mean, h);
    }
}

impl Machine for TestPlant {
    fn joint_count(&self) -> usize {
        1
    }

    fn period_s(&self) -> f64 {
        PERIOD_S
    }

    fn read(&mut self, reading: &mut Reading) -> Result<(), MachineFault> {
        reading.time_s = self.ticks as f64 * PERIOD_S;
        (reading.q[0], reading.qd[0]) = (self.state[0], self.state[1]);
        if let Some(link) = &mut self.link {
            link[0] = self.state[0] + 0.01;
        }
        Ok(())
    }

    fn actuate(&mut self, effort: &[f64]) -> Result<(), MachineFault> {
        self.ticks += 1;
        for _ in 0..10 {
            self.step(effort[0], 0.1 * PERIOD_S);
        }
        Ok(())
    }

    fn link_positions(&self) -> Option<&[f64]> {
        self.link.as_ref().map(|link| link.as_slice())
    }
}

/// Gains of the only joint.
pub fn controller(kp: f64, kd: f64) -> Controller {
    let error_rate = ErrorRate::default();
    Controller { gains: vec![PdGain { kp, kd }], limits: TorqueLimits::none(1), error_rate }
}

/// A feedforward that is a function of time.
pub struct Of<F>(pub F);

impl<F: FnMut(f64) -> f64 + Send> Feedforward for Of<F> {
    fn joints(&self) -> usize {
        1
    }

    fn words(&self) -> String {
        "a function of time".to_owned()
    }

    fn predict(&mut self, _: &Motion, time_s: f64, prediction: &mut TorquePrediction) {
        prediction.tau[0] = (self.0)(time_s);
    }
}
