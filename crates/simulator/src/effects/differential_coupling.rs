use std::f64::consts::TAU;

use catalogue::EffectKind;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::{Coupling, Robot};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::Surroundings;
use crate::effects::truth::Truth;
use crate::mechanics::inject::{Efforts, Inject, Moment};

/// Frequency of a rotor on the bristles (Hz): 0.19 rad a step of 0.2 ms.
const BRISTLE_HZ: f64 = 150.0;

/// Damping ratio of a rotor on the bristles.
const DAMPING_RATIO: f64 = 0.5;

/// Dry friction at the two motors of a differential that drives two joints.
///
/// ```text
/// motor speeds:  w_sum = qd_a + ratio qd_b,  w_difference = qd_a - ratio qd_b
/// friction on a: -(level_sum sign(w_sum) + level_difference sign(w_difference))
/// friction on b: -ratio (level_sum sign(w_sum) - level_difference sign(w_difference))
/// ```
///
/// The second half is the virtual work of the first. The engine has no constraint on sums of
/// coordinates, so each motor drags a bristle that holds up to the level and then slides:
///
/// ```text
/// torque = clamp(k z + d w, -level, level),  zd = w,  |z| <= level / k
/// ```
///
/// Below its level it does not creep. With `J = min(J_a, J_b / ratio^2)` of the rotor inertias,
/// `k = J omega^2 / 2` puts the two rotors on their bristles at no more than `omega`, 150 Hz; the
/// way to break is `level / k`, 12 microradians per newton metre at a WAM's shoulder.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DifferentialCoupling {
    /// The joint that both motors drive alike.
    pub joint_a: String,
    /// The joint that they drive against each other.
    pub joint_b: String,
    /// Turn of a motor by joint b over that by joint a (no unit), 0.01 to 10.
    pub ratio: f64,
    /// Friction of the motor that turns with the sum, seen at joint a (N m), 0 to 1000.
    pub level_sum_nm: f64,
    /// Friction of the motor that turns with the difference, seen at joint a (N m), 0 to 1000.
    pub level_difference_nm: f64,
}

impl ScenarioEffect for DifferentialCoupling {
    const KIND: EffectKind = EffectKind::DifferentialCoupling;

    fn truth(&self) -> Truth {
        let parameters = [
            ("ratio", self.ratio),
            ("level_sum", self.level_sum_nm),
            ("level_difference", self.level_difference_nm),
            ("viscous_sum", 0.0),
            ("viscous_difference", 0.0),
        ];
        Truth::at_joint(Self::KIND, &self.joint_a, &parameters)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        within("ratio", self.ratio, 0.01, 10.0)?;
        within("level_sum_nm", self.level_sum_nm, 0.0, 1000.0)?;
        within("level_difference_nm", self.level_difference_nm, 0.0, 1000.0)?;
        let (joint_a, rotor_a) = motor(robot, "joint_a", &self.joint_a)?;
        let (joint_b, rotor_b) = motor(robot, "joint_b", &self.joint_b)?;
        if joint_a == joint_b {
            let found = format!("{}, another joint than joint_a was expected", self.joint_b);
            return Err(Mistake { key: "joint_b", found });
        }

        let level = [self.level_sum_nm, self.level_difference_nm];
        let coupling = Coupling { other: joint_b, ratio: self.ratio, level, viscous: [0.0; 2] };
        Ok(acting(joint_a, [rotor_a, rotor_b], coupling))
    }

    /// A pair with the next joint, or of the last two if it is the last, and two motors whose levels
    /// differ by up to a fifth.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let first = at.joint.min(at.robot.joint_count().saturating_sub(2));
        let name = |joint| Surroundings { joint, ..*at }.joint_name();
        let level = 0.5 * share * at.torque_rms;
        Self {
            joint_a: name(first),
            joint_b: name(first + 1),
            ratio: random.random_range(0.5..1.0),
            level_sum_nm: level,
            level_difference_nm: level * random.random_range(0.8..1.2),
        }
    }
}

/// The friction of motors that `joint_a` shares, whose rotors and that of the other joint have
/// the inertias `rotors` (kg m² or kg), ready to act.
pub(super) fn acting(joint_a: usize, rotors: [f64; 2], coupling: Coupling) -> Box<dyn Inject> {
    let Coupling { other, ratio, level, viscous } = coupling;
    let inertia = rotors[0].min(rotors[1] / (ratio * ratio));
    let omega = TAU * BRISTLE_HZ;
    let motor = |k: usize, ratio: f64| {
        let (level, viscous) = (level[k], viscous[k]);
        Motor { level, viscous, ratio, deflection: 0.0, last: 0.0 }
    };
    Box::new(Injected {
        joint_a,
        joint_b: other,
        stiffness: 0.5 * inertia * omega * omega,
        damping: DAMPING_RATIO * inertia * omega,
        motors: [motor(0, ratio), motor(1, -ratio)],
    })
}

/// A joint that a scenario names, and the inertia of its rotor (kg m² or kg).
fn motor(robot: &Robot, key: &'static str, name: &str) -> Result<(usize, f64), Mistake> {
    let joint = joint_of(robot, name).map_err(|mistake| Mistake { key, ..mistake })?;
    let inertia = robot.links().get(joint).map_or(0.0, |l| l.actuator.rotor_inertia);
    if inertia > 0.0 {
        return Ok((joint, inertia));
    }
    let found = format!(
        "{name}, whose rotor inertia is {inertia} kg m^2, a positive one was expected: give rotor_inertia_kg_m2 in robot.toml"
    );
    Err(Mistake { key, found })
}

struct Injected {
    joint_a: usize,
    joint_b: usize,
    /// Of each bristle, seen at joint a (N m/rad).
    stiffness: f64,
    /// Of each bristle, seen at joint a (N m s/rad).
    damping: f64,
    motors: [Motor; 2],
}

/// One motor and its bristle, seen at joint a.
struct Motor {
    /// Dry friction (N m).
    level: f64,
    /// Viscous friction (N m s/rad).
    viscous: f64,
    /// Turn by joint b over turn by joint a.
    ratio: f64,
    /// Deflection of the bristle (rad).
    deflection: f64,
    /// Position that it belongs to (rad).
    last: f64,
}

impl Inject for Injected {
    fn on_start(&mut self, q: &[f64]) {
        for motor in &mut self.motors {
            motor.deflection = 0.0;
            motor.last = q[self.joint_a] + motor.ratio * q[self.joint_b];
        }
    }

    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        for motor in &mut self.motors {
            let of = |row: &[f64]| row[self.joint_a] + motor.ratio * row[self.joint_b];
            let (position, speed) = (of(moment.motor_q), of(moment.motor_qd));
            let most = motor.level / self.stiffness;
            motor.deflection = (motor.deflection + position - motor.last).clamp(-most, most);
            motor.last = position;

            let torque = self.stiffness * motor.deflection + self.damping * speed;
            let torque = torque.clamp(-motor.level, motor.level) + motor.viscous * speed;
            efforts.bristles[self.joint_a] -= torque;
            efforts.bristles[self.joint_b] -= motor.ratio * torque;
        }
    }

    fn springs(&self) -> Vec<(usize, f64)> {
        self.motors
            .iter()
            .flat_map(|m| {
                [(self.joint_a, self.stiffness), (self.joint_b, m.ratio * m.ratio * self.stiffness)]
            })
            .collect()
    }
}
