use document::KeyPath;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::loaded::Loaded;
use crate::misfit::Misfit;
use crate::range::{Range, in_range};
use crate::structure::actuator::{
    Actuator, CounterbalanceTerm, Coupling, FrictionWave, Ripple, SensingSide, Stribeck,
    TorqueSource, Warming,
};
use crate::structure::control::PdGain;

/// A joint: its drive, its friction, its sensors and the gains of its controller.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct JointEntry {
    /// Inertia of rotor and gear, seen at the joint; by default the armature of an MJCF, 0 of a URDF.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotor_inertia_kg_m2: Option<f64>,
    /// Viscous friction; by default the damping of the URDF or MJCF.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub viscous_nm_s_per_rad: Option<f64>,
    /// Coulomb friction in both directions; by default the friction of the URDF or MJCF. It stands alone or not at
    /// all beside the two keys of one direction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coulomb_nm: Option<f64>,
    /// Coulomb friction in positive motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coulomb_forward_nm: Option<f64>,
    /// Coulomb friction in negative motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coulomb_backward_nm: Option<f64>,
    /// Stiffness of a spring between the joint and the link before it; by default that of an MJCF, 0 of a URDF.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spring_stiffness_nm_per_rad: Option<f64>,
    /// Position at which the spring has no torque; by default that of an MJCF, 0 of a URDF.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spring_rest_rad: Option<f64>,
    /// Torque of the spring per cube of displacement.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = 0.0))]
    pub spring_cubic_nm_per_rad3: Option<f64>,
    /// Half the width of the loop of its torque over position; it needs a stiffness above 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = 0.0))]
    pub spring_hysteresis_nm: Option<f64>,
    /// Effort in the log over torque of the joint.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = 1.0))]
    pub torque_gain: Option<f64>,
    /// Effort in the log where the torque is zero.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = 0.0))]
    pub torque_offset_nm: Option<f64>,
    /// Free play between motor and link, full width.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = 0.0))]
    pub backlash_rad: Option<f64>,
    /// Stiffness of the transmission; a joint without it is rigid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elasticity_nm_per_rad: Option<f64>,
    /// Damping of that stiffness, which counts near the resonance of the link; it needs that stiffness.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elasticity_damping_nm_s_per_rad: Option<f64>,
    /// Time from command to torque.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = 0.0))]
    pub actuator_delay_ms: Option<f64>,
    /// Breakaway minus Coulomb friction; it needs a Stribeck velocity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stribeck_excess_nm: Option<f64>,
    /// Velocity at which 1/e of that excess is left.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stribeck_velocity_rad_per_s: Option<f64>,
    /// Dry friction per unit of torque carried.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = 0.0))]
    pub load_friction: Option<f64>,
    /// Displacement over which dry friction builds up; without it friction acts at once.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub presliding_rad: Option<f64>,
    /// Damping of the presliding displacement; it needs that displacement.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub presliding_damping_nm_s_per_rad: Option<f64>,
    /// Time constant of the torque behind its command.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = 0.0))]
    pub actuator_lag_ms: Option<f64>,
    /// Position reported at true position zero.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = 0.0))]
    pub encoder_offset_rad: Option<f64>,
    /// True over reported position.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = 1.0))]
    pub transmission_ratio: Option<f64>,
    /// Time by which the log has effort later than position.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = 0.0))]
    pub effort_skew_ms: Option<f64>,
    /// Time from the row of a goal to the position loop.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = 0.0))]
    pub goal_delay_ms: Option<f64>,
    /// Largest torque; by default the description's effort limit, `inf` where that does not hold.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_limit_nm: Option<f64>,
    /// Where the position of this joint is measured; by default what the key `sensing` of the whole file says.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sensing: Option<SensingSide>,
    /// What the effort of this joint is in a log; by default what the key `torque_source` of the whole file says.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_source: Option<TorqueSource>,
    /// Proportional gain of the joint controller; by default that of a servo of an MJCF. Both gains stand together.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kp_nm_per_rad: Option<f64>,
    /// Derivative gain of the joint controller.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kd_nm_s_per_rad: Option<f64>,
    /// How the Coulomb level varies with position.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction_wave: Option<WaveEntry>,
    /// Friction that is lost while the drive warms up, from a cold start of the session.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction_warming: Option<WarmingEntry>,
    /// Torque that depends on the position of the motor.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_ripple: Option<RippleEntry>,
    /// A spring or counterweight that balances part of the weight; at a joint that turns.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub counterbalance: Option<CounterbalanceEntry>,
    /// Friction of two motors that drive this joint and another one together.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coupling: Option<CouplingEntry>,
}

/// Friction of two motors that drive the joint and another one together.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CouplingEntry {
    /// The other joint.
    pub with: String,
    /// Motor rotation per unit of the other joint over motor rotation per unit of this joint.
    pub ratio: f64,
    /// Coulomb friction of the motor that turns with the sum of both joints.
    #[serde(default)]
    pub coulomb_sum_nm: f64,
    /// Coulomb friction of the motor that turns with their difference.
    #[serde(default)]
    pub coulomb_difference_nm: f64,
    /// Viscous friction of the motor that turns with the sum.
    #[serde(default)]
    pub viscous_sum_nm_s_per_rad: f64,
    /// Viscous friction of the motor that turns with the difference.
    #[serde(default)]
    pub viscous_difference_nm_s_per_rad: f64,
}

/// How the Coulomb level varies with position.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WaveEntry {
    /// Amplitude over the mean Coulomb level.
    pub share: f64,
    /// Periods in one turn of the joint.
    pub periods_per_turn: f64,
    /// Phase at position zero.
    #[serde(default)]
    pub phase_rad: f64,
}

/// Friction lost while the drive warms up.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WarmingEntry {
    /// Viscous friction that the warm drive has less than the cold one.
    #[serde(default)]
    pub viscous_lost_nm_s_per_rad: f64,
    /// Coulomb friction that the warm drive has less.
    #[serde(default)]
    pub coulomb_lost_nm: f64,
    /// Time after which 1 - 1/e of that is lost.
    pub time_constant_s: f64,
}

/// A spring or counterweight that balances part of the weight.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CounterbalanceEntry {
    /// Largest torque.
    pub amplitude_nm: f64,
    /// Phase of the torque over position.
    #[serde(default)]
    pub phase_rad: f64,
}

/// Torque that depends on the position of the motor.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RippleEntry {
    /// Amplitude.
    pub amplitude_nm: f64,
    /// Periods in one turn of the joint.
    pub periods_per_turn: f64,
    /// Phase at position zero.
    #[serde(default)]
    pub phase_rad: f64,
}

impl JointEntry {
    /// Applies the entry of joint `name` to the robot.
    pub(crate) fn apply(&self, name: &str, loaded: &mut Loaded) -> Result<(), Misfit> {
        let site = KeyPath::root().key("joint").key(name);
        let index = loaded.joint_index(&site, name)?;
        if let Some(gain) = self.gain(&site)? {
            loaded.control.gains[index] = Some(gain);
        }
        let coupling = self.coupling(&site, index, loaded)?;
        let Some(link) = loaded.robot.link_mut(index) else { return Ok(()) };
        self.actuate(&site, &mut link.actuator)?;
        if link.actuator.counterbalance.is_some() && !link.joint.kind.is_rotation() {
            let found = "counterbalance is at a joint that slides";
            return incomplete(&site, found, "one that turns");
        }
        link.actuator.coupling = coupling.or(link.actuator.coupling);
        if let Some(limit) = self.torque_limit_nm {
            let unknown = limit.is_infinite() && limit > 0.0;
            if !unknown {
                in_range(&site, "torque_limit_nm", limit, Range::Positive)?;
            }
            link.joint.limits.effort = Some(limit).filter(|_| !unknown);
        }
        Ok(())
    }

    fn actuate(&self, site: &KeyPath, actuator: &mut Actuator) -> Result<(), Misfit> {
        let split = self.coulomb_forward_nm.is_some() || self.coulomb_backward_nm.is_some();
        if self.coulomb_nm.is_some() && split {
            let found = "coulomb_nm beside coulomb_forward_nm or coulomb_backward_nm";
            return incomplete(
                site,
                found,
                "either one value for both directions or one per direction",
            );
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
            ("torque_gain", self.torque_gain, Positive, &mut a.torque_gain),
            ("torque_offset_nm", self.torque_offset_nm, Finite, &mut a.torque_offset),
            ("backlash_rad", self.backlash_rad, NotNegative, &mut a.backlash),
            ("load_friction", self.load_friction, NotNegative, &mut a.load_friction),
            ("encoder_offset_rad", self.encoder_offset_rad, Finite, &mut a.encoder_offset),
            ("transmission_ratio", self.transmission_ratio, Positive, &mut a.transmission_ratio),
        ] {
            if let Some(value) = value {
                in_range(site, key, value, range)?;
                *field = value;
            }
        }
        for (key, value, field) in [
            ("elasticity_nm_per_rad", self.elasticity_nm_per_rad, &mut a.elasticity),
            ("presliding_rad", self.presliding_rad, &mut a.presliding),
        ] {
            if let Some(value) = value {
                in_range(site, key, value, Positive)?;
                *field = Some(value);
            }
        }
        self.spring(site, a)?;
        self.dampings(site, a)?;
        self.times(site, a)?;
        a.stribeck = self.stribeck(site)?.or(a.stribeck);
        a.friction_wave = self.wave(site)?.or(a.friction_wave);
        a.warming = self.warming(site, a)?.or(a.warming);
        a.ripple = self.ripple(site)?.or(a.ripple);
        a.counterbalance = self.counterbalance(site)?.or(a.counterbalance);
        a.sensing = self.sensing.unwrap_or(a.sensing);
        a.torque_source = self.torque_source.unwrap_or(a.torque_source);
        Ok(())
    }

    fn spring(&self, site: &KeyPath, a: &mut Actuator) -> Result<(), Misfit> {
        use Range::{Finite, NotNegative};
        for (key, value, range, field) in [
            (
                "spring_stiffness_nm_per_rad",
                self.spring_stiffness_nm_per_rad,
                Finite,
                &mut a.spring_stiffness,
            ),
            ("spring_rest_rad", self.spring_rest_rad, Finite, &mut a.spring_rest),
            (
                "spring_cubic_nm_per_rad3",
                self.spring_cubic_nm_per_rad3,
                Finite,
                &mut a.spring_cubic,
            ),
            (
                "spring_hysteresis_nm",
                self.spring_hysteresis_nm,
                NotNegative,
                &mut a.spring_hysteresis,
            ),
        ] {
            if let Some(value) = value {
                in_range(site, key, value, range)?;
                *field = value;
            }
        }
        if a.spring_hysteresis > 0.0 && a.spring_stiffness <= 0.0 {
            let found = "spring_hysteresis_nm is there without a spring that holds it";
            return incomplete(site, found, "spring_stiffness_nm_per_rad above 0 as well");
        }
        Ok(())
    }

    fn times(&self, site: &KeyPath, a: &mut Actuator) -> Result<(), Misfit> {
        use Range::{Finite, NotNegative};
        for (key, value_ms, range, field) in [
            ("actuator_delay_ms", self.actuator_delay_ms, NotNegative, &mut a.delay_s),
            ("actuator_lag_ms", self.actuator_lag_ms, NotNegative, &mut a.lag_s),
            ("effort_skew_ms", self.effort_skew_ms, Finite, &mut a.effort_skew_s),
            ("goal_delay_ms", self.goal_delay_ms, NotNegative, &mut a.goal_delay_s),
        ] {
            if let Some(value_ms) = value_ms {
                in_range(site, key, value_ms, range)?;
                *field = 1e-3 * value_ms;
            }
        }
        Ok(())
    }

    fn dampings(&self, site: &KeyPath, a: &mut Actuator) -> Result<(), Misfit> {
        if let Some(damping) = self.presliding_damping_nm_s_per_rad {
            if a.presliding.is_none() {
                let found = "presliding_damping_nm_s_per_rad is there alone";
                return incomplete(site, found, "presliding_rad as well");
            }
            in_range(site, "presliding_damping_nm_s_per_rad", damping, Range::NotNegative)?;
            a.presliding_damping = Some(damping);
        }
        let Some(damping) = self.elasticity_damping_nm_s_per_rad else { return Ok(()) };
        if a.elasticity.is_none() {
            let found = "elasticity_damping_nm_s_per_rad is there alone";
            return incomplete(site, found, "elasticity_nm_per_rad as well");
        }
        in_range(site, "elasticity_damping_nm_s_per_rad", damping, Range::Positive)?;
        a.elasticity_damping = Some(damping);
        Ok(())
    }

    fn stribeck(&self, site: &KeyPath) -> Result<Option<Stribeck>, Misfit> {
        let (excess, velocity) = match (self.stribeck_excess_nm, self.stribeck_velocity_rad_per_s) {
            (None, None) => return Ok(None),
            (Some(excess), Some(velocity)) => (excess, velocity),
            (Some(_), None) => {
                return incomplete(
                    site,
                    "stribeck_excess_nm is there alone",
                    "stribeck_velocity_rad_per_s as well",
                );
            }
            (None, Some(_)) => {
                return incomplete(
                    site,
                    "stribeck_velocity_rad_per_s is there alone",
                    "stribeck_excess_nm as well",
                );
            }
        };
        in_range(site, "stribeck_excess_nm", excess, Range::NotNegative)?;
        in_range(site, "stribeck_velocity_rad_per_s", velocity, Range::Positive)?;
        Ok(Some(Stribeck { excess, velocity }))
    }

    fn wave(&self, site: &KeyPath) -> Result<Option<FrictionWave>, Misfit> {
        let Some(WaveEntry { share, periods_per_turn, phase_rad }) = self.friction_wave else {
            return Ok(None);
        };
        in_range(site, "friction_wave.share", share, Range::Share)?;
        in_range(site, "friction_wave.periods_per_turn", periods_per_turn, Range::NotNegative)?;
        in_range(site, "friction_wave.phase_rad", phase_rad, Range::Finite)?;
        Ok(Some(FrictionWave { share, periods: periods_per_turn, phase: phase_rad }))
    }

    fn warming(&self, site: &KeyPath, a: &Actuator) -> Result<Option<Warming>, Misfit> {
        use Range::{NotNegative, Positive};
        let Some(entry) = self.friction_warming else { return Ok(None) };
        let WarmingEntry {
            viscous_lost_nm_s_per_rad: viscous_lost,
            coulomb_lost_nm: coulomb_lost,
            time_constant_s,
        } = entry;
        for (key, value, range) in [
            ("friction_warming.viscous_lost_nm_s_per_rad", viscous_lost, NotNegative),
            ("friction_warming.coulomb_lost_nm", coulomb_lost, NotNegative),
            ("friction_warming.time_constant_s", time_constant_s, Positive),
        ] {
            in_range(site, key, value, range)?;
        }
        let level = a.coulomb_forward.min(a.coulomb_backward);
        if viscous_lost > a.viscous.max(0.0) || coulomb_lost > level.max(0.0) {
            let found = "friction_warming loses more friction than the cold drive has";
            return incomplete(
                site,
                found,
                "viscous_nm_s_per_rad and coulomb_nm at least as large",
            );
        }
        Ok(Some(Warming { viscous_lost, coulomb_lost, time_constant_s }))
    }

    fn ripple(&self, site: &KeyPath) -> Result<Option<Ripple>, Misfit> {
        let Some(RippleEntry { amplitude_nm, periods_per_turn, phase_rad }) = self.torque_ripple
        else {
            return Ok(None);
        };
        in_range(site, "torque_ripple.amplitude_nm", amplitude_nm, Range::NotNegative)?;
        in_range(site, "torque_ripple.periods_per_turn", periods_per_turn, Range::NotNegative)?;
        in_range(site, "torque_ripple.phase_rad", phase_rad, Range::Finite)?;
        Ok(Some(Ripple { amplitude: amplitude_nm, periods: periods_per_turn, phase: phase_rad }))
    }

    fn counterbalance(&self, site: &KeyPath) -> Result<Option<CounterbalanceTerm>, Misfit> {
        let Some(CounterbalanceEntry { amplitude_nm, phase_rad }) = self.counterbalance else {
            return Ok(None);
        };
        in_range(site, "counterbalance.amplitude_nm", amplitude_nm, Range::NotNegative)?;
        in_range(site, "counterbalance.phase_rad", phase_rad, Range::Finite)?;
        Ok(Some(CounterbalanceTerm { amplitude: amplitude_nm, phase: phase_rad }))
    }

    fn coupling(
        &self,
        site: &KeyPath,
        index: usize,
        loaded: &Loaded,
    ) -> Result<Option<Coupling>, Misfit> {
        let Some(entry) = &self.coupling else { return Ok(None) };
        let other = loaded.joint_index(&site.key("coupling").key("with"), &entry.with)?;
        if other == index {
            return incomplete(site, "coupling.with names the joint itself", "another joint");
        }
        in_range(site, "coupling.ratio", entry.ratio, Range::Positive)?;
        let CouplingEntry {
            coulomb_sum_nm,
            coulomb_difference_nm,
            viscous_sum_nm_s_per_rad,
            viscous_difference_nm_s_per_rad,
            ..
        } = *entry;
        for (key, value) in [
            ("coupling.coulomb_sum_nm", coulomb_sum_nm),
            ("coupling.coulomb_difference_nm", coulomb_difference_nm),
            ("coupling.viscous_sum_nm_s_per_rad", viscous_sum_nm_s_per_rad),
            ("coupling.viscous_difference_nm_s_per_rad", viscous_difference_nm_s_per_rad),
        ] {
            in_range(site, key, value, Range::NotNegative)?;
        }
        Ok(Some(Coupling {
            other,
            ratio: entry.ratio,
            level: [coulomb_sum_nm, coulomb_difference_nm],
            viscous: [viscous_sum_nm_s_per_rad, viscous_difference_nm_s_per_rad],
        }))
    }

    fn gain(&self, site: &KeyPath) -> Result<Option<PdGain>, Misfit> {
        match (self.kp_nm_per_rad, self.kd_nm_s_per_rad) {
            (None, None) => Ok(None),
            (Some(kp), Some(kd)) => gain(site, kp, kd).map(Some),
            (Some(_), None) => {
                incomplete(site, "kp_nm_per_rad is there alone", "kd_nm_s_per_rad as well")
            }
            (None, Some(_)) => {
                incomplete(site, "kd_nm_s_per_rad is there alone", "kp_nm_per_rad as well")
            }
        }
    }
}

/// The error for keys that state the same thing twice, or for a key that needs another one.
fn incomplete<T>(site: &KeyPath, found: &str, expected: &str) -> Result<T, Misfit> {
    Err(Misfit::new(site.clone(), format!("{found}, {expected} was expected")))
}

/// A pair of gains, if they can be used.
pub(crate) fn gain(site: &KeyPath, kp: f64, kd: f64) -> Result<PdGain, Misfit> {
    in_range(site, "kp_nm_per_rad", kp, Range::Positive)?;
    in_range(site, "kd_nm_s_per_rad", kd, Range::NotNegative)?;
    Ok(PdGain { kp, kd })
}
