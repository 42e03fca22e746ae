use crate::columns::design::Design;
use crate::regression::problem::HypothesisSet;

/// The model of an arm as arms are: dry and viscous friction, rotor inertia and torque offset of every joint that the
/// design has them for ([`effects::Hypothesis::is_everyday`]).
pub(crate) fn everyday(design: &Design) -> HypothesisSet {
    let is_everyday = |g: &usize| design.groups[*g].hypothesis.is_everyday();
    (0..design.groups.len()).filter(is_everyday).collect()
}
