//! Names that MuJoCo takes.

use robot::Robot;

/// The robot with a name for a joint that has none: `joint`, or `joint_2` where that is taken. MuJoCo takes an empty name
/// as no name, and an actuator cannot refer to such a joint.
pub fn with_names(robot: &Robot) -> Robot {
    let mut robot = robot.clone();
    for index in 0..robot.joint_count() {
        let is_taken = |name: &str| robot.joint_index(name).is_some();
        let numbered = || (2..).map(|number| format!("joint_{number}"));
        let free =
            std::iter::once("joint".to_owned()).chain(numbered()).find(|name| !is_taken(name));
        if let (Some(link), Some(free)) = (robot.link_mut(index), free)
            && link.joint.name.is_empty()
        {
            link.joint.name = free;
        }
    }
    robot
}
