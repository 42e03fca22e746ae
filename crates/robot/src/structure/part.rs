use std::collections::BTreeMap;

use document::KeyPath;

use crate::error::RobotError;
use crate::misfit::Misfit;
use crate::range::Range;
use crate::structure::locked_joint::LockedJoint;
use crate::structure::robot::Robot;

/// Which joints of a robot move. All others are locked, which fixes the links that they carry.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct JointSelection {
    /// Names of the joints that move; `None` for all that are not locked.
    pub joints: Option<Vec<String>>,
    /// Positions of locked joints (rad or m); a joint that neither field names is locked at zero.
    pub locked: BTreeMap<String, f64>,
}

/// `<mimic>`: how a joint follows its master.
///
/// ```text
/// q = multiplier q_master + offset
/// ```
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Mimic {
    pub master: String,
    pub multiplier: f64,
    /// Position with the master at zero (rad or m).
    pub offset: f64,
}

/// The master of each joint with `<mimic>`.
pub(crate) type Mimics = BTreeMap<String, Mimic>;

impl JointSelection {
    /// Whether every joint moves that can.
    pub fn is_whole(&self) -> bool {
        *self == Self::default()
    }

    /// The joints of `whole` that are locked, in its order.
    ///
    /// A joint that mimics another follows its locked master, or its master at zero.
    ///
    /// # Errors
    ///
    /// [`RobotError::NotFinite`] for the position of a joint that mimics another.
    pub(crate) fn locks(
        &self,
        whole: &Robot,
        mimics: &Mimics,
    ) -> Result<Vec<LockedJoint>, RobotError> {
        let mut locks = vec![];
        for joint in whole.joint_names() {
            let lock = |position, mimics| LockedJoint { joint: joint.into(), position, mimics };
            if let Some(position) = self.locked_position(joint, mimics) {
                locks.push(lock(position, None));
            } else if let Some(mimic) = mimics.get(joint) {
                let position = self.position_as_mimic(joint, mimics);
                finite(joint, "position as a mimic", position)?;
                locks.push(lock(position, Some(mimic.master.clone())));
            }
        }
        Ok(locks)
    }

    /// The joint that moves and that `joint` follows, directly or through others.
    pub(crate) fn moving_master<'a>(
        &self,
        joint: &str,
        whole: &'a Robot,
        mimics: &Mimics,
    ) -> Option<&'a str> {
        let (_, _, last) = self.trace_master(joint, mimics);
        let moves = self.locked_position(last, mimics).is_none();
        let index = whole.joint_index(last).filter(|_| moves)?;
        whole.joint_names().nth(index)
    }

    /// Refuses keys that name joints which do not move, name a joint twice, or give an impossible position.
    pub(crate) fn check(&self, whole: &Robot, mimics: &Mimics) -> Result<(), Misfit> {
        let root = KeyPath::root();
        let known = |key: &KeyPath, name: &str| match whole.joint_index(name) {
            Some(_) => Ok(()),
            None => Err(Misfit::name(key.clone(), "moving joint", name, whole.joint_names())),
        };
        for (at, name) in self.joints.iter().flatten().enumerate() {
            let key = root.key("joints").index(at);
            known(&key, name)?;
            if let Some(Mimic { master, .. }) = mimics.get(name) {
                let sentence = format!(
                    "joint {name} mimics joint {master} and is held where that one has it, an \
                     independent joint was expected among those that move"
                );
                return Err(Misfit::new(key, sentence));
            }
            if self.locked.contains_key(name) {
                let sentence =
                    format!("joint {name} is in joints and in locked, one of the two was expected");
                return Err(Misfit::new(key, sentence));
            }
        }
        for (name, &position) in &self.locked {
            let key = root.key("locked").key(name);
            known(&key, name)?;
            if let Some(expected) = Range::Finite.expects(position) {
                let sentence = format!("the position is {position}, {expected} was expected");
                return Err(Misfit::new(key, sentence));
            }
        }
        Ok(())
    }

    /// The position at which the keys lock a joint (rad or m).
    fn locked_position(&self, joint: &str, mimics: &Mimics) -> Option<f64> {
        let left_out = self.joints.as_ref().is_some_and(|kept| !kept.iter().any(|k| k == joint));
        let at_zero = (left_out && !mimics.contains_key(joint)).then_some(0.0);
        self.locked.get(joint).copied().or(at_zero)
    }

    /// Where a joint that mimics another is held (rad or m).
    fn position_as_mimic(&self, joint: &str, mimics: &Mimics) -> f64 {
        let (multiplier, offset, last) = self.trace_master(joint, mimics);
        multiplier * self.locked_position(last, mimics).unwrap_or(0.0) + offset
    }

    /// Multiplier and offset with which `joint` follows the first master that has a position of its
    /// own, and that master. The chain ends, since loops were refused when the URDF was read.
    fn trace_master<'a>(&self, joint: &'a str, mimics: &'a Mimics) -> (f64, f64, &'a str) {
        let (mut multiplier, mut offset, mut at) = (1.0, 0.0, joint);
        for _ in 0..mimics.len() {
            let Some(mimic) = mimics.get(at).filter(|_| self.locked_position(at, mimics).is_none())
            else {
                break;
            };
            offset += multiplier * mimic.offset;
            multiplier *= mimic.multiplier;
            at = &mimic.master;
        }
        (multiplier, offset, at)
    }
}

/// The positions by the names of the joints.
pub(crate) fn positions(locks: &[LockedJoint]) -> BTreeMap<String, f64> {
    locks.iter().map(|lock| (lock.joint.clone(), lock.position)).collect()
}

fn finite(joint: &str, quantity: &'static str, value: f64) -> Result<(), RobotError> {
    let thing = format!("joint {joint}");
    if value.is_finite() { Ok(()) } else { Err(RobotError::NotFinite { thing, quantity, value }) }
}
