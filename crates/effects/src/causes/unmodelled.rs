//! Effects that columns of constant weights cannot hold: what a model of them would need, and what undoes them.

/// An effect without a model.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Unmodelled {
    /// What a model of columns `f(q, qd, qdd)` and constant weights cannot hold.
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
