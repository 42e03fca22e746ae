//! The simulated arm against closed forms and other programs.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod actuator_delay;
mod actuator_lag;
mod asymmetric_friction;
mod backlash;
mod cable_spring;
mod chain;
mod coulomb_friction;
mod differential_coupling;
mod draws;
mod encoder_offset;
mod engine;
mod external_disturbance;
mod friction_temperature_drift;
mod gravity_direction;
mod inertial_parameters;
mod joint_elasticity;
mod load_dependent_friction;
mod mistakes;
mod mujoco;
mod payload;
mod position_dependent_friction;
mod presliding_friction;
mod rig;
mod rotor_inertia;
mod sensors;
mod stribeck_friction;
mod time_skew;
mod torque_constant;
mod torque_offset;
mod torque_ripple;
mod torque_saturation;
mod transmission_ratio;
mod truth;
mod viscous_friction;
