use std::collections::BTreeSet;

use crate::error::RobotError;
use crate::structure::part::Mimics;
use crate::urdf::convert;

/// The joints that mimic another one; every chain of them ends at a joint that mimics none.
///
/// # Errors
///
/// [`RobotError::UnknownName`] for a master that is no joint, [`RobotError::NotFinite`],
/// [`RobotError::MimicLoop`].
pub(super) fn mimics(joints: &[urdf_rs::Joint]) -> Result<Mimics, RobotError> {
    let names: Vec<&str> = joints.iter().map(|j| j.name.as_str()).collect();
    let known: BTreeSet<&str> = names.iter().copied().collect();
    let mut mimics = Mimics::new();
    for joint in joints {
        let Some(mimic) = convert::mimic(joint)? else { continue };
        if !known.contains(mimic.master.as_str()) {
            let place = format!("joint {}: <mimic>", joint.name);
            return Err(RobotError::unknown_name(place, "joint", &mimic.master, &names));
        }
        mimics.insert(joint.name.clone(), mimic);
    }
    for joint in mimics.keys() {
        // As many steps as there are followers end at a master, or in a ring.
        let last = (0..mimics.len()).fold(joint, |at, _| mimics.get(at).map_or(at, |m| &m.master));
        if mimics.contains_key(last) {
            return Err(RobotError::MimicLoop { joint: last.clone() });
        }
    }
    Ok(mimics)
}
