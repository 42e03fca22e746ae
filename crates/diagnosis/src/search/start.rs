use crate::columns::design::Design;
use crate::regression::problem::HypothesisSet;

/// The model that a search begins with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Start {
    /// The robot as it is described.
    Described,
    /// An arm as arms are: dry and viscous friction, rotor inertia and torque offset of every joint that the design has
    /// them for ([`effects::Hypothesis::is_everyday`]).
    Everyday,
}

impl Start {
    /// The model of this start.
    pub fn model(self, design: &Design) -> HypothesisSet {
        let is_everyday = |g: &usize| design.groups[*g].hypothesis.is_everyday();
        match self {
            Self::Described => HypothesisSet::new(),
            Self::Everyday => (0..design.groups.len()).filter(is_everyday).collect(),
        }
    }
}
