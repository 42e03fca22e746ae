//! Sensors of a log, drawn by the class of the arm.

use std::collections::BTreeMap;

use rand_chacha::ChaCha8Rng;
use simulator::scenario::{DropoutSpec, Logged, SensorSpec};
use simulator::{PositionSide, VelocitySource};

use crate::arms::arm::SampledArm;
use crate::corner::{ArmClass, EffortClass};
use crate::dice::{between, happens, log_uniform_between, one_of, round_to_digits};

/// Draws the sensors of an arm.
pub(crate) fn draw(class: ArmClass, arm: &SampledArm, random: &mut ChaCha8Rng) -> SensorSpec {
    let electronics = &arm.electronics;
    let mut spec = SensorSpec {
        position: electronics.position,
        effort: electronics.effort_source(),
        velocity: VelocitySource::FilteredDifference { cutoff_hz: electronics.cutoff_hz },
        log_rate_hz: Some(electronics.log_rate_hz),
        ..SensorSpec::default()
    };
    encoders(class, arm, &mut spec, random);
    efforts(class, arm, &mut spec, random);
    if happens(random, 0.35) {
        spec.velocity_logged = Logged::No;
    }
    let period_ms = 1e3 / electronics.log_rate_hz;
    if happens(random, 0.15) {
        spec.time_jitter_ms = round_to_digits(period_ms * between(random, [0.01, 0.1]), 2);
    }
    if happens(random, 0.1) {
        spec.dropped_share = round_to_digits(log_uniform_between(random, [0.002, 0.05]), 2);
    }
    if happens(random, 0.12) {
        let per_minute = round_to_digits(log_uniform_between(random, [1.0, 6.0]), 2);
        let length_ms = round_to_digits(log_uniform_between(random, [20.0, 300.0]), 2);
        spec.dropouts = Some(DropoutSpec { per_minute, length_ms });
    }
    spec
}

/// Encoders, with second ones at the links of some arms.
fn encoders(class: ArmClass, arm: &SampledArm, spec: &mut SensorSpec, random: &mut ChaCha8Rng) {
    let bits = match class {
        ArmClass::Hobby => one_of(random, [12, 12, 12, 10, 14]),
        ArmClass::Cobot => one_of(random, [17, 18, 19, 20]),
        ArmClass::Industrial => one_of(random, [16, 17, 19, 20]),
        // Motor encoders of 4096 counts behind ratios of 18 to 42.
        ArmClass::Wam => one_of(random, [16, 17]),
    };
    let bits = arm.electronics.encoder_bits.map_or(bits, i32::from);
    let step = std::f64::consts::TAU / 2_f64.powi(bits);
    let noise = between(random, [0.0, 0.7]);
    let second = matches!(class, ArmClass::Cobot | ArmClass::Industrial)
        && arm.electronics.position == PositionSide::Motor
        && happens(random, 0.25);
    let link_step = std::f64::consts::TAU / 2_f64.powi(one_of(random, [17, 18, 19]));
    let link_noise = between(random, [0.0, 0.7]);
    for link in arm.robot.links() {
        let name = &link.joint.name;
        // A spindle of 40 mm a turn makes metres of turns.
        let way = if link.joint.kind.is_rotation() { 1.0 } else { 0.04 / std::f64::consts::TAU };
        spec.position_resolution_rad.insert(name.clone(), round_to_digits(way * step, 6));
        spec.position_noise_rad.insert(name.clone(), round_to_digits(way * step * noise, 3));
        if second {
            spec.link_position_resolution_rad
                .insert(name.clone(), round_to_digits(way * link_step, 6));
            spec.link_position_noise_rad
                .insert(name.clone(), round_to_digits(way * link_step * link_noise, 3));
        }
    }
    if second && happens(random, 0.5) {
        spec.link_position_lag_ms = round_to_digits(between(random, [0.5, 5.0]), 2);
    }
}

/// Noise and steps of the efforts, as shares of the drives' ratings.
fn efforts(class: ArmClass, arm: &SampledArm, spec: &mut SensorSpec, random: &mut ChaCha8Rng) {
    let noise = match (arm.electronics.effort, class) {
        (EffortClass::Command, _) => 0.0,
        (EffortClass::Current, ArmClass::Hobby) => log_uniform_between(random, [0.01, 0.05]),
        (EffortClass::Current, _) => log_uniform_between(random, [0.005, 0.05]),
        (EffortClass::JointTorque, _) => log_uniform_between(random, [0.001, 0.01]),
    };
    let stepped = match class {
        ArmClass::Hobby => 0.6,
        _ => 0.25,
    };
    let step =
        if happens(random, stepped) { 1.0 / one_of(random, [500.0, 1000.0, 2000.0]) } else { 0.0 };
    let of = |share: f64| -> BTreeMap<String, f64> {
        let pairs = arm.robot.joint_names().zip(&arm.limits);
        pairs.map(|(name, limit)| (name.to_owned(), round_to_digits(share * limit, 3))).collect()
    };
    if noise > 0.0 {
        spec.effort_noise_nm = of(0.5 * noise);
    }
    if step > 0.0 {
        spec.effort_resolution_nm = of(step);
    }
}
