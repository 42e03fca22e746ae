use catalogue::{EffectKind, Parameter};
use robot::{Actuator, Robot};

use crate::abilities::HasShape;
use crate::column::EffectColumn;
use crate::effect::Effect;
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::{AtJoint, Place, TypedPlace};
use crate::priors::Priors;
use crate::quantity::EffectQuantity;
use crate::traits::Traits;

/// An [`Effect`] of any kind of place, as [`model`](crate::model) gives it.
///
/// Only this file turns a [`Place`] into the place of an effect. At a place of another kind an effect has no columns
/// and changes no robot.
pub trait AnyEffect: Sync {
    /// See [`Effect::kind`].
    fn kind(&self) -> EffectKind;

    /// See [`Effect::traits`].
    fn traits(&self) -> Traits;

    /// See [`Effect::remedy`].
    ///
    /// # Errors
    ///
    /// The reason why the effect cannot be compensated.
    fn remedy(&self) -> Result<&'static str, &'static str>;

    /// See [`Effect::omission`].
    fn omission(&self, drive: &Actuator) -> Option<&'static str>;

    /// See [`Effect::parameters`].
    fn parameters(&self) -> &'static [Parameter];

    /// See [`Effect::shape`].
    fn shape(&self) -> Option<&dyn HasShape>;

    /// See [`Effect::places`].
    fn places(&self, robot: &Robot) -> Vec<Place>;

    /// See [`Effect::columns`].
    fn columns(&self, place: Place, motion: &RunMotion) -> Vec<EffectColumn>;

    /// See [`BetweenEncoders`](crate::BetweenEncoders); no columns for an effect that lies elsewhere.
    fn twist(&self, place: Place, motion: &RunMotion) -> Vec<EffectColumn>;

    /// See [`Effect::prior`].
    fn prior(&self, place: Place, robot: &Robot, scale: &Scale, priors: &Priors) -> Vec<f64>;

    /// See [`Effect::has_any_scale`].
    fn has_any_scale(&self) -> bool;

    /// See [`HasCadError`](crate::HasCadError).
    fn cad_error_sd(&self, place: Place, robot: &Robot, priors: &Priors) -> Option<Vec<f64>>;

    /// See [`IsRare`](crate::IsRare); 0 for an effect that is common.
    fn prior_log_odds_against(&self, place: Place, robot: &Robot, priors: &Priors) -> f64;

    /// See [`Effect::bounds`].
    fn bounds(&self, place: Place, robot: &Robot, priors: &Priors) -> Vec<(f64, f64)>;

    /// See [`IsRestricted`](crate::IsRestricted).
    fn admissible(&self, place: Place, robot: &Robot, weights: &[f64], priors: &Priors) -> bool;

    /// See [`CanBeUnsound`](crate::CanBeUnsound).
    fn is_sound(&self, place: Place, extended: &Robot, priors: &Priors) -> bool;

    /// See [`HasPlainer`](crate::HasPlainer); empty for an effect without a simpler special case.
    fn more_than_plain(
        &self,
        place: Place,
        robots: [&Robot; 2],
        frame: &Frame,
        priors: &Priors,
    ) -> Vec<(usize, f64)>;

    /// See [`CanHide`](crate::CanHide); 1 for an effect that cannot hide.
    fn largest_unseen(&self, place: Place, robot: &Robot, frame: &Frame, priors: &Priors) -> f64;

    /// See [`Effect::extend`].
    fn extend(
        &self,
        place: Place,
        robot: &mut Robot,
        weights: &[f64],
        frame: &Frame,
        priors: &Priors,
    );

    /// See [`Effect::quantities`].
    fn quantities(&self, place: Place, nominal: &Robot, extended: &Robot) -> Vec<EffectQuantity>;
}

impl<E: Effect> AnyEffect for E {
    fn kind(&self) -> EffectKind {
        Effect::kind(self)
    }

    fn traits(&self) -> Traits {
        Effect::traits(self)
    }

    fn remedy(&self) -> Result<&'static str, &'static str> {
        Effect::remedy(self)
    }

    fn omission(&self, drive: &Actuator) -> Option<&'static str> {
        Effect::omission(self, drive)
    }

    fn parameters(&self) -> &'static [Parameter] {
        Effect::parameters(self)
    }

    fn shape(&self) -> Option<&dyn HasShape> {
        Effect::shape(self)
    }

    fn has_any_scale(&self) -> bool {
        Effect::has_any_scale(self)
    }

    fn places(&self, robot: &Robot) -> Vec<Place> {
        Effect::places(self, robot).into_iter().map(TypedPlace::place).collect()
    }

    fn columns(&self, place: Place, motion: &RunMotion) -> Vec<EffectColumn> {
        E::At::of(place).map(|at| Effect::columns(self, at, motion)).unwrap_or_default()
    }

    fn twist(&self, place: Place, motion: &RunMotion) -> Vec<EffectColumn> {
        let between = self.between_encoders().zip(AtJoint::of(place));
        between.map(|(effect, at)| effect.twist(at, motion)).unwrap_or_default()
    }

    fn prior(&self, place: Place, robot: &Robot, scale: &Scale, priors: &Priors) -> Vec<f64> {
        E::At::of(place).map(|at| Effect::prior(self, at, robot, scale, priors)).unwrap_or_default()
    }

    fn cad_error_sd(&self, place: Place, robot: &Robot, priors: &Priors) -> Option<Vec<f64>> {
        Some(self.cad_error()?.cad_error_sd(E::At::of(place)?, robot, priors))
    }

    fn prior_log_odds_against(&self, place: Place, robot: &Robot, priors: &Priors) -> f64 {
        self.rare()
            .zip(E::At::of(place))
            .map_or(0.0, |(rare, at)| rare.prior_log_odds_against(at, robot, priors))
    }

    fn bounds(&self, place: Place, robot: &Robot, priors: &Priors) -> Vec<(f64, f64)> {
        E::At::of(place).map(|at| Effect::bounds(self, at, robot, priors)).unwrap_or_default()
    }

    fn admissible(&self, place: Place, robot: &Robot, weights: &[f64], priors: &Priors) -> bool {
        self.restriction().is_none_or(|restricted| {
            E::At::of(place).is_some_and(|at| restricted.admissible(at, robot, weights, priors))
        })
    }

    fn is_sound(&self, place: Place, extended: &Robot, priors: &Priors) -> bool {
        self.can_be_unsound().is_none_or(|effect| {
            E::At::of(place).is_some_and(|at| effect.is_sound(at, extended, priors))
        })
    }

    fn more_than_plain(
        &self,
        place: Place,
        robots: [&Robot; 2],
        frame: &Frame,
        priors: &Priors,
    ) -> Vec<(usize, f64)> {
        let plainer = self.plainer().zip(E::At::of(place));
        plainer
            .map(|(effect, at)| effect.more_than_plain(at, robots, frame, priors))
            .unwrap_or_default()
    }

    fn largest_unseen(&self, place: Place, robot: &Robot, frame: &Frame, priors: &Priors) -> f64 {
        let hidden = self.can_hide().zip(E::At::of(place));
        hidden.map_or(1.0, |(effect, at)| effect.largest_unseen(at, robot, frame, priors))
    }

    fn extend(
        &self,
        place: Place,
        robot: &mut Robot,
        weights: &[f64],
        frame: &Frame,
        priors: &Priors,
    ) {
        if let Some(at) = E::At::of(place) {
            Effect::extend(self, at, robot, weights, frame, priors);
        }
    }

    fn quantities(&self, place: Place, nominal: &Robot, extended: &Robot) -> Vec<EffectQuantity> {
        let at = E::At::of(place);
        at.map(|at| Effect::quantities(self, at, nominal, extended)).unwrap_or_default()
    }
}
