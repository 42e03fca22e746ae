use std::path::Path;

use nalgebra::Vector3;

use crate::error::RobotError;
use crate::loaded::Loaded;
use crate::robot_toml::description::{
    Description, EffortSourceEntry, GainEntry, InertiaEntry, LinkEntry, PositionLoopEntry,
};
use crate::robot_toml::file::DescriptionFile;
use crate::robot_toml::joint_entry::{
    CounterbalanceEntry, CouplingEntry, JointEntry, RippleEntry, WarmingEntry, WaveEntry,
};
use crate::structure::actuator::{FrictionWave, SensingSide, TorqueSource, Warming};
use crate::structure::control::PdGain;
use crate::structure::inertia::Inertia;
use crate::structure::link::Link;
use crate::structure::robot::Robot;

impl Loaded {
    /// The text of a `robot.toml` for `robot`, this robot or a changed copy of it.
    ///
    /// The text holds the differences from the URDF, the control settings, and which joints are
    /// locked where. Loading it gives `robot` again to the last bit, except times, which are rounded
    /// where no number of milliseconds equals them. `urdf` is the path of the URDF relative to the
    /// folder of the text.
    ///
    /// # Errors
    ///
    /// [`RobotError::NotDescribable`] when `robot` differs from the URDF in something
    /// `robot.toml` has no key for: joints, links, axes, origins, position and velocity
    /// limits. Numbers that `robot.toml` refuses, such as a negative mass, are refused
    /// here in the same words, at their place in the text.
    pub fn to_toml(&self, robot: &Robot, urdf: &str) -> Result<String, RobotError> {
        same_tree(robot, &self.robot_in_urdf)?;
        let text = toml::to_string(&self.describe(robot, urdf))
            .map_err(|e| RobotError::Unwritable { reason: e.to_string() })?;
        DescriptionFile::parse(&text, Path::new("robot.toml"))?.apply(&mut self.clone())?;
        Ok(text)
    }

    fn describe(&self, robot: &Robot, urdf: &str) -> Description {
        let (old, control) = (&self.robot_in_urdf, &self.control);
        // A pair that names no joint is refused when the description is applied.
        let joint_name = |i: usize| robot.joint_names().nth(i).unwrap_or_default().to_owned();
        let mut description = Description {
            urdf: urdf.to_owned(),
            joints: self.part.joints.clone(),
            locked: self.part.locked.clone(),
            gravity_m_per_s2: gravity(robot, old),
            control_rate_hz: control.rate_hz,
            effort_source: effort_source(robot),
            differentials: control.differentials.iter().map(|p| p.map(joint_name)).collect(),
            ..Description::default()
        };
        let names: Vec<&str> = robot.joint_names().collect();
        for (i, (new, old)) in robot.links().iter().zip(old.links()).enumerate() {
            let entry = joint_entry(new, old, &names, control.gains.get(i).copied().flatten());
            if entry != JointEntry::default() {
                description.joint.insert(new.joint.name.clone(), entry);
            }
            if new.inertia != old.inertia {
                description.link.insert(new.name.clone(), link_entry(&new.inertia));
            }
        }
        for (name, set) in &control.gain_sets {
            description.gains.insert(name.clone(), gain_entry(set));
        }
        description
    }
}

fn gain_entry(gains: &[PdGain]) -> GainEntry {
    GainEntry {
        kp_nm_per_rad: gains.iter().map(|g| g.kp).collect(),
        kd_nm_s_per_rad: gains.iter().map(|g| g.kd).collect(),
    }
}

/// The position loop. Either all joints have one or none.
fn effort_source(robot: &Robot) -> Option<EffortSourceEntry> {
    let gains = robot.links().iter().map(|link| link.actuator.position_loop);
    gains.collect::<Option<Vec<PdGain>>>().map(|gains| {
        let GainEntry { kp_nm_per_rad, kd_nm_s_per_rad } = gain_entry(&gains);
        let hold_s = robot.links().first().and_then(|link| link.actuator.goal_hold_s);
        let goal_hold_hz = hold_s.map(f64::recip);
        let entry = PositionLoopEntry { kp_nm_per_rad, kd_nm_s_per_rad, goal_hold_hz };
        EffortSourceEntry::PositionLoop(entry)
    })
}

/// Refuses a change for which `robot.toml` has no key.
fn same_tree(new: &Robot, old: &Robot) -> Result<(), RobotError> {
    let differs = |thing: String, quantity| Err(RobotError::NotDescribable { thing, quantity });
    if new.name() != old.name() || new.joint_count() != old.joint_count() {
        return differs(format!("robot {}", new.name()), "name or number of joints");
    }
    for (new, old) in new.links().iter().zip(old.links()) {
        if (&new.name, &new.parent, &new.merged) != (&old.name, &old.parent, &old.merged) {
            return differs(format!("link {}", new.name), "name, parent or merged links");
        }
        let mut joint = new.joint.clone();
        joint.limits.effort = old.joint.limits.effort;
        if joint != old.joint {
            return differs(format!("joint {}", new.joint.name), "name, origin, axis or limit");
        }
    }
    Ok(())
}

fn gravity(new: &Robot, old: &Robot) -> Option<[f64; 3]> {
    let gravity: Vector3<f64> = new.gravity_in_base();
    (gravity != old.gravity_in_base()).then_some(gravity.into())
}

fn joint_entry(new: &Link, old: &Link, names: &[&str], gain: Option<PdGain>) -> JointEntry {
    let (a, b) = (&new.actuator, &old.actuator);
    let (forward, backward) = (
        changed_number(a.coulomb_forward, b.coulomb_forward),
        changed_number(a.coulomb_backward, b.coulomb_backward),
    );
    let both = forward.filter(|f| backward.is_some_and(|b| changed_number(*f, b).is_none()));
    JointEntry {
        rotor_inertia_kg_m2: changed_number(a.rotor_inertia, b.rotor_inertia),
        viscous_nm_s_per_rad: changed_number(a.viscous, b.viscous),
        coulomb_nm: both,
        coulomb_forward_nm: forward.filter(|_| both.is_none()),
        coulomb_backward_nm: backward.filter(|_| both.is_none()),
        spring_stiffness_nm_per_rad: changed_number(a.spring_stiffness, b.spring_stiffness),
        spring_rest_rad: changed_number(a.spring_rest, b.spring_rest),
        spring_cubic_nm_per_rad3: changed_number(a.spring_cubic, b.spring_cubic),
        spring_hysteresis_nm: changed_number(a.spring_hysteresis, b.spring_hysteresis),
        torque_gain: changed_number(a.torque_gain, b.torque_gain),
        torque_offset_nm: changed_number(a.torque_offset, b.torque_offset),
        backlash_rad: changed_number(a.backlash, b.backlash),
        elasticity_nm_per_rad: a.elasticity,
        elasticity_damping_nm_s_per_rad: a.elasticity_damping,
        actuator_delay_ms: changed_number(a.delay_s, b.delay_s).map(milliseconds),
        stribeck_excess_nm: a.stribeck.map(|s| s.excess),
        stribeck_velocity_rad_per_s: a.stribeck.map(|s| s.velocity),
        load_friction: changed_number(a.load_friction, b.load_friction),
        presliding_rad: a.presliding,
        presliding_damping_nm_s_per_rad: a.presliding_damping,
        actuator_lag_ms: changed_number(a.lag_s, b.lag_s).map(milliseconds),
        effort_skew_ms: changed_number(a.effort_skew_s, b.effort_skew_s).map(milliseconds),
        goal_delay_ms: changed_number(a.goal_delay_s, b.goal_delay_s).map(milliseconds),
        encoder_offset_rad: changed_number(a.encoder_offset, b.encoder_offset),
        transmission_ratio: changed_number(a.transmission_ratio, b.transmission_ratio),
        torque_limit_nm: changed_number(
            new.joint.limits.effort.unwrap_or(f64::INFINITY),
            old.joint.limits.effort.unwrap_or(f64::INFINITY),
        ),
        sensing: Some(a.sensing).filter(|s| *s != SensingSide::Unknown),
        torque_source: Some(a.torque_source).filter(|s| *s != TorqueSource::Unknown),
        kp_nm_per_rad: gain.map(|g| g.kp),
        kd_nm_s_per_rad: gain.map(|g| g.kd),
        friction_wave: a.friction_wave.map(wave_entry),
        friction_warming: a.warming.map(warming_entry),
        coupling: a.coupling.map(|c| CouplingEntry {
            with: names.get(c.other).copied().unwrap_or_default().to_owned(),
            ratio: c.ratio,
            coulomb_sum_nm: c.level[0],
            coulomb_difference_nm: c.level[1],
            viscous_sum_nm_s_per_rad: c.viscous[0],
            viscous_difference_nm_s_per_rad: c.viscous[1],
        }),
        counterbalance: a
            .counterbalance
            .map(|c| CounterbalanceEntry { amplitude_nm: c.amplitude, phase_rad: c.phase }),
        torque_ripple: a.ripple.map(|r| RippleEntry {
            amplitude_nm: r.amplitude,
            periods_per_turn: r.periods,
            phase_rad: r.phase,
        }),
    }
}

fn wave_entry(wave: FrictionWave) -> WaveEntry {
    let FrictionWave { share, periods, phase } = wave;
    WaveEntry { share, periods_per_turn: periods, phase_rad: phase }
}

fn warming_entry(warming: Warming) -> WarmingEntry {
    WarmingEntry {
        viscous_lost_nm_s_per_rad: warming.viscous_lost,
        coulomb_lost_nm: warming.coulomb_lost,
        time_constant_s: warming.time_constant_s,
    }
}

fn link_entry(inertia: &Inertia) -> LinkEntry {
    let i = &inertia.about_com;
    LinkEntry {
        mass_kg: inertia.mass,
        com_m: inertia.com_in_link.into(),
        inertia_kg_m2: InertiaEntry {
            xx: i.m11,
            xy: i.m12,
            xz: i.m13,
            yy: i.m22,
            yz: i.m23,
            zz: i.m33,
        },
    }
}

/// The number of milliseconds that is read back as `seconds`. Every time that was read from a file
/// has one; other times may be rounded in the last bit.
fn milliseconds(seconds: f64) -> f64 {
    let near = 1e3 * seconds;
    let exact = |ms: &f64| (1e-3 * ms).total_cmp(&seconds).is_eq();
    [near, near.next_down(), near.next_up()].into_iter().find(exact).unwrap_or(near)
}

/// The new number, where it is not the old one to the last bit.
fn changed_number(new: f64, old: f64) -> Option<f64> {
    new.total_cmp(&old).is_ne().then_some(new)
}
