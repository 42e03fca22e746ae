use robot::{Link, Loaded, Robot};

use crate::error::ExchangeError;
use crate::fate::{Fate, Fated};
use crate::held::held;
use crate::quantity::{Quantity, quantities};
use crate::reported::as_reported;
use crate::{mjcf, sdf, urdf, urdf_written, usda, usda_joint};

/// A format of robot descriptions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// The Unified Robot Description Format of ROS.
    Urdf,
    /// The format of MuJoCo.
    Mjcf,
    /// The Simulation Description Format of Gazebo.
    Sdf,
    /// A text layer of Universal Scene Description with the schemas of PhysX and Newton, for Isaac Sim and Isaac Lab.
    Isaac,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Urdf, Self::Mjcf, Self::Sdf, Self::Isaac];

    /// Its name in small letters.
    pub fn name(self) -> &'static str {
        match self {
            Self::Urdf => "urdf",
            Self::Mjcf => "mjcf",
            Self::Sdf => "sdf",
            Self::Isaac => "isaac",
        }
    }

    /// How a file of this format is called at its end.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Urdf => "urdf",
            Self::Mjcf => "xml",
            Self::Sdf => "sdf",
            Self::Isaac => "usda",
        }
    }
}

/// A robot in another program's file.
#[derive(Debug, Clone, PartialEq)]
pub struct Export {
    /// The file.
    pub text: String,
    /// Every quantity that is more than a rigid body's, with what became of it.
    pub fates: Vec<Fated>,
    /// The robot that the file describes, positions as encoders report them: what is exact, and what is
    /// approximated as it is written.
    pub robot: Robot,
}

/// The robot of `loaded` in a format, positions as its encoders report them.
///
/// `source` is the text of its URDF; a URDF is that text with what differs written into it, and a new
/// one where the robot was described otherwise.
///
/// # Errors
///
/// [`ExchangeError::Malformed`] and [`ExchangeError::JointAbsent`] where `source` is not the URDF of
/// the robot.
pub fn export(loaded: &Loaded, source: &str, format: Format) -> Result<Export, ExchangeError> {
    let robot = as_reported(&loaded.robot);
    let text = match format {
        Format::Urdf if source.contains("<robot") => urdf::edited(loaded, &robot, source)?,
        Format::Urdf => urdf_written::written(loaded, &robot),
        Format::Mjcf => mjcf::written(loaded, &robot),
        Format::Sdf => sdf::written(loaded, &robot),
        Format::Isaac => usda::written(loaded, &robot),
    };
    Ok(Export { text, fates: fates(loaded, format), robot: held(loaded, &robot, format) })
}

fn fates(loaded: &Loaded, format: Format) -> Vec<Fated> {
    let robot = &loaded.robot;
    let mut fates = vec![];
    let gravity = robot.gravity_in_base();
    if gravity != loaded.robot_in_urdf.gravity_in_base() {
        let [x, y, z] = [gravity.x, gravity.y, gravity.z].map(crate::numbers::size);
        let fate = match format {
            Format::Urdf => Fate::dropped("a URDF has no gravity: turn the base by as much"),
            Format::Mjcf => Fate::exact("<option gravity>"),
            Format::Sdf => Fate::near("<pose> of the model; its length is the world's"),
            Format::Isaac => Fate::exact("gravityDirection, gravityMagnitude of a PhysicsScene"),
        };
        let what = format!("gravity ({x}, {y}, {z}) m/s²");
        fates.push(Fated { at: "robot".to_owned(), what, fate });
    }
    for (link, old) in robot.links().iter().zip(loaded.robot_in_urdf.links()) {
        let is_told = matches!(format, Format::Mjcf | Format::Isaac);
        let is_impossible = is_told && !link.inertia.defects().is_empty();
        if link.inertia != old.inertia || is_impossible {
            fates.push(inertia(link, format));
        }
        for (quantity, what) in quantities(robot, link) {
            let fate = fate_of(quantity, link, format);
            fates.push(Fated { at: link.joint.name.clone(), what, fate });
        }
    }
    for lock in &loaded.locked {
        let fate = match format {
            Format::Urdf => Fate::dropped("the joint moves in the file, as it did before"),
            _ => Fate::exact("what it carries is part of the body it is fixed to"),
        };
        let what = format!("locked at {}", crate::numbers::size(lock.position));
        fates.push(Fated { at: lock.joint.clone(), what, fate });
    }
    fates
}

/// What becomes of a quantity of a joint.
pub(crate) fn fate_of(quantity: Quantity, link: &Link, format: Format) -> Fate {
    match format {
        Format::Urdf => urdf::fate(quantity),
        Format::Mjcf => mjcf::fate(quantity, link),
        Format::Sdf => sdf::fate(quantity, link),
        Format::Isaac => usda_joint::fate(quantity, link),
    }
}

fn inertia(link: &Link, format: Format) -> Fated {
    let defects = link.inertia.defects();
    let fate = match (format, defects.is_empty()) {
        (Format::Urdf, _) if !link.merged.is_empty() => {
            Fate::exact("<inertial> of the link; links fixed to it keep theirs")
        }
        (Format::Mjcf, false) => {
            Fate::near("no body has such moments: they are raised to what MuJoCo takes")
        }
        (Format::Isaac, false) => Fate::near(
            "no body has such moments: those below 0 are written as 0, which PhysX fills in",
        ),
        (Format::Isaac, true) => Fate::exact("PhysicsMassAPI"),
        _ => Fate::exact("<inertial>"),
    };
    let what = format!("mass {} kg, centre, moments", crate::numbers::size(link.inertia.mass));
    Fated { at: link.name.clone(), what, fate }
}

/// Why no format has a place for what only friction models of this program know.
pub(crate) fn unknown_friction(quantity: Quantity) -> Fate {
    use Quantity as Q;
    Fate::dropped(match quantity {
        Q::Stribeck => "dry friction of the format has one level at all speeds",
        Q::LoadFriction => "dry friction of the format has one level at all loads",
        Q::Presliding => "dry friction of the format is there at once",
        Q::FrictionWave => "dry friction of the format has one level at all positions",
        Q::Warming => {
            "friction of the format is the same at all times; what is written is that of the cold drive"
        }
        Q::Ripple => "torque of the format does not depend on the motor's position",
        Q::Counterbalance => "springs of the format are linear in the position",
        Q::SpringHysteresis => "springs of the format have no loop",
        Q::Ratio => "divide positions by it before they are compared",
        Q::Skew => "it is one of the log: move its efforts by as much",
        Q::EffortGain => "it is one of the log: divide its efforts by it",
        Q::EffortOffset => "it is one of the log: subtract it from its efforts",
        Q::Delay | Q::Lag => "the format has no actuators with a memory",
        Q::Rotor => "the format has no rotors: give it to the simulator itself",
        Q::Backlash => "joints of the format have no play",
        Q::Elasticity => "transmissions of the format are rigid",
        Q::Coupling => "friction of the format belongs to one joint",
        Q::Asymmetry => "the mean of both directions is written",
        Q::Spring | Q::SpringCubic => "joints of the format have no such springs",
        Q::Viscous | Q::Coulomb | Q::EncoderOffset => "the format has no place for it",
    })
}
