use std::path::PathBuf;

use document::KeyPath;

use crate::misfit::Misfit;
use crate::structure::control::ControlSettings;
use crate::structure::looks::Looks;
use crate::structure::part::{LockedJoint, Part};
use crate::structure::robot::Robot;
use crate::warning::RobotWarning;

/// A robot as its files describe it.
#[derive(Debug, Clone, PartialEq)]
pub struct Loaded {
    /// The robot, with everything that `robot.toml` says. Joints that are locked are no joints of
    /// it: the links they carry are merged into what they hang on.
    pub robot: Robot,
    /// The robot as the URDF alone describes it, with the same joints locked.
    pub robot_in_urdf: Robot,
    /// What the robot looks like, as the URDF says.
    pub looks: Looks,
    /// The URDF or MJCF that was read.
    pub urdf_path: PathBuf,
    /// Its text with all that it includes, where it includes other files.
    pub expanded: Option<String>,
    /// Name of the link that does not move; its frame is the base frame.
    pub base_link: String,
    /// Names of the links fixed to the base; they have no part in the dynamics.
    pub fixed_to_base: Vec<String>,
    /// Which joints were asked for and which locked, in the words of `robot.toml`.
    pub part: Part,
    /// The joints of the URDF that are locked, in its order.
    pub locked: Vec<LockedJoint>,
    /// How the real robot is controlled; nothing is known without a `robot.toml`.
    pub control: ControlSettings,
    /// What the owner of the files should know.
    pub warnings: Vec<RobotWarning>,
}

impl Loaded {
    /// The joint called `name` at a key of `robot.toml`.
    pub(crate) fn joint_index(&self, key: &KeyPath, name: &str) -> Result<usize, Misfit> {
        self.robot.joint_index(name).ok_or_else(|| match self.lock(name) {
            Some(lock) => {
                let sentence = format!(
                    "joint {name} is locked at {}, one that moves was expected",
                    lock.position
                );
                Misfit::new(key.clone(), sentence)
            }
            None => Misfit::name(key.clone(), "joint", name, self.robot.joint_names()),
        })
    }

    /// How the joint called `name` is locked, if it is.
    pub(crate) fn lock(&self, name: &str) -> Option<&LockedJoint> {
        self.locked.iter().find(|lock| lock.joint == name)
    }
}
