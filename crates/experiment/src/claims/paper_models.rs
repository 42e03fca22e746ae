use learner::ModelKind;

/// The models of figure 2 of Nguyen-Tuong & Peters 2010, and the robot with its named effects beside them.
pub const PAPER_MODELS: [ModelKind; 6] = [
    ModelKind::Rbd,
    ModelKind::Gp,
    ModelKind::GpRbd,
    ModelKind::GpRbdPrior,
    ModelKind::RbdKernel,
    ModelKind::Named,
];

/// The semiparametric models of the paper: rigid bodies, and a process that learns what they leave.
pub const SEMIPARAMETRIC: [ModelKind; 3] =
    [ModelKind::GpRbd, ModelKind::GpRbdPrior, ModelKind::RbdKernel];

/// Every model of the paper that is or has a Gaussian process.
pub const PROCESSES: [ModelKind; 4] =
    [ModelKind::Gp, ModelKind::GpRbd, ModelKind::GpRbdPrior, ModelKind::RbdKernel];
