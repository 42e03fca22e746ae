use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::{
    Actuator, Gain, Inertia, Loaded, Ripple, Robot, RobotError, RobotWarning, SensingSide,
    Stribeck, TorqueSource, Wave,
};

/// The keys of `robot.toml`: what a URDF cannot say.
///
/// At a prismatic joint `nm` stands for N, `rad` for m and `kg_m2` for kg.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Description {
    /// Path of the URDF, relative to this file.
    pub urdf: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gravity_m_per_s2: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub control_rate_hz: Option<f64>,
    /// Where positions are measured, unless a joint says otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sensing: Option<SensingSide>,
    /// What the efforts of a log are, unless a joint says otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_source: Option<TorqueSource>,
    /// Pairs of joints that two motors drive together.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub differentials: Vec<[String; 2]>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub joint: BTreeMap<String, JointEntry>,
    /// Named sets of gains.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub gains: BTreeMap<String, GainEntry>,
    /// Inertias of moving bodies, a link with everything fixed to it.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub link: BTreeMap<String, LinkEntry>,
}

/// `[joint.<name>]`
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct JointEntry {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotor_inertia_kg_m2: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub viscous_nm_s_per_rad: Option<f64>,
    /// Coulomb friction in both directions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coulomb_nm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coulomb_forward_nm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coulomb_backward_nm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spring_stiffness_nm_per_rad: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spring_rest_rad: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_gain: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_offset_nm: Option<f64>,
    /// Free play between motor and link, full width.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub backlash_rad: Option<f64>,
    /// Stiffness of the transmission; a joint without it is rigid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elasticity_nm_per_rad: Option<f64>,
    /// Time from command to torque.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub actuator_delay_ms: Option<f64>,
    /// Breakaway minus Coulomb friction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stribeck_excess_nm: Option<f64>,
    /// Velocity at which 1/e of that is left.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stribeck_velocity_rad_per_s: Option<f64>,
    /// Dry friction per unit of torque carried.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub load_friction: Option<f64>,
    /// Way over which dry friction builds up; a joint without it has it at once.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub presliding_rad: Option<f64>,
    /// Time constant of the torque behind its command.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub actuator_lag_ms: Option<f64>,
    /// Position reported at true position zero.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub encoder_offset_rad: Option<f64>,
    /// True over reported position.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub transmission_ratio: Option<f64>,
    /// Time by which the log has effort later than position.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub effort_skew_ms: Option<f64>,
    /// Largest torque; `inf` where the URDF's limit does not hold.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_limit_nm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sensing: Option<SensingSide>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_source: Option<TorqueSource>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kp_nm_per_rad: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kd_nm_s_per_rad: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction_wave: Option<WaveEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_ripple: Option<RippleEntry>,
}

/// `friction_wave`: how the Coulomb level varies with position.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WaveEntry {
    pub share: f64,
    pub periods_per_turn: f64,
    #[serde(default)]
    pub phase_rad: f64,
}

/// `torque_ripple`: torque that the position of the motor decides.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RippleEntry {
    pub amplitude_nm: f64,
    pub periods_per_turn: f64,
    #[serde(default)]
    pub phase_rad: f64,
}

/// `[gains.<name>]`, one entry per joint, in the order of the robot.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct GainEntry {
    pub kp_nm_per_rad: Vec<f64>,
    pub kd_nm_s_per_rad: Vec<f64>,
}

/// `[link.<name>]`
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct LinkEntry {
    pub mass_kg: f64,
    pub com_m: [f64; 3],
    pub inertia_kg_m2: InertiaEntry,
}

/// Rotational inertia about the centre of mass, link axes.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct InertiaEntry {
    pub xx: f64,
    pub xy: f64,
    pub xz: f64,
    pub yy: f64,
    pub yz: f64,
    pub zz: f64,
}

impl Description {
    /// Reads the text of a `robot.toml`.
    pub(crate) fn parse(text: &str) -> Result<Self, RobotError> {
        toml::from_str(text).map_err(|error| {
            let start = error.span().map_or(0, |span| span.start);
            let before = text.get(..start).unwrap_or("");
            let line_start = before.rfind('\n').map_or(0, |at| at + 1);
            RobotError::BadToml {
                line: before.matches('\n').count() + 1,
                column: before[line_start..].chars().count() + 1,
                reason: error.message().split_whitespace().collect::<Vec<_>>().join(" "),
            }
        })
    }

    /// Puts everything the file says into the robot.
    pub(crate) fn apply(&self, loaded: &mut Loaded) -> Result<(), RobotError> {
        if let Some(gravity) = self.gravity_m_per_s2 {
            for value in gravity {
                in_range("robot", "gravity_m_per_s2", value, Range::Finite)?;
            }
            loaded.robot = loaded.robot.clone().with_gravity(Vector3::from(gravity));
        }
        if let Some(rate) = self.control_rate_hz {
            in_range("robot", "control_rate_hz", rate, Range::Positive)?;
            loaded.control.rate_hz = Some(rate);
        }
        for index in 0..loaded.robot.joint_count() {
            if let Some(link) = loaded.robot.link_mut(index) {
                link.actuator.sensing = self.sensing.unwrap_or_default();
                link.actuator.torque_source = self.torque_source.unwrap_or_default();
            }
        }
        self.joint.iter().try_for_each(|(name, entry)| entry.apply(name, loaded))?;
        self.link.iter().try_for_each(|(name, entry)| entry.apply(name, loaded))?;
        loaded.control.differentials = self.pairs(&loaded.robot)?;
        self.gains.iter().try_for_each(|(name, entry)| entry.apply(name, loaded))
    }

    /// The pairs of joints by index; no joint stands in them twice.
    fn pairs(&self, robot: &Robot) -> Result<Vec<[usize; 2]>, RobotError> {
        let refuse = |name: &str, found, expected| {
            Err(RobotError::KeysDisagree { thing: format!("joint {name}"), found, expected })
        };
        let index = |name: &str| joint_index("differentials", name, robot);
        let mut pairs: Vec<[usize; 2]> = Vec::new();
        for [first, second] in &self.differentials {
            let pair = [index(first)?, index(second)?];
            if pair[0] == pair[1] {
                return refuse(first, "differentials pairs it with itself", "another joint");
            }
            for (joint, name) in pair.iter().zip([first, second]) {
                if pairs.as_flattened().contains(joint) {
                    return refuse(name, "differentials has it in two pairs", "one at most");
                }
            }
            pairs.push(pair);
        }
        Ok(pairs)
    }
}

impl JointEntry {
    fn apply(&self, name: &str, loaded: &mut Loaded) -> Result<(), RobotError> {
        let index = joint_index("[joint]", name, &loaded.robot)?;
        let thing = format!("joint {name}");
        if let Some(gain) = self.gain(&thing)? {
            loaded.control.gains[index] = Some(gain);
        }
        let Some(link) = loaded.robot.link_mut(index) else { return Ok(()) };
        self.actuate(&thing, &mut link.actuator)?;
        if let Some(limit) = self.torque_limit_nm {
            let unknown = limit.is_infinite() && limit > 0.0;
            if !unknown {
                in_range(&thing, "torque_limit_nm", limit, Range::Positive)?;
            }
            link.joint.limits.effort = Some(limit).filter(|_| !unknown);
        }
        Ok(())
    }

    fn actuate(&self, thing: &str, actuator: &mut Actuator) -> Result<(), RobotError> {
        let split = self.coulomb_forward_nm.is_some() || self.coulomb_backward_nm.is_some();
        if self.coulomb_nm.is_some() && split {
            return Err(RobotError::KeysDisagree {
                thing: thing.to_owned(),
                found: "coulomb_nm beside coulomb_forward_nm or coulomb_backward_nm",
                expected: "either one value for both directions or one per direction",
            });
        }
        let forward = self.coulomb_nm.or(self.coulomb_forward_nm);
        let backward = self.coulomb_nm.or(self.coulomb_backward_nm);
        let a = actuator;
        use Range::{Finite, NotNegative, Positive};
        for (key, value, range, field) in [
            ("rotor_inertia_kg_m2", self.rotor_inertia_kg_m2, NotNegative, &mut a.rotor_inertia),
            ("viscous_nm_s_per_rad", self.viscous_nm_s_per_rad, Finite, &mut a.viscous),
            ("coulomb_forward_nm", forward, Finite, &mut a.coulomb_forward),
            ("coulomb_backward_nm", backward, Finite, &mut a.coulomb_backward),
            (
                "spring_stiffness_nm_per_rad",
                self.spring_stiffness_nm_per_rad,
                Finite,
                &mut a.spring_stiffness,
            ),
            ("spring_rest_rad", self.spring_rest_rad, Finite, &mut a.spring_rest),
            ("torque_gain", self.torque_gain, Positive, &mut a.torque_gain),
            ("torque_offset_nm", self.torque_offset_nm, Finite, &mut a.torque_offset),
            ("backlash_rad", self.backlash_rad, NotNegative, &mut a.backlash),
            ("load_friction", self.load_friction, NotNegative, &mut a.load_friction),
            ("encoder_offset_rad", self.encoder_offset_rad, Finite, &mut a.encoder_offset),
            ("transmission_ratio", self.transmission_ratio, Positive, &mut a.transmission_ratio),
        ] {
            if let Some(value) = value {
                in_range(thing, key, value, range)?;
                *field = value;
            }
        }
        for (key, value, field) in [
            ("elasticity_nm_per_rad", self.elasticity_nm_per_rad, &mut a.elasticity),
            ("presliding_rad", self.presliding_rad, &mut a.presliding),
        ] {
            if let Some(value) = value {
                in_range(thing, key, value, Positive)?;
                *field = Some(value);
            }
        }
        self.times(thing, a)?;
        a.stribeck = self.stribeck(thing)?.or(a.stribeck);
        a.friction_wave = self.wave(thing)?.or(a.friction_wave);
        a.ripple = self.ripple(thing)?.or(a.ripple);
        a.sensing = self.sensing.unwrap_or(a.sensing);
        a.torque_source = self.torque_source.unwrap_or(a.torque_source);
        Ok(())
    }

    fn times(&self, thing: &str, a: &mut Actuator) -> Result<(), RobotError> {
        use Range::{Finite, NotNegative};
        for (key, value_ms, range, field) in [
            ("actuator_delay_ms", self.actuator_delay_ms, NotNegative, &mut a.delay_s),
            ("actuator_lag_ms", self.actuator_lag_ms, NotNegative, &mut a.lag_s),
            ("effort_skew_ms", self.effort_skew_ms, Finite, &mut a.effort_skew_s),
        ] {
            if let Some(value_ms) = value_ms {
                in_range(thing, key, value_ms, range)?;
                *field = 1e-3 * value_ms;
            }
        }
        Ok(())
    }

    fn stribeck(&self, thing: &str) -> Result<Option<Stribeck>, RobotError> {
        let (excess, velocity) = match (self.stribeck_excess_nm, self.stribeck_velocity_rad_per_s) {
            (None, None) => return Ok(None),
            (Some(excess), Some(velocity)) => (excess, velocity),
            (Some(_), None) => {
                return lonely(
                    thing,
                    "stribeck_excess_nm is there alone",
                    "stribeck_velocity_rad_per_s as well",
                );
            }
            (None, Some(_)) => {
                return lonely(
                    thing,
                    "stribeck_velocity_rad_per_s is there alone",
                    "stribeck_excess_nm as well",
                );
            }
        };
        in_range(thing, "stribeck_excess_nm", excess, Range::NotNegative)?;
        in_range(thing, "stribeck_velocity_rad_per_s", velocity, Range::Positive)?;
        Ok(Some(Stribeck { excess, velocity }))
    }

    fn wave(&self, thing: &str) -> Result<Option<Wave>, RobotError> {
        let Some(WaveEntry { share, periods_per_turn, phase_rad }) = self.friction_wave else {
            return Ok(None);
        };
        in_range(thing, "friction_wave.share", share, Range::Share)?;
        in_range(thing, "friction_wave.periods_per_turn", periods_per_turn, Range::NotNegative)?;
        in_range(thing, "friction_wave.phase_rad", phase_rad, Range::Finite)?;
        Ok(Some(Wave { share, periods: periods_per_turn, phase: phase_rad }))
    }

    fn ripple(&self, thing: &str) -> Result<Option<Ripple>, RobotError> {
        let Some(RippleEntry { amplitude_nm, periods_per_turn, phase_rad }) = self.torque_ripple
        else {
            return Ok(None);
        };
        in_range(thing, "torque_ripple.amplitude_nm", amplitude_nm, Range::NotNegative)?;
        in_range(thing, "torque_ripple.periods_per_turn", periods_per_turn, Range::NotNegative)?;
        in_range(thing, "torque_ripple.phase_rad", phase_rad, Range::Finite)?;
        Ok(Some(Ripple { amplitude: amplitude_nm, periods: periods_per_turn, phase: phase_rad }))
    }

    fn gain(&self, thing: &str) -> Result<Option<Gain>, RobotError> {
        match (self.kp_nm_per_rad, self.kd_nm_s_per_rad) {
            (None, None) => Ok(None),
            (Some(kp), Some(kd)) => gain(thing, kp, kd).map(Some),
            (Some(_), None) => {
                lonely(thing, "kp_nm_per_rad is there alone", "kd_nm_s_per_rad as well")
            }
            (None, Some(_)) => {
                lonely(thing, "kd_nm_s_per_rad is there alone", "kp_nm_per_rad as well")
            }
        }
    }
}

/// Refuses a key without the one that it needs.
fn lonely<T>(thing: &str, found: &'static str, expected: &'static str) -> Result<T, RobotError> {
    Err(RobotError::KeysDisagree { thing: thing.to_owned(), found, expected })
}

impl GainEntry {
    fn apply(&self, name: &str, loaded: &mut Loaded) -> Result<(), RobotError> {
        let (thing, expected) = (format!("gains {name}"), loaded.robot.joint_count());
        for (quantity, list) in
            [("kp_nm_per_rad", &self.kp_nm_per_rad), ("kd_nm_s_per_rad", &self.kd_nm_s_per_rad)]
        {
            if list.len() != expected {
                return Err(RobotError::WrongLength {
                    thing,
                    quantity,
                    found: list.len(),
                    expected,
                });
            }
        }
        let pairs = self.kp_nm_per_rad.iter().zip(&self.kd_nm_s_per_rad);
        let set = pairs.map(|(&kp, &kd)| gain(&thing, kp, kd)).collect::<Result<_, _>>()?;
        loaded.control.gain_sets.insert(name.to_owned(), set);
        Ok(())
    }
}

impl LinkEntry {
    fn apply(&self, name: &str, loaded: &mut Loaded) -> Result<(), RobotError> {
        let index = moving_link(name, loaded)?;
        let thing = format!("link {name}");
        let i = &self.inertia_kg_m2;
        in_range(&thing, "mass_kg", self.mass_kg, Range::Positive)?;
        for value in self.com_m {
            in_range(&thing, "com_m", value, Range::Finite)?;
        }
        for value in [i.xx, i.xy, i.xz, i.yy, i.yz, i.zz] {
            in_range(&thing, "inertia_kg_m2", value, Range::Finite)?;
        }
        let inertia = Inertia {
            mass: self.mass_kg,
            com_in_link: Vector3::from(self.com_m),
            about_com: Matrix3::new(i.xx, i.xy, i.xz, i.xy, i.yy, i.yz, i.xz, i.yz, i.zz),
        };
        let Some(link) = loaded.robot.link_mut(index) else { return Ok(()) };
        // What the URDF said about this body no longer counts.
        let of_body = |l: &str| l == name || link.merged.iter().any(|m| m == l);
        loaded.warnings.retain(|w| !w.link().is_some_and(of_body));
        let defects = inertia.defects().into_iter();
        loaded
            .warnings
            .extend(defects.map(|d| RobotWarning::Inertia { link: name.to_owned(), defect: d }));
        link.inertia = inertia;
        Ok(())
    }
}

/// The joint called `name` at `place`.
fn joint_index(place: &str, name: &str, robot: &Robot) -> Result<usize, RobotError> {
    robot.joint_index(name).ok_or_else(|| {
        let known: Vec<&str> = robot.joint_names().collect();
        RobotError::unknown_name(place, "joint", name, &known)
    })
}

fn moving_link(name: &str, loaded: &Loaded) -> Result<usize, RobotError> {
    let links = loaded.robot.links();
    if let Some(index) = links.iter().position(|l| l.name == name) {
        return Ok(index);
    }
    let known: Vec<&str> = links.iter().map(|l| l.name.as_str()).collect();
    let carrier = links.iter().find(|l| l.merged.iter().any(|m| m == name));
    Err(match carrier {
        Some(carrier) => RobotError::UnknownName {
            place: "[link]".to_owned(),
            what: "moving link",
            name: name.to_owned(),
            hint: format!("it is fixed to {}, name that one", carrier.name),
        },
        None => RobotError::unknown_name("[link]", "moving link", name, &known),
    })
}

fn gain(thing: &str, kp: f64, kd: f64) -> Result<Gain, RobotError> {
    in_range(thing, "kp_nm_per_rad", kp, Range::Positive)?;
    in_range(thing, "kd_nm_s_per_rad", kd, Range::NotNegative)?;
    Ok(Gain { kp, kd })
}

#[derive(Clone, Copy)]
enum Range {
    Finite,
    NotNegative,
    Positive,
    Share,
}

fn in_range(
    thing: &str,
    quantity: &'static str,
    value: f64,
    range: Range,
) -> Result<(), RobotError> {
    let (inside, expected) = match range {
        Range::Finite => (true, "a finite number"),
        Range::NotNegative => (value >= 0.0, "a finite number not below 0"),
        Range::Positive => (value > 0.0, "a finite number above 0"),
        Range::Share => ((0.0..=1.0).contains(&value), "a number from 0 to 1"),
    };
    if inside && value.is_finite() {
        return Ok(());
    }
    Err(RobotError::OutOfRange { thing: thing.to_owned(), quantity, value, expected })
}
