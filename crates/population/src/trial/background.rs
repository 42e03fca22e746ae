use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use simulator::effects::{CoulombFriction, EffectSpec, ViscousFriction};

/// Everyday friction of one joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Friction {
    /// Level of the dry part (N m or N).
    pub coulomb: f64,
    /// Torque per unit of velocity (N m s/rad or N s/m).
    pub viscous: f64,
}

/// Largest dry friction that is drawn (N m or N), an upper bound for drives of these arms.
pub(crate) const MOST_DRY: f64 = 900.0;

/// Draws everyday friction at every joint: half to twice the drive's typical dry level, and viscous friction
/// that at the joint's largest speed is a tenth of that level to all of it.
pub(crate) fn draw_friction(
    robot: &Robot,
    usual: &[f64],
    random: &mut ChaCha8Rng,
) -> Vec<Friction> {
    let joint = |(link, usual): (&robot::Link, &f64)| {
        let coulomb = (usual * 2.0_f64.powf(random.random_range(-1.0..1.0))).min(MOST_DRY);
        let speed = link.joint.limits.velocity.unwrap_or(2.0).max(0.1);
        let share = 10.0_f64.powf(random.random_range(-1.0..0.0));
        Friction { coulomb, viscous: share * coulomb / speed }
    };
    robot.links().iter().zip(usual).map(joint).collect()
}

/// The friction as effects of a scenario: two per joint, the dry one first.
pub(crate) fn effects(robot: &Robot, friction: &[Friction]) -> Vec<EffectSpec> {
    let both = |(name, friction): (&str, &Friction)| {
        let joint = name.to_owned();
        [
            EffectSpec::CoulombFriction(CoulombFriction {
                joint: joint.clone(),
                level_nm: friction.coulomb,
            }),
            EffectSpec::ViscousFriction(ViscousFriction {
                joint,
                viscous_nm_s_per_rad: friction.viscous,
            }),
        ]
    };
    robot.joint_names().zip(friction).flat_map(both).collect()
}
