use catalogue::{EffectKind, Parameter};
use robot::{Actuator, Robot};

use crate::abilities::{
    BetweenEncoders, CanBeUnsound, CanHide, HasCadError, HasPlainer, HasShape, IsRare, IsRestricted,
};
use crate::column::EffectColumn;
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::TypedPlace;
use crate::priors::Priors;
use crate::quantity::EffectQuantity;
use crate::traits::Traits;

/// How dry friction is compensated, for any of its laws.
pub(crate) const EASED_LEVEL: &str =
    "its level in the direction of the motor, eased through rest: tanh(qd / rest speed)";

/// How changes of the bodies are compensated.
pub(crate) const INVERSE_DYNAMICS: &str = "inverse dynamics of the robot that has it";

/// The model side of one effect.
///
/// Weights are changes from the nominal robot: all zero means the robot as described. Each effect implements the
/// methods without a body in its own file. The last eight methods are abilities that few effects have; an effect with
/// such an ability returns itself there.
pub trait Effect: Sync {
    /// Where it acts: at a joint, in a link or at the base.
    type At: TypedPlace;

    /// The effect.
    fn kind(&self) -> EffectKind;

    /// What is known of the effect before any log.
    fn traits(&self) -> Traits;

    /// How [`Compensation`](crate::Compensation) compensates the effect.
    ///
    /// # Errors
    ///
    /// The reason why the effect cannot be compensated.
    fn remedy(&self) -> Result<&'static str, &'static str>;

    /// Key of `robot.toml` that describes the effect in `drive`, where a torque of one state alone leaves it out.
    /// Such an effect needs the past, the motion of the other side of a transmission, or other times.
    fn omission(&self, drive: &Actuator) -> Option<&'static str>;

    /// The parameters of the effect that a diagnosis finds.
    fn parameters(&self) -> &'static [Parameter] {
        self.kind().entry().parameters
    }

    /// Places where the effect could act in this robot.
    fn places(&self, robot: &Robot) -> Vec<Self::At>;

    /// One column a weight, for the motion of one run.
    fn columns(&self, at: Self::At, motion: &RunMotion) -> Vec<EffectColumn>;

    /// Prior standard deviation of each weight.
    fn prior(&self, at: Self::At, robot: &Robot, scale: &Scale, priors: &Priors) -> Vec<f64>;

    /// Whether the size of the effect is unknown by decades: its weights are then as likely to be of a tenth of their prior
    /// as of the whole.
    fn has_any_scale(&self) -> bool {
        false
    }

    /// Lowest and highest physically possible value of each weight.
    fn bounds(&self, at: Self::At, robot: &Robot, priors: &Priors) -> Vec<(f64, f64)>;

    /// Changes the robot by `weights`, whose columns were made in `frame`.
    fn extend(
        &self,
        at: Self::At,
        robot: &mut Robot,
        weights: &[f64],
        frame: &Frame,
        priors: &Priors,
    );

    /// The parameters as the user reads them, from the robot before and after.
    fn quantities(&self, at: Self::At, nominal: &Robot, extended: &Robot) -> Vec<EffectQuantity>;

    /// See [`HasShape`].
    fn shape(&self) -> Option<&dyn HasShape> {
        None
    }

    /// See [`BetweenEncoders`].
    fn between_encoders(&self) -> Option<&dyn BetweenEncoders> {
        None
    }

    /// See [`HasCadError`].
    fn cad_error(&self) -> Option<&dyn HasCadError<Self::At>> {
        None
    }

    /// See [`IsRare`].
    fn rare(&self) -> Option<&dyn IsRare<Self::At>> {
        None
    }

    /// See [`IsRestricted`].
    fn restriction(&self) -> Option<&dyn IsRestricted<Self::At>> {
        None
    }

    /// See [`CanBeUnsound`].
    fn can_be_unsound(&self) -> Option<&dyn CanBeUnsound<Self::At>> {
        None
    }

    /// See [`HasPlainer`].
    fn plainer(&self) -> Option<&dyn HasPlainer<Self::At>> {
        None
    }

    /// See [`CanHide`].
    fn can_hide(&self) -> Option<&dyn CanHide<Self::At>> {
        None
    }
}
