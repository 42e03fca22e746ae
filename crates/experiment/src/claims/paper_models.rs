use learner::ModelKind;

/// The models of figure 2 of Nguyen-Tuong & Peters 2010, and beside them the robot with its named effects.
pub const PAPER_MODELS: [ModelKind; 6] = [
    ModelKind::Rbd,
    ModelKind::Gp,
    ModelKind::GpRbd,
    ModelKind::GpRbdPrior,
    ModelKind::RbdKernel,
    ModelKind::Named,
];

/// The semiparametric models of the paper: rigid bodies, and a Gaussian process for the torque that they leave.
pub const SEMIPARAMETRIC: [ModelKind; 3] =
    [ModelKind::GpRbd, ModelKind::GpRbdPrior, ModelKind::RbdKernel];

/// The models of the paper that are Gaussian processes or include one.
pub const PROCESSES: [ModelKind; 4] =
    [ModelKind::Gp, ModelKind::GpRbd, ModelKind::GpRbdPrior, ModelKind::RbdKernel];
