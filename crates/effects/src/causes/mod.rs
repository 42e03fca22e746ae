//! The causes: one a file, under the name it has in `catalogue`.

pub(crate) mod asymmetric_friction;
pub(crate) mod backlash;
pub(crate) mod cable_spring;
pub(crate) mod coulomb_friction;
pub(crate) mod counterbalance;
pub(crate) mod differential_coupling;
pub(crate) mod encoder_offset;
pub(crate) mod friction_temperature_drift;
pub(crate) mod goal_delay;
pub(crate) mod gravity_direction;
pub(crate) mod inertial_parameters;
pub(crate) mod joint_elasticity;
pub(crate) mod late_torque;
pub(crate) mod load_dependent_friction;
pub(crate) mod payload;
pub(crate) mod position_dependent_friction;
pub(crate) mod presliding_friction;
pub(crate) mod rotor_inertia;
pub(crate) mod stribeck_friction;
pub(crate) mod time_skew;
pub(crate) mod torque_constant;
pub(crate) mod torque_offset;
pub(crate) mod transmission_ratio;
pub(crate) mod unmodelled;
pub(crate) mod viscous_friction;
