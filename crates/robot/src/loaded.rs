use std::path::PathBuf;

use document::KeyPath;

use crate::misfit::Misfit;
use crate::structure::control::ControlSettings;
use crate::structure::locked_joint::LockedJoint;
use crate::structure::looks::Looks;
use crate::structure::part::JointSelection;
use crate::structure::robot::Robot;
use crate::warning::RobotWarning;

/// A robot as its files describe it.
#[derive(Debug, Clone, PartialEq)]
pub struct Loaded {
    /// The robot, with everything that `robot.toml` says. It has no locked joints: the links that they
    /// carry are merged into their parents.
    pub robot: Robot,
    /// The robot as the URDF alone describes it, with the same joints locked.
    pub robot_in_urdf: Robot,
    /// What the robot looks like, as the URDF says.
    pub looks: Looks,
    /// The URDF or MJCF that was read.
    pub urdf_path: PathBuf,
    /// Its text with included files inserted; `None` where it includes no file.
    pub expanded: Option<String>,
    /// Name of the link that does not move; its frame is the base frame.
    pub base_link: String,
    /// Names of the links fixed to the base, which play no part in the dynamics.
    pub fixed_to_base: Vec<String>,
    /// Which joints were selected and which locked, as `robot.toml` states it.
    pub part: JointSelection,
    /// The joints of the URDF that are locked, in its order.
    pub locked: Vec<LockedJoint>,
    /// How the real robot is controlled; empty without a `robot.toml`.
    pub control: ControlSettings,
    /// Problems in the files that do not keep the robot from being used.
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
