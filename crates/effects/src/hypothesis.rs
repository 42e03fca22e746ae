use catalogue::{EffectKind, Family};
use robot::Robot;

use crate::any_effect::AnyEffect;
use crate::column::EffectColumn;
use crate::model::{MODELLED, model};
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::Place;
use crate::priors::Priors;
use crate::quantity::EffectQuantity;
use crate::traits::{Linearity, Location, Relation, Traits};

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
    fn model(self) -> Option<&'static dyn AnyEffect> {
        model(self.kind).ok()
    }

    /// See [`AnyEffect::columns`].
    pub fn columns(self, motion: &RunMotion) -> Vec<EffectColumn> {
        let mut columns = self.model().map(|m| m.columns(self.place, motion)).unwrap_or_default();
        for part in columns.iter_mut().flatten() {
            part.values = motion.with_timing(part.joint, std::mem::take(&mut part.values));
        }
        columns
    }

    /// See [`AnyEffect::twist`].
    pub fn twist(self, motion: &RunMotion) -> Vec<EffectColumn> {
        self.model().map(|m| m.twist(self.place, motion)).unwrap_or_default()
    }

    /// See [`AnyEffect::traits`]; `None` for an effect without a model.
    pub fn traits(self) -> Option<Traits> {
        self.model().map(|m| m.traits())
    }

    /// Whether its columns hold for a small change only ([`Linearity::Tangent`]).
    pub fn is_tangent(self) -> bool {
        self.traits().is_some_and(|n| n.linearity != Linearity::Exact)
    }

    /// Whether another error may imitate it ([`Traits::imitable`]).
    pub fn is_imitable(self) -> bool {
        self.traits().is_some_and(|n| n.imitable)
    }

    /// Whether it is what every arm has at every joint: dry and viscous friction, the inertia of a rotor, a torque
    /// offset.
    pub fn is_everyday(self) -> bool {
        matches!(
            self.kind,
            EffectKind::CoulombFriction
                | EffectKind::ViscousFriction
                | EffectKind::RotorInertia
                | EffectKind::TorqueOffset
        )
    }

    /// Whether what dry friction does while a joint changes its direction may pass for it: friction of any law, and what
    /// is late.
    pub fn is_like_turning_friction(self) -> bool {
        let is_late = matches!(
            self.kind,
            EffectKind::ActuatorDelay | EffectKind::ActuatorLag | EffectKind::TimeSkew
        );
        is_late || self.kind.entry().family == Family::Friction
    }

    /// The joint of an effect that lies between its encoder and its link, where a second encoder at the link shows
    /// it.
    pub fn before_the_link(self) -> Option<usize> {
        self.joint()
            .filter(|_| self.traits().is_some_and(|n| n.location == Location::BeforeTheLink))
    }

    /// See [`AnyEffect::prior`].
    pub fn prior(self, robot: &Robot, scale: &Scale, priors: &Priors) -> Vec<f64> {
        self.model().map(|m| m.prior(self.place, robot, scale, priors)).unwrap_or_default()
    }

    /// See [`AnyEffect::has_any_scale`].
    pub fn has_any_scale(self) -> bool {
        self.model().is_some_and(|m| m.has_any_scale())
    }

    /// See [`AnyEffect::cad_error_sd`].
    pub fn cad_error_sd(self, robot: &Robot, priors: &Priors) -> Option<Vec<f64>> {
        self.model()?.cad_error_sd(self.place, robot, priors)
    }

    /// See [`AnyEffect::prior_log_odds_against`].
    pub fn prior_log_odds_against(self, robot: &Robot, priors: &Priors) -> f64 {
        self.model().map_or(0.0, |m| m.prior_log_odds_against(self.place, robot, priors))
    }

    /// See [`AnyEffect::bounds`].
    pub fn bounds(self, robot: &Robot, priors: &Priors) -> Vec<(f64, f64)> {
        self.model().map(|m| m.bounds(self.place, robot, priors)).unwrap_or_default()
    }

    /// See [`AnyEffect::admissible`].
    pub fn admissible(self, robot: &Robot, weights: &[f64], priors: &Priors) -> bool {
        self.model().is_some_and(|m| m.admissible(self.place, robot, weights, priors))
    }

    /// See [`AnyEffect::is_sound`].
    pub fn is_sound(self, extended: &Robot, priors: &Priors) -> bool {
        self.model().is_some_and(|m| m.is_sound(self.place, extended, priors))
    }

    /// See [`AnyEffect::more_than_plain`]; `robots` are the nominal and the extended one.
    pub fn more_than_plain(
        self,
        robots: [&Robot; 2],
        frame: &Frame,
        priors: &Priors,
    ) -> Vec<(usize, f64)> {
        self.model()
            .map(|m| m.more_than_plain(self.place, robots, frame, priors))
            .unwrap_or_default()
    }

    /// See [`AnyEffect::largest_unseen`].
    pub fn largest_unseen(self, robot: &Robot, frame: &Frame, priors: &Priors) -> f64 {
        self.model().map_or(1.0, |m| m.largest_unseen(self.place, robot, frame, priors))
    }

    /// See [`AnyEffect::extend`].
    pub fn extend(self, robot: &mut Robot, weights: &[f64], frame: &Frame, priors: &Priors) {
        if let Some(model) = self.model() {
            model.extend(self.place, robot, weights, frame, priors);
        }
    }

    /// See [`AnyEffect::quantities`].
    pub fn quantities(self, nominal: &Robot, extended: &Robot) -> Vec<EffectQuantity> {
        self.model().map(|m| m.quantities(self.place, nominal, extended)).unwrap_or_default()
    }

    /// Whether `self` and `other` change the same numbers, so that one model cannot have both: asymmetric friction,
    /// for example, includes Coulomb friction and an offset.
    pub fn excludes(self, other: Self) -> bool {
        let holds = |a: Self, b: Self| {
            let is_b = |r: &Relation| match r {
                Relation::OtherNameOf(kind) => *kind == b.kind,
                Relation::Together(kinds) => kinds.contains(&b.kind),
                _ => false,
            };
            a.relations().iter().any(is_b)
        };
        self.place == other.place && (holds(self, other) || holds(other, self))
    }

    /// Whether `self` and `other` have the same columns for a robot without either.
    pub fn is_twin(self, other: Self) -> bool {
        self.place == other.place && self.relations().contains(&Relation::TwinOf(other.kind))
    }

    /// The Coulomb friction whose level varies by this effect.
    pub fn varies(self) -> Option<Self> {
        let (kind, _) = self.traits()?.form_of()?;
        Some(Self { kind, place: self.place })
    }

    /// Effects of the same place whose sum is this one: Coulomb friction and an offset for asymmetric friction.
    pub fn together(self) -> Vec<Self> {
        let kinds = self.traits().map_or(&[] as &[EffectKind], Traits::together);
        kinds.iter().map(|&kind| Self { kind, place: self.place }).collect()
    }

    /// Simpler effects that are named instead of this one, which reaches `joints`, where they explain as much.
    pub fn plainer(self, joints: &[usize]) -> Vec<Self> {
        let at = |&kind: &EffectKind, place| Self { kind, place };
        let of = |relation: &Relation| match relation {
            Relation::PlainerHere(kind) => vec![at(kind, self.place)],
            Relation::PlainerAtTheJoint(kind) => {
                self.link().map(|j| at(kind, Place::Joint(j))).into_iter().collect()
            }
            Relation::PlainerAtEveryJoint(kinds) => {
                let all = |&j: &usize| kinds.iter().map(move |kind| at(kind, Place::Joint(j)));
                joints.iter().flat_map(all).collect()
            }
            _ => Vec::new(),
        };
        self.relations().iter().flat_map(of).collect()
    }

    fn relations(self) -> &'static [Relation] {
        self.traits().map_or(&[], |n| n.relations)
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
