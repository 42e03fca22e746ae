use robot::{Actuator, Robot};

use crate::effects::{
    actuator_delay, actuator_lag, cable_spring, counterbalance, differential_coupling,
    encoder_offset, friction_temperature_drift, load_dependent_friction,
    position_dependent_friction, presliding_friction, stribeck_friction, torque_ripple,
    transmission_ratio,
};
use crate::mechanics::inject::Inject;

/// Rotor inertia assumed for the bristles of a shared motor where the robot states none (kg m² or kg).
const LEAST_ROTOR: f64 = 1e-3;

/// The effects that the robot's description states, without those in the [`Plant`](crate::Plant).
///
/// At a joint with several of them, presliding acts on the sum of all dry friction, and the reported
/// position is `q / ratio + offset`.
pub(crate) fn described_effects(robot: &Robot) -> impl Iterator<Item = Box<dyn Inject>> {
    let rotor = |j: usize| {
        let known = robot.links().get(j).map_or(0.0, |link| link.actuator.rotor_inertia);
        known.max(LEAST_ROTOR)
    };
    robot.links().iter().enumerate().flat_map(move |(joint, link)| {
        let a = &link.actuator;
        let effort_limit = link.joint.limits.effort.unwrap_or(0.0);
        let [delay, lag, load, offset] =
            [a.delay_s, a.lag_s, a.load_friction, a.encoder_offset].map(not_zero);
        let ratio = Some(a.transmission_ratio).filter(|ratio| ratio.total_cmp(&1.0).is_ne());
        [
            delay.map(|delay_s| actuator_delay::acting(joint, delay_s)),
            lag.map(|lag_s| actuator_lag::acting(joint, lag_s)),
            a.friction_wave.map(|wave| position_dependent_friction::varying(joint, wave)),
            a.stribeck.map(|excess| stribeck_friction::acting(joint, 0.0, excess)),
            load.map(|coefficient| load_dependent_friction::acting(joint, coefficient)),
            a.warming.map(|warming| friction_temperature_drift::losing(joint, warming)),
            a.presliding.map(|way| {
                presliding_friction::bending(joint, a, largest_dry(a, effort_limit) / way)
            }),
            a.ripple.map(|ripple| torque_ripple::acting(joint, ripple)),
            cable_spring::beyond_linear(robot, joint, a),
            a.counterbalance.map(|balance| counterbalance::acting(joint, balance)),
            a.coupling
                .map(|c| differential_coupling::acting(joint, [joint, c.other].map(rotor), c)),
            ratio.map(|ratio| transmission_ratio::acting(joint, ratio)),
            offset.map(|offset| encoder_offset::acting(joint, offset)),
        ]
        .into_iter()
        .flatten()
    })
}

fn not_zero(value: f64) -> Option<f64> {
    (value.abs() > 0.0).then_some(value)
}

/// Largest dry friction of a drive that carries at most its effort limit (N m or N).
fn largest_dry(drive: &Actuator, effort_limit: f64) -> f64 {
    let wave = 1.0 + drive.friction_wave.map_or(0.0, |wave| wave.share);
    drive.coulomb_forward.max(drive.coulomb_backward).max(0.0) * wave
        + drive.stribeck.map_or(0.0, |s| s.excess)
        + drive.load_friction * effort_limit
}
