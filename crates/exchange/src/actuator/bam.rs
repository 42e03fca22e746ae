//! Servos as BAM (Better Actuator Models, Duclusaud 2024) has them.

use std::collections::BTreeMap;

use robot::{Link, Robot};
use serde::Serialize;

use crate::quantity::levels;
use crate::servo::Servo;

/// Supply (V) that a servo is written for: its torque is the same for every supply.
pub const SUPPLY_V: f64 = 12.0;

/// The servo of BAM that is driven by a voltage alone, without a limit of the current; its duty cycle per position error
/// and gain (1/rad), and its largest duty cycle. Source: bam/dynamixel/actuator.py.
const VOLTAGE_SERVO: &str = "mx106";
const ERROR_GAIN: f64 = 0.158;
const MAX_PWM: f64 = 0.9625;

/// Parameters with BAM's names, and those of its code that Isaac Lab reads beside them.
///
/// ```text
/// duty = clip(kp error_gain (goal - q), ±max_pwm)
/// tau  = kt vin duty / R - kt² qd / R
/// friction <= friction_base + friction_viscous |qd| + friction_stribeck exp(-|qd / dtheta_stribeck|^alpha)
///             + load_friction_base |tau_external - tau|
/// ```
///
/// Sources: bam/model.py, bam/actuator.py; isaaclab/actuators/bam_model.py.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BamServo {
    model: &'static str,
    actuator: &'static str,
    kt: f64,
    #[serde(rename = "R")]
    resistance: f64,
    armature: f64,
    q_offset: f64,
    command_delay: f64,
    friction_base: f64,
    friction_viscous: f64,
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    stribeck: Option<BamStribeck>,
    #[serde(skip_serializing_if = "Option::is_none")]
    load_friction_base: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    load_friction_stribeck: Option<f64>,
    error_gain: f64,
    max_pwm: f64,
    max_current: Option<f64>,
    kp: f64,
    vin: f64,
}

/// Dry friction near rest.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct BamStribeck {
    friction_stribeck: f64,
    dtheta_stribeck: f64,
    alpha: f64,
}

/// Parameters of each servo whose law is one of BAM's, by joint; empty where there is none.
pub fn write(robot: &Robot) -> Result<String, serde_json::Error> {
    let laws = robot.links().iter().filter_map(|link| {
        let law = law(link, &Servo::of(link)?).ok()?;
        Some((link.joint.name.as_str(), law))
    });
    let laws: BTreeMap<&str, BamServo> = laws.collect();
    if laws.is_empty() {
        return Ok(String::new());
    }
    Ok(serde_json::to_string_pretty(&laws)? + "\n")
}

/// The law of a servo in BAM, or why it has none.
///
/// The motor's constant and resistance follow from damping and limit of the loop for a supply `vin`:
///
/// ```text
/// kd = kt² / R,   limit = kt vin max_pwm / R,   kp_loop = kt vin kp error_gain / R
/// kt = kd vin max_pwm / limit,   R = kt² / kd,   kp = kp_loop max_pwm / (limit error_gain)
/// ```
///
/// A load that the gearbox carries at rest is both torque of the motor and external torque: `load_friction_base` is half
/// the friction per load.
pub fn law(link: &Link, servo: &Servo) -> Result<BamServo, &'static str> {
    refusal(link, servo)?;
    let limit = servo.limit.unwrap_or(f64::INFINITY);
    let a = &link.actuator;
    let kt = servo.kd * SUPPLY_V * MAX_PWM / limit;
    let stribeck = a.stribeck.filter(|s| s.excess > 0.0).map(|s| BamStribeck {
        friction_stribeck: s.excess,
        dtheta_stribeck: s.velocity,
        // exp(-(qd / velocity)²)
        alpha: 2.0,
    });
    let load = Some(0.5 * a.load_friction).filter(|share| *share > 0.0);
    let model = match (stribeck, load) {
        (None, None) => "m1",
        (Some(_), None) => "m2",
        (None, Some(_)) => "m3",
        (Some(_), Some(_)) => "m4",
    };
    Ok(BamServo {
        model,
        actuator: VOLTAGE_SERVO,
        kt,
        resistance: kt * kt / servo.kd,
        armature: a.rotor_inertia,
        q_offset: 0.0,
        command_delay: servo.late_s,
        friction_base: levels(a).0,
        friction_viscous: a.viscous,
        // Without it BAM takes a share of its own.
        load_friction_stribeck: load.and(stribeck).map(|_| 0.0),
        stribeck,
        load_friction_base: load,
        error_gain: ERROR_GAIN,
        max_pwm: MAX_PWM,
        max_current: None,
        kp: servo.kp * MAX_PWM / (limit * ERROR_GAIN),
        vin: SUPPLY_V,
    })
}

fn refusal(link: &Link, servo: &Servo) -> Result<(), &'static str> {
    let a = &link.actuator;
    let (mean, difference) = levels(a);
    let reasons = [
        (!link.joint.kind.is_rotation(), "BAM's servos turn, this joint slides"),
        (
            servo.limit.is_none_or(|limit| limit <= 0.0),
            "BAM's servos are limited by their voltage: give torque_limit_nm",
        ),
        (
            servo.kd <= 0.0 || servo.kp <= 0.0,
            "BAM's servos are damped by their back EMF: a kp and a kd above 0 are needed",
        ),
        (mean < 0.0 || a.viscous < 0.0, "BAM has no friction below 0"),
        (difference.abs() > 0.0, "friction of BAM is the same in both directions"),
        (
            a.presliding.is_some(),
            "dry friction of BAM is there at once, here it builds up over a way",
        ),
        (a.friction_wave.is_some(), "friction of BAM is the same at all positions"),
        (a.warming.is_some(), "friction of BAM does not change with the time"),
        (a.coupling.is_some(), "friction of BAM belongs to one joint"),
        (a.backlash > 0.0 || a.elasticity.is_some(), "gearboxes of BAM are rigid and without play"),
        (a.ripple.is_some(), "motors of BAM have no ripple"),
        (
            (a.transmission_ratio - 1.0).abs() > 0.0,
            "BAM's servos report the true position: transmission_ratio is not 1",
        ),
    ];
    match reasons.into_iter().find(|(is_so, _)| *is_so) {
        Some((_, reason)) => Err(reason),
        None => Ok(()),
    }
}
