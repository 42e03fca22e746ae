use std::collections::BTreeMap;

use document::KeyPath;
use nalgebra::{Matrix3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::loaded::Loaded;
use crate::misfit::Misfit;
use crate::range::{Range, in_range};
use crate::robot_toml::joint_entry::{JointEntry, gain};
use crate::structure::actuator::{SensingSide, TorqueSource};
use crate::structure::control::PdGain;
use crate::structure::inertia::Inertia;
use crate::structure::part::JointSelection;

/// The keys of `robot.toml`: what a URDF cannot say.
///
/// At a prismatic joint `nm` stands for N, `rad` for m and `kg_m2` for kg.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Plumbline robot description")]
pub(crate) struct Description {
    /// Path of the URDF or MJCF, relative to this file.
    pub urdf: String,
    /// The joints that move; by default every joint of the description. The others are locked, and the file describes
    /// the reduced robot.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joints: Option<Vec<String>>,
    /// Free fall in the base frame; by default that of an MJCF, (0, 0, -9.81) of a URDF.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gravity_m_per_s2: Option<[f64; 3]>,
    /// Rate of the joint controller.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub control_rate_hz: Option<f64>,
    /// Where positions are measured, unless a joint says otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = "unknown"))]
    pub sensing: Option<SensingSide>,
    /// What the efforts of a log are, unless a joint says otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = "unknown"))]
    pub torque_source: Option<TorqueSource>,
    /// How efforts that are missing in the logs are computed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub effort_source: Option<EffortSourceEntry>,
    /// Pairs of joints that two motors drive together.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub differentials: Vec<[String; 2]>,
    /// Where joints are locked (rad or m), zero where it is not said.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub locked: BTreeMap<String, f64>,
    /// What is known of a joint, by its name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub joint: BTreeMap<String, JointEntry>,
    /// Named sets of gains, by name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub gains: BTreeMap<String, GainEntry>,
    /// Inertias of moving bodies, a link with everything fixed to it, by the name of the link.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub link: BTreeMap<String, LinkEntry>,
}

/// A set of gains, one entry per joint, in the order of the robot.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct GainEntry {
    /// Proportional gains, one a moving joint, in the order of the robot.
    pub kp_nm_per_rad: Vec<f64>,
    /// Derivative gains, one a moving joint, in the order of the robot.
    pub kd_nm_s_per_rad: Vec<f64>,
}

/// The law by which an effort is computed.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum EffortSourceEntry {
    /// `{ position_loop = { kp_nm_per_rad = [...], kd_nm_s_per_rad = [...], goal_hold_hz = ... } }`
    PositionLoop(PositionLoopEntry),
}

/// A servo that follows goals: gains with one entry per joint, in the order of the robot, and the rate at which goals are renewed.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PositionLoopEntry {
    /// Proportional gains, one a moving joint, in the order of the robot.
    pub kp_nm_per_rad: Vec<f64>,
    /// Derivative gains, one a moving joint, in the order of the robot.
    pub kd_nm_s_per_rad: Vec<f64>,
    /// Rate at which goals are renewed, each held until the next one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub goal_hold_hz: Option<f64>,
}

impl PositionLoopEntry {
    fn gains(&self) -> GainEntry {
        let Self { kp_nm_per_rad, kd_nm_s_per_rad, .. } = self.clone();
        GainEntry { kp_nm_per_rad, kd_nm_s_per_rad }
    }
}

/// Mass and inertia of a moving body.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LinkEntry {
    /// Mass.
    pub mass_kg: f64,
    /// Centre of mass in the frame of the link.
    pub com_m: [f64; 3],
    /// Rotational inertia about the centre of mass, axes of the link.
    pub inertia_kg_m2: InertiaEntry,
}

/// Rotational inertia about the centre of mass, link axes.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct InertiaEntry {
    /// Element xx.
    pub xx: f64,
    /// Element xy.
    pub xy: f64,
    /// Element xz.
    pub xz: f64,
    /// Element yy.
    pub yy: f64,
    /// Element yz.
    pub yz: f64,
    /// Element zz.
    pub zz: f64,
}

impl Description {
    /// The joints that the file lets move and where it locks the others.
    pub(crate) fn part(&self) -> JointSelection {
        JointSelection { joints: self.joints.clone(), locked: self.locked.clone() }
    }

    /// Applies every key to the robot, whose locked joints are already merged. Keys of a locked joint
    /// have no effect.
    pub(crate) fn apply(&self, loaded: &mut Loaded) -> Result<(), Misfit> {
        let root = KeyPath::root();
        if let Some(gravity) = self.gravity_m_per_s2 {
            for value in gravity {
                in_range(&root, "gravity_m_per_s2", value, Range::Finite)?;
            }
            loaded.robot = loaded.robot.clone().with_gravity(Vector3::from(gravity));
        }
        if let Some(rate) = self.control_rate_hz {
            in_range(&root, "control_rate_hz", rate, Range::Positive)?;
            loaded.control.rate_hz = Some(rate);
        }
        for index in 0..loaded.robot.joint_count() {
            if let Some(link) = loaded.robot.link_mut(index) {
                link.actuator.sensing = self.sensing.unwrap_or_default();
                link.actuator.torque_source = self.torque_source.unwrap_or_default();
            }
        }
        for (name, entry) in &self.joint {
            if loaded.lock(name).is_none() {
                entry.apply(name, loaded)?;
            }
        }
        self.link.iter().try_for_each(|(name, entry)| entry.apply(name, loaded))?;
        loaded.control.differentials = self.pairs(loaded)?;
        if let Some(EffortSourceEntry::PositionLoop(entry)) = &self.effort_source {
            let site = root.key("effort_source").key("position_loop");
            let gains = entry.gains().gains(&site, loaded.robot.joint_count())?;
            if let Some(hold_hz) = entry.goal_hold_hz {
                in_range(&site, "goal_hold_hz", hold_hz, Range::Positive)?;
            }
            for (index, gain) in gains.into_iter().enumerate() {
                if let Some(link) = loaded.robot.link_mut(index) {
                    link.actuator.position_loop = Some(gain);
                    link.actuator.goal_hold_s = entry.goal_hold_hz.map(f64::recip);
                }
            }
        }
        self.gains.iter().try_for_each(|(name, entry)| {
            let site = root.key("gains").key(name);
            let set = entry.gains(&site, loaded.robot.joint_count())?;
            loaded.control.gain_sets.insert(name.clone(), set);
            Ok(())
        })
    }

    /// The pairs of joints by index, each joint at most once. A pair with a locked joint is skipped:
    /// both motors then drive the other joint.
    fn pairs(&self, loaded: &Loaded) -> Result<Vec<[usize; 2]>, Misfit> {
        let mut pairs: Vec<[usize; 2]> = Vec::new();
        let is_locked = |pair: &[String; 2]| pair.iter().any(|name| loaded.lock(name).is_some());
        for (at, names) in self.differentials.iter().enumerate() {
            if is_locked(names) {
                continue;
            }
            let key = |side| KeyPath::root().key("differentials").index(at).index(side);
            let refuse = |side: usize, found: &str| {
                Err(Misfit::new(key(side), format!("joint {} {found}", names[side])))
            };
            let index = |side: usize| loaded.joint_index(&key(side), &names[side]);
            let pair = [index(0)?, index(1)?];
            if pair[0] == pair[1] {
                return refuse(1, "is paired with itself, another joint was expected");
            }
            for (side, joint) in pair.iter().enumerate() {
                if pairs.as_flattened().contains(joint) {
                    return refuse(side, "stands in two pairs, one at most was expected");
                }
            }
            pairs.push(pair);
        }
        Ok(pairs)
    }
}

impl GainEntry {
    /// One pair of gains a joint.
    fn gains(&self, site: &KeyPath, expected: usize) -> Result<Vec<PdGain>, Misfit> {
        for (quantity, list) in
            [("kp_nm_per_rad", &self.kp_nm_per_rad), ("kd_nm_s_per_rad", &self.kd_nm_s_per_rad)]
        {
            if list.len() != expected {
                let found = list.len();
                let sentence =
                    format!("found {found} entries, {expected} were expected, one per joint");
                return Err(Misfit::new(site.key(quantity), sentence));
            }
        }
        let pairs = self.kp_nm_per_rad.iter().zip(&self.kd_nm_s_per_rad);
        pairs.map(|(&kp, &kd)| gain(site, kp, kd)).collect()
    }
}

impl LinkEntry {
    fn apply(&self, name: &str, loaded: &mut Loaded) -> Result<(), Misfit> {
        let site = KeyPath::root().key("link").key(name);
        let index = moving_link(&site, name, loaded)?;
        let i = &self.inertia_kg_m2;
        in_range(&site, "mass_kg", self.mass_kg, Range::Positive)?;
        for value in self.com_m {
            in_range(&site, "com_m", value, Range::Finite)?;
        }
        for value in [i.xx, i.xy, i.xz, i.yy, i.yz, i.zz] {
            in_range(&site, "inertia_kg_m2", value, Range::Finite)?;
        }
        let inertia = Inertia {
            mass: self.mass_kg,
            com_in_link: Vector3::from(self.com_m),
            about_com: Matrix3::new(i.xx, i.xy, i.xz, i.xy, i.yy, i.yz, i.xz, i.yz, i.zz),
        };
        let Some(link) = loaded.robot.link_mut(index) else { return Ok(()) };
        link.inertia = inertia;
        Ok(())
    }
}

fn moving_link(site: &KeyPath, name: &str, loaded: &Loaded) -> Result<usize, Misfit> {
    let links = loaded.robot.links();
    if let Some(index) = links.iter().position(|l| l.name == name) {
        return Ok(index);
    }
    let carrier = links.iter().find(|l| l.merged.iter().any(|m| m == name));
    Err(match carrier {
        Some(carrier) => {
            let sentence = format!("link {name} is fixed to {}, name that one", carrier.name);
            Misfit::new(site.clone(), sentence)
        }
        None => {
            let known = links.iter().map(|l| l.name.as_str());
            Misfit::name(site.clone(), "moving link", name, known)
        }
    })
}
