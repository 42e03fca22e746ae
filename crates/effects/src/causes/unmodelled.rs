//! Effects without columns of constant weights: what a model of them would need, and how they are compensated.

/// An effect without a model.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Unmodelled {
    /// Reason that a model of columns `f(q, qd, qdd)` and constant weights cannot hold it.
    pub reason: &'static str,
    /// As [`Effect::remedy`](crate::effect::Effect::remedy).
    pub remedy: Result<&'static str, &'static str>,
}

pub(crate) const TORQUE_RIPPLE: Unmodelled = Unmodelled {
    reason: "its period is finer than any trial value: it is a line of a spectrum",
    remedy: Ok("its torque at the position of the motor"),
};

pub(crate) const TORQUE_SATURATION: Unmodelled = Unmodelled {
    reason: "it is in what the log says of the effort, not in what the motion needs",
    remedy: Err("a motor cannot be asked for more than it has"),
};

pub(crate) const EXTERNAL_DISTURBANCE: Unmodelled = Unmodelled {
    reason: "it keeps to the clock, not to the motion: it is a line of a spectrum",
    remedy: Err("it does not follow the motion: it is left to feedback"),
};
