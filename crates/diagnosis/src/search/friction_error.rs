/// What the law of described dry friction may err by at a joint (RMS, N·m or N).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FrictionError {
    /// Over all samples. Near rest friction has any value up to its level:
    ///
    /// ```text
    /// level sqrt(share / 3)   with `share` of the informative samples near rest
    /// ```
    pub all: f64,
    /// While the joint slides: a share of its level.
    pub sliding: f64,
}

impl FrictionError {
    /// For dry friction of a level (N·m or N): `near_rest` of the `informative` samples are near rest, and while the joint
    /// slides the law errs by `rough` of the level.
    pub fn new(level: f64, [near_rest, informative]: [usize; 2], rough: f64) -> Self {
        let variance = near_rest as f64 / (3 * informative.max(1)) as f64;
        Self { all: level * variance.sqrt(), sliding: rough * level }
    }
}
