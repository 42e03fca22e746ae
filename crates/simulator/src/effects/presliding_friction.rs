use catalogue::EffectKind;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::{Actuator, Robot};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::{MOST_DRY, Surroundings};
use crate::effects::truth::Truth;
use crate::mechanics::inject::{Efforts, Inject, Moment};

/// Damping ratio of a rotor on bristles that a description gives: it has no key for it.
const DAMPING_RATIO: f64 = 0.5;

/// Least dry friction (N m or N).
const LEAST_DRY: f64 = 1e-6;

/// Least stiffness of bristles (N m/rad or N/m).
const LEAST_STIFFNESS: f64 = 1e-3;

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

impl ScenarioEffect for PreslidingFriction {
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
        within("stiffness_nm_per_rad", self.stiffness_nm_per_rad, LEAST_STIFFNESS, 1e7)?;
        within("damping_nm_s_per_rad", self.damping_nm_s_per_rad, 0.0, 1e5)?;
        within("level_nm", self.level_nm, LEAST_DRY, MOST_DRY)?;
        Ok(Box::new(Injected {
            joint,
            stiffness: self.stiffness_nm_per_rad,
            damping: self.damping_nm_s_per_rad,
            level: self.level_nm,
            bristles: Bristles { way: self.level_nm / self.stiffness_nm_per_rad, ..RELAXED },
        }))
    }

    /// Bristles that slide after 0.5 to 5 mrad, with a damping ratio of 0.3 to 1 on the rotor.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let level = at.dry(share).max(LEAST_DRY);
        let stiffness = (level / random.random_range(5e-4..5e-3)).max(LEAST_STIFFNESS);
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
    bristles: Bristles,
}

/// Bristles by the share of their level that they hold:
///
/// ```text
/// share = stiffness z / level,   d(share) = (dq - |dq| share) / way,   way = level / stiffness
/// ```
struct Bristles {
    way: f64,
    share: f64,
    /// Position of the motor that the share belongs to (rad or m).
    last_q: f64,
}

const RELAXED: Bristles = Bristles { way: f64::INFINITY, share: 0.0, last_q: 0.0 };

impl Bristles {
    /// The share once the motor is at `q`.
    fn follow(&mut self, q: f64) -> f64 {
        let way = q - self.last_q;
        self.last_q = q;
        let slid = -(-way.abs() / self.way).exp_m1();
        self.share += slid * (way.signum() - self.share);
        self.share
    }
}

impl Inject for Injected {
    fn on_start(&mut self, q: &[f64]) {
        (self.bristles.share, self.bristles.last_q) = (0.0, q[self.joint]);
    }

    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        let share = self.bristles.follow(moment.motor_q[self.joint]);
        let direction = moment.motor_qd[self.joint].signum();
        efforts.bristles[self.joint] -= self.level * share;
        efforts.viscous[self.joint] += self.damping * (1.0 - direction * share);
    }

    fn springs(&self) -> Vec<(usize, f64)> {
        vec![(self.joint, self.stiffness)]
    }
}

/// What bends all dry friction that a joint has so far over the way that its drive says.
/// `stiffness` (N m/rad or N/m) is the most that the bristles come to.
pub(super) fn bending(joint: usize, drive: &Actuator, stiffness: f64) -> Box<dyn Inject> {
    let bristles = Bristles { way: drive.presliding.unwrap_or(f64::INFINITY), ..RELAXED };
    let critical = 2.0 * (stiffness * drive.rotor_inertia).sqrt();
    let damping = drive.presliding_damping.unwrap_or(DAMPING_RATIO * critical);
    Box::new(Bending { joint, stiffness, damping, bristles, has_started: false })
}

struct Bending {
    joint: usize,
    stiffness: f64,
    damping: f64,
    bristles: Bristles,
    has_started: bool,
}

impl Inject for Bending {
    fn on_start(&mut self, q: &[f64]) {
        (self.bristles.last_q, self.has_started) = (q[self.joint], false);
    }

    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        let j = self.joint;
        let direction = moment.motor_qd[j].signum();
        if !self.has_started {
            // A joint that moves has slid before; what one at rest holds is not known.
            let moves = moment.motor_qd[j].abs() > 0.0;
            (self.bristles.share, self.has_started) = (if moves { direction } else { 0.0 }, true);
        }
        let share = self.bristles.follow(moment.motor_q[j]);
        let level = if share > 0.0 { efforts.dry_forward[j] } else { efforts.dry_backward[j] };
        (efforts.dry_forward[j], efforts.dry_backward[j]) = (0.0, 0.0);
        efforts.bristles[j] -= level.max(0.0) * share;
        efforts.viscous[j] += self.damping * (1.0 - direction * share);
    }

    fn springs(&self) -> Vec<(usize, f64)> {
        vec![(self.joint, self.stiffness)]
    }
}
