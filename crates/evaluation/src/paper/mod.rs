//! The figures of Nguyen-Tuong & Peters 2010, measured on the project's own arm, and whether what
//! the paper claims of them holds there.

mod claim;
mod figure_spec;
mod learning_claims;
mod learning_errors;
mod learning_figure;
mod prediction_time_figure;
mod time_claims;
mod tracking_claims;

pub use claim::{Claim, ClaimCase, Scope, Verdict};
pub use figure_spec::{
    DataSpec, FigureScenario, FigureSpec, LearningFigureSpec, PredictionTimeFigureSpec,
};
pub use learning_claims::learning_claims;
pub use learning_errors::{LearningErrors, ModelErrors};
pub use learning_figure::{LearningFigure, PaperData, PaperPlant};
pub use prediction_time_figure::PredictionTimeFigure;
pub use time_claims::{ModelTime, time_claims};
pub use tracking_claims::tracking_claims;

use learner::ModelKind;

/// The models of figure 2, and the robot with its named effects beside them.
pub const PAPER_MODELS: [ModelKind; 6] = [
    ModelKind::Rbd,
    ModelKind::Gp,
    ModelKind::GpRbd,
    ModelKind::GpRbdPrior,
    ModelKind::RbdKernel,
    ModelKind::Named,
];

/// The models of the paper that know rigid bodies and learn what those leave.
const SEMIPARAMETRIC: [ModelKind; 3] =
    [ModelKind::GpRbd, ModelKind::GpRbdPrior, ModelKind::RbdKernel];

/// Every model of the paper that is or has a Gaussian process.
const PROCESSES: [ModelKind; 4] =
    [ModelKind::Gp, ModelKind::GpRbd, ModelKind::GpRbdPrior, ModelKind::RbdKernel];
