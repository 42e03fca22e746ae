use catalogue::EffectKind;
use robot::Robot;

use crate::any_effect::AnyEffect;
use crate::column::Column;
use crate::model::{MODELLED, model};
use crate::motion::frame::Frame;
use crate::motion::run_motion::Motion;
use crate::motion::scale::Scale;
use crate::place::Place;
use crate::priors::Priors;
use crate::quantity::Quantity;
use crate::traits::{Linearity, Nature, Relation, Seat};

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

    /// See [`Effect::columns`].
    pub fn columns(self, motion: &Motion) -> Vec<Column> {
        let mut columns = self.model().map(|m| m.columns(self.place, motion)).unwrap_or_default();
        for part in columns.iter_mut().flatten() {
            part.values = motion.with_timing(part.joint, std::mem::take(&mut part.values));
        }
        columns
    }

    /// See [`Effect::twist`].
    pub fn twist(self, motion: &Motion) -> Vec<Column> {
        self.model().map(|m| m.twist(self.place, motion)).unwrap_or_default()
    }

    /// See [`Effect::nature`]; none of an effect without a model.
    pub fn nature(self) -> Option<Nature> {
        self.model().map(|m| m.nature())
    }

    /// Whether its columns are those of a small change only ([`Linearity::Tangent`]).
    pub fn is_tangent(self) -> bool {
        self.nature().is_some_and(|n| n.linearity != Linearity::Exact)
    }

    /// Whether something else may pass for it ([`Nature::imitable`]).
    pub fn is_doubtful(self) -> bool {
        self.nature().is_some_and(|n| n.imitable)
    }

    /// The joint of an effect that lies between its encoder and its link: where a second encoder
    /// shows the link, it shows the effect.
    pub fn before_the_link(self) -> Option<usize> {
        self.joint().filter(|_| self.nature().is_some_and(|n| n.seat == Seat::BeforeTheLink))
    }

    /// See [`Effect::prior`].
    pub fn prior(self, robot: &Robot, scale: &Scale, priors: &Priors) -> Vec<f64> {
        self.model().map(|m| m.prior(self.place, robot, scale, priors)).unwrap_or_default()
    }

    /// See [`Effect::everyday`].
    pub fn everyday(self, robot: &Robot, priors: &Priors) -> Option<Vec<f64>> {
        self.model()?.everyday(self.place, robot, priors)
    }

    /// See [`Effect::rarity`].
    pub fn rarity(self, robot: &Robot, priors: &Priors) -> f64 {
        self.model().map_or(0.0, |m| m.rarity(self.place, robot, priors))
    }

    /// See [`Effect::bounds`].
    pub fn bounds(self, robot: &Robot, priors: &Priors) -> Vec<(f64, f64)> {
        self.model().map(|m| m.bounds(self.place, robot, priors)).unwrap_or_default()
    }

    /// See [`Effect::admissible`].
    pub fn admissible(self, robot: &Robot, weights: &[f64], priors: &Priors) -> bool {
        self.model().is_some_and(|m| m.admissible(self.place, robot, weights, priors))
    }

    /// See [`Effect::is_sound`].
    pub fn is_sound(self, extended: &Robot, priors: &Priors) -> bool {
        self.model().is_some_and(|m| m.is_sound(self.place, extended, priors))
    }

    /// See [`Effect::more_than_plain`]; `robots` are the nominal and the extended one.
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

    /// See [`Effect::largest_unseen`].
    pub fn largest_unseen(self, robot: &Robot, frame: &Frame, priors: &Priors) -> f64 {
        self.model().map_or(1.0, |m| m.largest_unseen(self.place, robot, frame, priors))
    }

    /// See [`Effect::extend`].
    pub fn extend(self, robot: &mut Robot, weights: &[f64], frame: &Frame, priors: &Priors) {
        if let Some(model) = self.model() {
            model.extend(self.place, robot, weights, frame, priors);
        }
    }

    /// See [`Effect::quantities`].
    pub fn quantities(self, nominal: &Robot, extended: &Robot) -> Vec<Quantity> {
        self.model().map(|m| m.quantities(self.place, nominal, extended)).unwrap_or_default()
    }

    /// Whether `self` and `other` are two names for changes of the same numbers,
    /// so that both cannot be part of one model. Asymmetric friction is Coulomb friction with an
    /// offset.
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

    /// Whether `self` and `other` have the same columns about a robot without either.
    pub fn is_twin(self, other: Self) -> bool {
        self.place == other.place && self.relations().contains(&Relation::TwinOf(other.kind))
    }

    /// The Coulomb friction whose level this effect makes vary.
    pub fn varies(self) -> Option<Self> {
        let (kind, _) = self.nature()?.form_of()?;
        Some(Self { kind, place: self.place })
    }

    /// Effects of the same place that together are this one: Coulomb friction, the level of asymmetric
    /// friction, and its offset.
    pub fn together(self) -> Vec<Self> {
        let kinds = self.nature().map_or(&[] as &[EffectKind], Nature::together);
        kinds.iter().map(|&kind| Self { kind, place: self.place }).collect()
    }

    /// Effects that have the name where they do the work of this one, which reaches `joints`.
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
        self.nature().map_or(&[], |n| n.relations)
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
