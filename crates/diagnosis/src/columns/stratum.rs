/// The samples of one joint whose residuals share a variance: those in which the joint slides, or those near its rest,
/// where dry friction has any value up to its level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Stratum(usize);

impl Stratum {
    /// The samples in which joint `j` slides.
    pub fn sliding(j: usize) -> Self {
        Self(2 * j)
    }

    /// The samples of joint `j` near its rest.
    pub fn near_rest(j: usize) -> Self {
        Self(2 * j + 1)
    }

    /// Both strata of all joints, in the order of their indices.
    pub fn all(joints: usize) -> impl Iterator<Item = Self> {
        (0..2 * joints).map(Self)
    }

    /// Index among the strata of all joints.
    pub fn index(self) -> usize {
        self.0
    }

    pub fn joint(self) -> usize {
        self.0 / 2
    }
}
