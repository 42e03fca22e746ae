use std::collections::BTreeMap;

use crate::structure::link::Link;
use crate::structure::lumping::Lumping;
use crate::structure::part::positions;
use crate::structure::robot::Robot;

impl Robot {
    /// The joint that is locked under this name, as it is described.
    pub fn locked_link(&self, joint: &str) -> Option<&Link> {
        let whole = self.whole()?;
        self.locks().iter().find(|lock| lock.joint == joint)?;
        whole.links().get(whole.joint_index(joint)?)
    }

    /// The same robot with locked joints at other positions (rad or m); a joint that is not named stays where it is locked.
    ///
    /// `None` where a joint is not locked, and where a body is described otherwise than by the links that it is made of.
    pub fn locked_at(&self, others: &BTreeMap<String, f64>) -> Option<Self> {
        let whole = self.whole()?;
        let mut locks = self.locks().to_vec();
        for (joint, position) in others {
            locks.iter_mut().find(|lock| lock.joint == *joint)?.position = *position;
        }
        let as_is = Lumping::new(whole, &positions(self.locks())).robot(whole).ok()?;
        let mut robot = Lumping::new(whole, &positions(&locks)).robot(whole).ok()?;
        for (index, (own, described)) in self.links().iter().zip(as_is.links()).enumerate() {
            if own.inertia != described.inertia {
                return None;
            }
            let link = robot.link_mut(index)?;
            link.actuator = own.actuator.clone();
            link.joint.limits = own.joint.limits;
        }
        Some(robot.with_gravity(self.gravity_in_base()).locked_in(whole, &locks))
    }
}
