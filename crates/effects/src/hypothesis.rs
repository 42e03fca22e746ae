use catalogue::EffectKind;
use robot::Robot;

use crate::{Column, Explain, Frame, MODELLED, Motion, Quantity, Scale, model};

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
///
/// An effect without a model has no columns and changes no robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Hypothesis {
    /// The effect.
    pub kind: EffectKind,
    /// Where it acts.
    pub place: Place,
}

/// Every effect with a model at every place where it could act in this robot.
pub fn hypotheses(robot: &Robot) -> Vec<Hypothesis> {
    let at = |kind| {
        let places = model(kind).map(|m| m.places(robot)).unwrap_or_default();
        places.into_iter().map(move |place| Hypothesis { kind, place })
    };
    MODELLED.into_iter().flat_map(at).collect()
}

impl Hypothesis {
    fn model(self) -> Option<&'static dyn Explain> {
        model(self.kind).ok()
    }

    /// See [`Explain::columns`].
    pub fn columns(self, motion: &Motion) -> Vec<Column> {
        let mut columns = self.model().map(|m| m.columns(self.place, motion)).unwrap_or_default();
        for part in columns.iter_mut().flatten() {
            part.values = motion.timed(part.joint, std::mem::take(&mut part.values));
        }
        columns
    }

    /// See [`Explain::twist`].
    pub fn twist(self, motion: &Motion) -> Vec<Column> {
        self.model().map(|m| m.twist(self.place, motion)).unwrap_or_default()
    }

    /// The joint of an effect that lies between its encoder and its link: where a second encoder
    /// shows the link, it shows the effect.
    pub fn before_the_link(self) -> Option<usize> {
        use EffectKind::{Backlash, EncoderOffset, JointElasticity, TransmissionRatio};
        let between = [Backlash, EncoderOffset, JointElasticity, TransmissionRatio];
        self.joint().filter(|_| between.contains(&self.kind))
    }

    /// See [`Explain::prior`].
    pub fn prior(self, robot: &Robot, scale: &Scale) -> Vec<f64> {
        self.model().map(|m| m.prior(self.place, robot, scale)).unwrap_or_default()
    }

    /// See [`Explain::bounds`].
    pub fn bounds(self, robot: &Robot) -> Vec<(f64, f64)> {
        self.model().map(|m| m.bounds(self.place, robot)).unwrap_or_default()
    }

    /// See [`Explain::admissible`].
    pub fn admissible(self, robot: &Robot, weights: &[f64]) -> bool {
        self.model().is_some_and(|m| m.admissible(self.place, robot, weights))
    }

    /// See [`Explain::is_sound`].
    pub fn is_sound(self, extended: &Robot) -> bool {
        self.model().is_some_and(|m| m.is_sound(self.place, extended))
    }

    /// See [`Explain::largest_unseen`].
    pub fn largest_unseen(self, robot: &Robot, frame: &Frame) -> f64 {
        self.model().map_or(1.0, |m| m.largest_unseen(self.place, robot, frame))
    }

    /// See [`Explain::extend`].
    pub fn extend(self, robot: &mut Robot, weights: &[f64], frame: &Frame) {
        if let Some(model) = self.model() {
            model.extend(self.place, robot, weights, frame);
        }
    }

    /// See [`Explain::quantities`].
    pub fn quantities(self, nominal: &Robot, extended: &Robot) -> Vec<Quantity> {
        self.model().map(|m| m.quantities(self.place, nominal, extended)).unwrap_or_default()
    }

    /// Whether `self` and `other` are two names for changes of the same numbers,
    /// so that both cannot be part of one model. Asymmetric friction is Coulomb friction with an
    /// offset.
    pub fn excludes(self, other: Self) -> bool {
        use EffectKind::{
            AsymmetricFriction, CoulombFriction, InertialParameters, Payload, TorqueOffset,
        };
        let pairs = [
            (InertialParameters, Payload),
            (AsymmetricFriction, CoulombFriction),
            (AsymmetricFriction, TorqueOffset),
        ];
        let is = |(a, b)| (self.kind, other.kind) == (a, b) || (other.kind, self.kind) == (a, b);
        self.place == other.place && pairs.into_iter().any(is)
    }

    /// Whether `self` and `other` have the same columns about a robot without either.
    pub fn is_twin(self, other: Self) -> bool {
        use EffectKind::{ActuatorDelay, ActuatorLag};
        let kinds = (self.kind, other.kind);
        let are_late = [(ActuatorDelay, ActuatorLag), (ActuatorLag, ActuatorDelay)];
        self.place == other.place && are_late.contains(&kinds)
    }

    /// The Coulomb friction whose level this effect makes vary.
    pub fn varies(self) -> Option<Self> {
        use EffectKind::{
            CoulombFriction, PositionDependentFriction, PreslidingFriction, StribeckFriction,
        };
        let varying = [StribeckFriction, PreslidingFriction, PositionDependentFriction];
        varying.contains(&self.kind).then_some(Self { kind: CoulombFriction, place: self.place })
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
