//! Draws what every effect does to the torque of the simulated WAM, beside its closed form:
//!
//! ```text
//! cargo run --release -p simulator --example signatures
//! ```
//!
//! simulates every file of `scenarios/effects` with its effect and without, with sensors that
//! err in nothing else, and writes `crates/simulator/signatures.svg`.

mod drive;
mod friction;
mod load;
mod panel;
mod record;
mod sensing;
mod statics;
mod svg;
mod transmission;

use std::path::Path;

use rayon::prelude::*;
use simulator::effects::EffectSpec;

use crate::panel::Panel;
use crate::record::{Record, Unusable};

/// The effects in the order of the figure, a family at a time.
const FAMILIES: [(&str, &[&str]); 5] = [
    (
        "Friction",
        &[
            "viscous_friction",
            "coulomb_friction",
            "asymmetric_friction",
            "stribeck_friction",
            "presliding_friction",
            "load_dependent_friction",
            "position_dependent_friction",
            "friction_temperature_drift",
        ],
    ),
    ("Transmission", &["backlash", "joint_elasticity", "rotor_inertia", "differential_coupling"]),
    (
        "Load",
        &["payload", "inertial_parameters", "gravity_direction", "cable_spring", "counterbalance"],
    ),
    (
        "Drive",
        &[
            "torque_ripple",
            "torque_constant",
            "torque_offset",
            "torque_saturation",
            "actuator_lag",
            "actuator_delay",
            "goal_delay",
        ],
    ),
    (
        "Sensors and surroundings",
        &["encoder_offset", "transmission_ratio", "time_skew", "external_disturbance"],
    ),
];

fn main() -> Result<(), Unusable> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let scenarios = here.join("../../scenarios/effects");
    let panel = |name: &&str| Ok(panel(&Record::of(&scenarios, name)?));
    let family = |(family, names): &(&'static str, &[&str])| {
        let panels: Result<Vec<Panel>, Unusable> = names.par_iter().map(panel).collect();
        panels.map(|panels| (*family, panels))
    };
    let families = FAMILIES.par_iter().map(family).collect::<Result<Vec<_>, Unusable>>()?;
    let file = here.join("signatures.svg");
    std::fs::write(&file, svg::figure(&families))?;
    println!("wrote {}", file.display());
    Ok(())
}

/// The plot that shows an effect best.
fn panel(record: &Record) -> Panel {
    use EffectSpec as E;
    match &record.effect {
        E::ViscousFriction(effect) => friction::viscous(record, effect),
        E::CoulombFriction(effect) => friction::coulomb(record, effect),
        E::AsymmetricFriction(effect) => friction::asymmetric(record, effect),
        E::StribeckFriction(effect) => friction::stribeck(record, effect),
        E::PreslidingFriction(effect) => friction::presliding(record, effect),
        E::LoadDependentFriction(effect) => friction::load_dependent(record, effect),
        E::PositionDependentFriction(effect) => friction::position_dependent(record, effect),
        E::FrictionTemperatureDrift(effect) => friction::temperature_drift(record, effect),
        E::Backlash(effect) => transmission::backlash(record, effect),
        E::JointElasticity(effect) => transmission::elasticity(record, effect),
        E::RotorInertia(effect) => transmission::rotor(record, effect),
        E::DifferentialCoupling(effect) => transmission::differential(record, effect),
        E::Payload(effect) => load::payload(record, effect),
        E::InertialParameters(effect) => load::inertial_parameters(record, effect),
        E::GravityDirection(effect) => load::gravity_direction(record, effect),
        E::CableSpring(effect) => load::cable(record, effect),
        E::Counterbalance(effect) => load::counterbalance(record, effect),
        E::TorqueRipple(effect) => drive::ripple(record, effect),
        E::TorqueConstant(effect) => drive::constant(record, effect),
        E::TorqueOffset(effect) => drive::offset(record, effect),
        E::TorqueSaturation(effect) => drive::saturation(record, effect),
        E::ActuatorLag(effect) => drive::lag(record, effect),
        E::ActuatorDelay(effect) => drive::delay(record, effect),
        E::GoalDelay(effect) => drive::goal_delay(record, effect),
        E::EncoderOffset(effect) => sensing::encoder_offset(record, effect),
        E::TransmissionRatio(effect) => sensing::ratio(record, effect),
        E::TimeSkew(effect) => sensing::skew(record, effect),
        E::ExternalDisturbance(effect) => sensing::disturbance(record, effect),
    }
}
