use catalogue::EffectKind;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Effect, Mistake, Surroundings, joint_of, within};
use crate::{Efforts, Inject, Moment, Truth};

/// Dry friction that gives like a spring before it slides: the LuGre model without the Stribeck
/// effect.
///
/// ```text
/// friction = -(stiffness z + damping zd)
/// zd = qd - stiffness |qd| z / level
/// ```
///
/// Over a way `dq` of the motor the deflection `z` of the bristles goes to
/// `z_end + (z - z_end) exp(-stiffness |dq| / level)` with `z_end = sign(dq) level / stiffness`:
/// exact, and free of the speed. `zd` is a share of `qd` between 0 and 2, so the damping is the
/// engine's, which takes it implicitly. The model creeps under a torque that pulsates below
/// `level`. Source: Canudas de Wit, Olsson, Astrom & Lischinsky 1995.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PreslidingFriction {
    /// The joint.
    pub joint: String,
    /// Stiffness of the bristles (N m/rad; N/m for a prismatic joint), 0.001 to 1e7.
    pub stiffness_nm_per_rad: f64,
    /// Damping of the bristles (N m s/rad; N s/m for a prismatic joint), 0 to 1e5.
    pub damping_nm_s_per_rad: f64,
    /// Friction while sliding (N m; N for a prismatic joint), 1e-6 to 1000.
    pub level_nm: f64,
}

impl Effect for PreslidingFriction {
    const KIND: EffectKind = EffectKind::PreslidingFriction;

    fn truth(&self) -> Truth {
        let parameters = [
            ("stiffness", self.stiffness_nm_per_rad),
            ("damping", self.damping_nm_s_per_rad),
            ("level", self.level_nm),
        ];
        Truth::at_joint(Self::KIND, &self.joint, &parameters)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("stiffness_nm_per_rad", self.stiffness_nm_per_rad, 1e-3, 1e7)?;
        within("damping_nm_s_per_rad", self.damping_nm_s_per_rad, 0.0, 1e5)?;
        within("level_nm", self.level_nm, 1e-6, 1000.0)?;
        Ok(Box::new(Injected {
            joint,
            stiffness: self.stiffness_nm_per_rad,
            damping: self.damping_nm_s_per_rad,
            level: self.level_nm,
            deflection: 0.0,
            last_q: 0.0,
        }))
    }

    /// Bristles that slide after 0.5 to 5 mrad, with a damping ratio of 0.3 to 1 on the rotor.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let level = (share * at.torque_rms).max(1e-6);
        let stiffness = level / random.random_range(5e-4..5e-3);
        let rotor = at.robot.links().get(at.joint).map_or(0.0, |l| l.actuator.rotor_inertia);
        let critical = 2.0 * (stiffness * rotor).sqrt();
        Self {
            joint: at.joint_name(),
            stiffness_nm_per_rad: stiffness,
            damping_nm_s_per_rad: critical * random.random_range(0.3..1.0),
            level_nm: level,
        }
    }
}

struct Injected {
    joint: usize,
    stiffness: f64,
    damping: f64,
    level: f64,
    /// Deflection of the bristles (rad or m).
    deflection: f64,
    /// Position of the motor that it belongs to (rad or m).
    last_q: f64,
}

impl Inject for Injected {
    fn on_start(&mut self, q: &[f64]) {
        self.deflection = 0.0;
        self.last_q = q[self.joint];
    }

    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        let way = moment.motor_q[self.joint] - self.last_q;
        self.last_q = moment.motor_q[self.joint];
        let end = way.signum() * self.level / self.stiffness;
        let slid = -(-self.stiffness * way.abs() / self.level).exp_m1();
        self.deflection += slid * (end - self.deflection);

        let torque = self.stiffness * self.deflection;
        let direction = moment.motor_qd[self.joint].signum();
        efforts.bristles[self.joint] -= torque;
        efforts.viscous[self.joint] += self.damping * (1.0 - direction * torque / self.level);
    }

    fn springs(&self) -> Vec<(usize, f64)> {
        vec![(self.joint, self.stiffness)]
    }
}
