use effects::{Compensation, CompensationWorkspace, FeedforwardEfforts};
use motion::{Motion, State};
use robot::Robot;

use crate::error::{TrackingError, same_joints};
use crate::feedforward::{Feedforward, TorquePrediction};

/// The commands with which the links of a robot follow the motion: rigid bodies, and the inverse of
/// every effect that the description of the robot names.
///
/// ```text
/// tau(t)    = compensation(t + delay_j + lead_s)
/// q_lead(t) = compensation(t)
/// ```
///
/// with [`effects::Compensation`], joint by joint with the joint's own delay. The delay holds for
/// torques, and not for the reference of a motor.
#[derive(Debug)]
pub struct NamedFeedforward {
    compensation: Compensation,
    workspace: CompensationWorkspace,
    states: Vec<State>,
    found: FeedforwardEfforts,
    /// Every delay that a joint has (s), once.
    delays_s: Vec<f64>,
    lead_s: f64,
}

impl NamedFeedforward {
    /// The feedforward for `robot`, whose joints count as at rest below `rest_speed` (rad/s or
    /// m/s), asked for `lead_s` (s) later than the tick: half a period where a command is held.
    ///
    /// # Errors
    ///
    /// [`TrackingError::JointCount`] when there is not one rest speed a joint.
    pub fn new(robot: &Robot, rest_speed: &[f64], lead_s: f64) -> Result<Self, TrackingError> {
        let joints = robot.joint_count();
        same_joints("the set of rest speeds", rest_speed.len(), joints)?;
        let compensation = Compensation::new(robot, rest_speed.to_vec());
        let mut delays_s = compensation.delay_s().to_vec();
        delays_s.sort_by(f64::total_cmp);
        delays_s.dedup_by(|a, b| a.total_cmp(b).is_eq());
        Ok(Self {
            workspace: compensation.workspace(),
            states: vec![State::default(); compensation.state_count()],
            found: FeedforwardEfforts::zero(joints),
            compensation,
            delays_s,
            lead_s,
        })
    }

    /// Works out the compensation at a time of the motion (s).
    fn find(&mut self, motion: &Motion, time_s: f64) {
        let middle = self.states.len() / 2;
        for (i, state) in self.states.iter_mut().enumerate() {
            let offset = i as f64 - middle as f64;
            motion.sample(time_s + offset * Compensation::SPACING_S, state);
        }
        let mut found = [[&[][..]; 3]; Compensation::MOST_STATES];
        found.iter_mut().zip(&self.states).for_each(|(found, state)| *found = signals(state));
        let states = &found[..self.states.len()];
        self.compensation.fill(&mut self.workspace, states, &mut self.found);
    }
}

fn signals(state: &State) -> [&[f64]; 3] {
    [&state.q, &state.qd, &state.qdd]
}

impl Feedforward for NamedFeedforward {
    fn joints(&self) -> usize {
        self.compensation.delay_s().len()
    }

    fn words(&self) -> String {
        "the robot extended by named effects".to_owned()
    }

    fn predict(&mut self, motion: &Motion, time_s: f64, prediction: &mut TorquePrediction) {
        for i in 0..self.delays_s.len() {
            let delay_s = self.delays_s[i];
            self.find(motion, time_s + delay_s + self.lead_s);
            for (joint, own_s) in self.compensation.delay_s().iter().enumerate() {
                if own_s.total_cmp(&delay_s).is_eq() {
                    prediction.tau[joint] = self.found.tau[joint];
                }
            }
        }
        if self.compensation.leads() {
            self.find(motion, time_s);
        }
        prediction.q_lead.copy_from_slice(&self.found.q_lead);
        prediction.qd_lead.copy_from_slice(&self.found.qd_lead);
    }
}

#[cfg(test)]
mod tests {
    use motion::MotionSpec;

    use super::*;

    const INERTIA: f64 = 0.3;
    const LEAD_S: f64 = 1e-3;

    /// A wheel and a wheel beside it on one axis, each with a drive of its own.
    fn wheels() -> Robot {
        let link = |name: &str| {
            format!(
                "<link name=\"{name}\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" \
                 ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"{INERTIA}\"/></inertial></link>"
            )
        };
        let joint = |name: &str, child: &str| {
            format!(
                "<joint name=\"{name}\" type=\"revolute\"><parent link=\"base\"/>\
                 <child link=\"{child}\"/><axis xyz=\"0 0 1\"/>\
                 <limit lower=\"-3\" upper=\"3\" velocity=\"10\" effort=\"10\"/></joint>"
            )
        };
        let urdf = format!(
            "<robot name=\"wheels\"><link name=\"base\"/>{}{}{}{}</robot>",
            link("a"),
            link("b"),
            joint("ja", "a"),
            joint("jb", "b")
        );
        Robot::from_urdf(&urdf).unwrap()
    }

    fn swing(robot: &Robot) -> Motion {
        let text = "[sinusoids]\nseed = 3\nterms = 1\nlowest_hz = 1.0\nhighest_hz = 1.0\n\
                    duration_s = 10.0";
        toml::from_str::<MotionSpec>(text).unwrap().build(robot, ".".as_ref()).unwrap()
    }

    fn predict_torque(robot: &Robot, motion: &Motion, time_s: f64) -> TorquePrediction {
        let mut feedforward = NamedFeedforward::new(robot, &[0.01, 0.01], LEAD_S).unwrap();
        let mut prediction = TorquePrediction::zero(2);
        feedforward.predict(motion, time_s, &mut prediction);
        prediction
    }

    #[test]
    fn every_joint_is_asked_as_much_earlier_as_its_own_drive_is_late() {
        let mut robot = wheels();
        robot.link_mut(0).unwrap().actuator.delay_s = 0.02;
        let motion = swing(&robot);
        let found = predict_torque(&robot, &motion, 4.0);
        for (joint, ahead_s) in [(0, 0.02 + LEAD_S), (1, LEAD_S)] {
            let expected = INERTIA * motion.at(4.0 + ahead_s).qdd[joint];
            assert!((found.tau[joint] - expected).abs() < 1e-12, "joint {joint}");
        }
        assert!(found.q_lead.iter().all(|lead| lead.abs() < 1e-15));
    }

    #[test]
    fn the_motor_of_an_elastic_joint_is_ahead_by_its_twist_of_the_present() {
        let mut robot = wheels();
        let actuator = &mut robot.link_mut(0).unwrap().actuator;
        (actuator.delay_s, actuator.elasticity) = (0.02, Some(50.0));
        let motion = swing(&robot);
        let found = predict_torque(&robot, &motion, 4.0);
        let twist = INERTIA * motion.at(4.0).qdd[0] / 50.0;
        assert!((found.q_lead[0] - twist).abs() < 1e-12, "{} and {twist}", found.q_lead[0]);
        assert!(found.q_lead[1].abs() < 1e-15);
    }

    #[test]
    fn an_encoder_of_a_rigid_joint_is_led_by_what_it_is_off_at_present() {
        let mut robot = wheels();
        let actuator = &mut robot.link_mut(0).unwrap().actuator;
        (actuator.delay_s, actuator.encoder_offset) = (0.02, 0.1);
        (actuator.transmission_ratio, actuator.lag_s) = (1.25, 0.005);
        let motion = swing(&robot);
        let found = predict_torque(&robot, &motion, 4.0);
        let now = motion.at(4.0);
        assert!((found.q_lead[0] - (0.1 - 0.2 * now.q[0])).abs() < 1e-12);
        assert!((found.qd_lead[0] + 0.2 * now.qd[0]).abs() < 1e-12);
        assert!(found.q_lead[1].abs() < 1e-15);
    }

    #[test]
    fn rest_speeds_of_another_number_of_joints_are_refused() {
        let error = NamedFeedforward::new(&wheels(), &[0.01], LEAD_S).unwrap_err();
        let what = "the set of rest speeds";
        assert_eq!(error, TrackingError::JointCount { what, got: 1, expected: 2 });
    }
}
