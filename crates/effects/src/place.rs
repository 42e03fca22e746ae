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

/// A place of one kind, for effects that act at this kind of place only.
pub trait TypedPlace: Copy {
    /// `place` as this kind, or `None` if it is of another kind.
    fn of(place: Place) -> Option<Self>;

    /// The place as a [`Place`].
    fn place(self) -> Place;
}

/// At a joint, by index.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AtJoint(pub usize);

/// In a moving link, by index.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct InLink(pub usize);

/// At the base.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AtBase;

impl TypedPlace for AtJoint {
    fn of(place: Place) -> Option<Self> {
        match place {
            Place::Joint(joint) => Some(Self(joint)),
            Place::Link(_) | Place::Base => None,
        }
    }

    fn place(self) -> Place {
        Place::Joint(self.0)
    }
}

impl TypedPlace for InLink {
    fn of(place: Place) -> Option<Self> {
        match place {
            Place::Link(link) => Some(Self(link)),
            Place::Joint(_) | Place::Base => None,
        }
    }

    fn place(self) -> Place {
        Place::Link(self.0)
    }
}

impl TypedPlace for AtBase {
    fn of(place: Place) -> Option<Self> {
        (place == Place::Base).then_some(Self)
    }

    fn place(self) -> Place {
        Place::Base
    }
}

/// Every joint of the robot.
pub(crate) fn every_joint(robot: &Robot) -> Vec<AtJoint> {
    (0..robot.joint_count()).map(AtJoint).collect()
}

/// The joints with a drive that fulfils `condition`.
pub(crate) fn joints_where(robot: &Robot, condition: fn(&Actuator) -> bool) -> Vec<AtJoint> {
    let drives = robot.links().iter().enumerate();
    drives.filter(|(_, link)| condition(&link.actuator)).map(|(j, _)| AtJoint(j)).collect()
}
