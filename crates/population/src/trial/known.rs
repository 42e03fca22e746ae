use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::{Loaded, Robot};

use crate::error::PopulationError;
use crate::robot_files::RobotFiles;
use crate::trial::background::Friction;

/// What the nominal model states about everyday friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NominalKnowledge {
    /// The content of the bench's files: nothing, or a URDF's dummy value.
    AsDescribed,
    /// No friction and no rotor, since the effort is measured behind the drive.
    BodiesAlone,
    /// Values within a third of the truth.
    Roughly,
    /// The truth.
    Exactly,
}

/// The nominal model with what it knows of friction; `loaded` is that of `files`.
pub(crate) fn describe(
    files: &RobotFiles,
    loaded: &Loaded,
    friction: &[Friction],
    known: NominalKnowledge,
    random: &mut ChaCha8Rng,
) -> Result<RobotFiles, PopulationError> {
    let spread = match known {
        NominalKnowledge::AsDescribed => return Ok(files.clone()),
        NominalKnowledge::Roughly => Some(1.0 / 3.0),
        NominalKnowledge::Exactly => Some(0.0),
        NominalKnowledge::BodiesAlone => None,
    };
    let mut robot: Robot = loaded.robot.clone();
    for (i, friction) in friction.iter().enumerate() {
        let Some(link) = robot.link_mut(i) else { continue };
        let Some(spread) = spread else {
            let drive = &mut link.actuator;
            drive.coulomb_forward = 0.0;
            drive.coulomb_backward = 0.0;
            drive.viscous = 0.0;
            drive.rotor_inertia = 0.0;
            continue;
        };
        let mut near = |value: f64| value * (1.0 + spread * random.random_range(-1.0..1.0));
        let coulomb = near(friction.coulomb);
        link.actuator.coulomb_forward = coulomb;
        link.actuator.coulomb_backward = coulomb;
        link.actuator.viscous = near(friction.viscous);
    }
    Ok(RobotFiles { toml: loaded.to_toml(&robot, "robot.urdf")?, ..files.clone() })
}
