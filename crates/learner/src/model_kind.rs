use std::fmt;
use std::str::FromStr;

/// The models of the torque that can be learned.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ModelKind {
    /// The robot as it is described, nothing learned.
    Cad,
    /// Rigid bodies with regressed parameters (equation 2 of Nguyen-Tuong & Peters 2010).
    Rbd,
    /// The same with every link a physical body: the nearest such parameters.
    RbdConsistent,
    /// A Gaussian process with mean zero (appendix).
    Gp,
    /// A Gaussian process about the regressed rigid bodies (equations 3 and 5).
    GpRbd,
    /// The same with a prior on the parameters, inferred joint by joint (equations 6 and 7).
    GpRbdPrior,
    /// The same with one set of parameters for all joints (below equation 7).
    GpRbdShared,
    /// Rigid bodies as kernel beside the Gaussian one, optimised apart (equations 8 to 10).
    RbdKernel,
    /// The same, all hyperparameters optimised jointly.
    RbdKernelJoint,
    /// The robot extended by named effects, nothing else learned.
    Named,
    /// A Gaussian process about the robot extended by named effects.
    NamedGp,
    /// [`Gp`](Self::Gp) on all samples by inducing points.
    GpInducing,
    /// [`GpRbd`](Self::GpRbd) on all samples by inducing points.
    GpRbdInducing,
    /// [`NamedGp`](Self::NamedGp) on all samples by inducing points.
    NamedGpInducing,
}

impl ModelKind {
    /// Every kind, the paper's in its order.
    pub const ALL: [Self; 14] = [
        Self::Cad,
        Self::Rbd,
        Self::RbdConsistent,
        Self::Gp,
        Self::GpRbd,
        Self::GpRbdPrior,
        Self::GpRbdShared,
        Self::RbdKernel,
        Self::RbdKernelJoint,
        Self::Named,
        Self::NamedGp,
        Self::GpInducing,
        Self::GpRbdInducing,
        Self::NamedGpInducing,
    ];

    /// Name in files and options.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cad => "cad",
            Self::Rbd => "rbd",
            Self::RbdConsistent => "rbd-consistent",
            Self::Gp => "gp",
            Self::GpRbd => "gp-rbd",
            Self::GpRbdPrior => "gp-rbd-prior",
            Self::GpRbdShared => "gp-rbd-shared",
            Self::RbdKernel => "rbd-kernel",
            Self::RbdKernelJoint => "rbd-kernel-joint",
            Self::Named => "named",
            Self::NamedGp => "named-gp",
            Self::GpInducing => "gp-inducing",
            Self::GpRbdInducing => "gp-rbd-inducing",
            Self::NamedGpInducing => "named-gp-inducing",
        }
    }

    /// What it is, in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Cad => "the robot as described",
            Self::Rbd => "rigid bodies, parameters by regression",
            Self::RbdConsistent => "rigid bodies, physical parameters nearest to the regression",
            Self::Gp => "Gaussian process, mean zero",
            Self::GpRbd => "Gaussian process, mean by rigid bodies",
            Self::GpRbdPrior => "Gaussian process, rigid bodies with a prior, joint by joint",
            Self::GpRbdShared => {
                "Gaussian process, rigid bodies with a prior, shared by all joints"
            }
            Self::RbdKernel => "Gaussian process, rigid-body kernel, parts optimised apart",
            Self::RbdKernelJoint => "Gaussian process, rigid-body kernel, parts optimised jointly",
            Self::Named => "the robot with its named effects",
            Self::NamedGp => "Gaussian process, mean by the robot with its named effects",
            Self::GpInducing => "Gaussian process, mean zero, inducing points",
            Self::GpRbdInducing => "Gaussian process, mean by rigid bodies, inducing points",
            Self::NamedGpInducing => "Gaussian process, mean by named effects, inducing points",
        }
    }

    /// Whether it needs the robot with its named effects.
    pub fn needs_named_effects(self) -> bool {
        matches!(self, Self::Named | Self::NamedGp | Self::NamedGpInducing)
    }

    /// Whether it needs the regression of the rigid-body parameters.
    pub fn needs_regression(self) -> bool {
        matches!(
            self,
            Self::Rbd
                | Self::RbdConsistent
                | Self::GpRbd
                | Self::GpRbdPrior
                | Self::GpRbdShared
                | Self::GpRbdInducing
        )
    }
}

impl fmt::Display for ModelKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for ModelKind {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|kind| kind.name() == text).ok_or_else(|| {
            let names: Vec<_> = Self::ALL.iter().map(|kind| kind.name()).collect();
            format!("{text} is no model, {} are", names.join(", "))
        })
    }
}
