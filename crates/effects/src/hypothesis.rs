use catalogue::EffectKind;
use robot::Robot;

use crate::{Column, Explain, Frame, Motion, Quantity, Scale, model};

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

/// An effect at a place: one thing that could be wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Hypothesis {
    /// The effect.
    pub kind: EffectKind,
    /// Where it acts.
    pub place: Place,
}

/// Everything in the catalogue that could be wrong with this robot.
pub fn hypotheses(robot: &Robot) -> Vec<Hypothesis> {
    let at = |kind| {
        let places = model(kind).places(robot);
        places.into_iter().map(move |place| Hypothesis { kind, place })
    };
    EffectKind::ALL.into_iter().flat_map(at).collect()
}

impl Hypothesis {
    fn model(self) -> &'static dyn Explain {
        model(self.kind)
    }

    /// See [`Explain::columns`].
    pub fn columns(self, motion: &Motion) -> Vec<Column> {
        self.model().columns(self.place, motion)
    }

    /// See [`Explain::prior`].
    pub fn prior(self, robot: &Robot, scale: &Scale) -> Vec<f64> {
        self.model().prior(self.place, robot, scale)
    }

    /// See [`Explain::bounds`].
    pub fn bounds(self, robot: &Robot) -> Vec<(f64, f64)> {
        self.model().bounds(self.place, robot)
    }

    /// See [`Explain::admissible`].
    pub fn admissible(self, robot: &Robot, weights: &[f64]) -> bool {
        self.model().admissible(self.place, robot, weights)
    }

    /// See [`Explain::extend`].
    pub fn extend(self, robot: &mut Robot, weights: &[f64], frame: &Frame) {
        self.model().extend(self.place, robot, weights, frame);
    }

    /// See [`Explain::quantities`].
    pub fn quantities(self, nominal: &Robot, extended: &Robot) -> Vec<Quantity> {
        self.model().quantities(self.place, nominal, extended)
    }

    /// Whether `self` and `other` are two names for changes of the same numbers,
    /// so that both cannot be part of one model.
    pub fn excludes(self, other: Self) -> bool {
        use EffectKind::{AsymmetricFriction, CoulombFriction, InertialParameters, Payload};
        let pair = (self.kind, other.kind);
        self.place == other.place
            && (matches!(pair, (InertialParameters, Payload) | (Payload, InertialParameters))
                || matches!(
                    pair,
                    (AsymmetricFriction, CoulombFriction) | (CoulombFriction, AsymmetricFriction)
                ))
    }

    /// Index of the joint, for an effect of a joint.
    pub fn joint(self) -> Option<usize> {
        match self.place {
            Place::Joint(joint) => Some(joint),
            Place::Link(_) | Place::Base => None,
        }
    }

    /// Index of the link, for an effect of a link.
    pub fn link(self) -> Option<usize> {
        match self.place {
            Place::Link(link) => Some(link),
            Place::Joint(_) | Place::Base => None,
        }
    }
}
