use robot::{Actuator, Robot};

/// Where an effect acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Place {
    /// At a joint, by index.
    Joint(usize),
    /// In a moving link, by index.
    Link(usize),
    /// At the base.
    Base,
}

/// Every joint of the robot.
pub(crate) fn every_joint(robot: &Robot) -> Vec<Place> {
    (0..robot.joint_count()).map(Place::Joint).collect()
}

/// The joints whose drive is such.
pub(crate) fn joints_where(robot: &Robot, is_such: fn(&Actuator) -> bool) -> Vec<Place> {
    let drives = robot.links().iter().enumerate();
    drives.filter(|(_, link)| is_such(&link.actuator)).map(|(j, _)| Place::Joint(j)).collect()
}
