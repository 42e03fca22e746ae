//! Configurations of actuators of Isaac Lab.

use std::collections::BTreeMap;

use robot::{Link, Loaded, Robot};
use serde::Serialize;

use crate::quantity::levels;
use crate::servo::Servo;
use crate::usd::write::prim_names;

/// Time step of a simulation of Isaac Lab that a fate counts delays in (s).
pub const USUAL_STEP_S: f64 = 0.005;

/// What Isaac Lab itself takes for "no limit".
const UNLIMITED: f64 = 1e9;

/// Joints whose goals are late by the same time.
#[derive(Debug, PartialEq, Serialize)]
struct Group {
    goal_delay_s: f64,
    joints: BTreeMap<String, JointValues>,
}

/// A joint, with the names of `ActuatorBaseCfg`.
///
/// Source: isaaclab/actuators/actuator_base_cfg.py of Isaac Lab 3, actuator_cfg.py of 2.3.
#[derive(Debug, PartialEq, Serialize)]
struct JointValues {
    stiffness: f64,
    damping: f64,
    effort_limit: f64,
    velocity_limit: f64,
    armature: f64,
    friction: f64,
    dynamic_friction: f64,
    viscous_friction: f64,
}

/// A delay in whole steps of that length (s).
pub fn in_steps(late_s: f64) -> f64 {
    (late_s / USUAL_STEP_S).round() * USUAL_STEP_S
}

/// A Python module with a function that gives the actuators of an articulation.
///
/// Joints have the names of the USD layer of the same robot: letters, digits and `_`, which no quote or pattern can leave.
pub fn write(loaded: &Loaded, robot: &Robot) -> Result<String, serde_json::Error> {
    let mut groups: Vec<Group> = vec![];
    for (link, (_, prim)) in robot.links().iter().zip(prim_names(loaded, robot).links) {
        let Some(servo) = Servo::of(link) else { continue };
        let values = JointValues::of(link, &servo);
        let is_as_late = |group: &&mut Group| (group.goal_delay_s - servo.late_s).abs() <= 0.0;
        match groups.iter_mut().find(is_as_late) {
            Some(group) => {
                group.joints.insert(prim, values);
            }
            None => groups.push(Group {
                goal_delay_s: servo.late_s,
                joints: BTreeMap::from([(prim, values)]),
            }),
        }
    }
    // JSON of numbers and strings is a literal of Python as well.
    let groups = serde_json::to_string_pretty(&groups)?;
    Ok(format!("{HEAD}GROUPS = {groups}\n{BODY}"))
}

impl JointValues {
    fn of(link: &Link, servo: &Servo) -> Self {
        let a = &link.actuator;
        let level = levels(a).0.max(0.0);
        Self {
            stiffness: servo.kp,
            damping: servo.kd,
            effort_limit: servo.limit.unwrap_or(UNLIMITED),
            velocity_limit: link.joint.limits.velocity.unwrap_or(UNLIMITED),
            armature: a.rotor_inertia,
            friction: level + a.stribeck.map_or(0.0, |s| s.excess),
            dynamic_friction: level,
            viscous_friction: a.viscous.max(0.0),
        }
    }
}

const HEAD: &str = r#""""The servos of an arm for Isaac Lab (2.3 and newer).

    from extended_actuator import actuators

    ArticulationCfg(..., actuators=actuators(physics_dt=0.005))

Joints are named as in the USD layer of the same export. SI units at the joint: N·m/rad, N·m·s/rad, N·m,
rad/s, kg·m²; N/m, N·s/m, N, m/s, kg at a joint that slides.
"""

from dataclasses import fields

from isaaclab.actuators import DelayedPDActuatorCfg, IdealPDActuatorCfg

# Joints whose goals are late by the same time.
"#;

const BODY: &str = r#"
# Isaac Lab 3 has limits of the actuator and of the joint; older ones have the names without a prefix.
_PREFIX = "actuator_" if "actuator_effort_limit" in {f.name for f in fields(IdealPDActuatorCfg)} else ""


def actuators(physics_dt):
    """Actuators by name for an ArticulationCfg; `physics_dt` is the time step of the simulation (s)."""
    configurations = {}
    for number, group in enumerate(GROUPS, start=1):
        values = {}
        for joint, row in group["joints"].items():
            for key, value in row.items():
                name = _PREFIX + key if key.endswith("_limit") else key
                values.setdefault(name, {})[joint] = value
        values["joint_names_expr"] = list(group["joints"])
        steps = round(group["goal_delay_s"] / physics_dt)
        if steps > 0:
            configuration = DelayedPDActuatorCfg(min_delay=steps, max_delay=steps, **values)
        else:
            configuration = IdealPDActuatorCfg(**values)
        configurations[f"servos_{number}"] = configuration
    return configurations
"#;
