use robot::Actuator;

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
    /// The level (N·m or N).
    pub level: f64,
}

impl FrictionError {
    /// No described friction.
    pub const NONE: Self = Self { all: 0.0, sliding: 0.0, level: 0.0 };

    /// For dry friction of a level (N·m or N): `near_rest` of the `informative` samples are near rest, and while the joint
    /// slides the law errs by `rough` of the level.
    pub fn new(level: f64, [near_rest, informative]: [usize; 2], rough: f64) -> Self {
        let variance = near_rest as f64 / (3 * informative.max(1)) as f64;
        Self { all: level * variance.sqrt(), sliding: rough * level, level }
    }

    /// The same where friction turns out to have another level (N·m or N), if that is smaller: what is not there does not
    /// err.
    pub fn of_at_most(self, level: f64) -> Self {
        if level >= self.level {
            return self;
        }
        let share = level / self.level;
        Self { all: share * self.all, sliding: share * self.sliding, level }
    }
}

/// Level of the dry friction of a drive in its effort, the mean of both directions (N·m or N).
pub(crate) fn friction_level(drive: &Actuator) -> f64 {
    let level = 0.5 * (drive.coulomb_forward + drive.coulomb_backward);
    (drive.transmission_ratio * drive.torque_gain * level).abs()
}
