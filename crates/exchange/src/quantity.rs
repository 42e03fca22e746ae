use robot::{Actuator, Link, PdGain, Robot};

use crate::numbers::{milliseconds, size};

/// A property of a drive that an ideal drive lacks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DriveQuantity {
    /// Inertia of the rotor.
    Rotor,
    /// Viscous friction.
    Viscous,
    /// Dry friction, the mean of both directions.
    Coulomb,
    /// Half the difference of its two directions.
    Asymmetry,
    /// Dry friction near rest.
    Stribeck,
    /// Friction per load.
    LoadFriction,
    /// Displacement over which dry friction builds up.
    Presliding,
    /// Friction over position.
    FrictionWave,
    /// Friction lost while the drive warms up.
    Warming,
    /// Torque over position.
    Ripple,
    /// Motors that two joints share.
    Coupling,
    /// Linear spring along the joint.
    Spring,
    /// Its cubic part.
    SpringCubic,
    /// Its loop.
    SpringHysteresis,
    /// Spring or counterweight that balances part of the weight.
    Counterbalance,
    /// Reported effort per torque.
    EffortGain,
    /// Effort at no torque.
    EffortOffset,
    /// Play.
    Backlash,
    /// Stiffness of the transmission.
    Elasticity,
    /// Time from command to torque.
    Delay,
    /// Lag of the torque.
    Lag,
    /// Position reported at zero.
    EncoderOffset,
    /// True over reported position.
    Ratio,
    /// Effort later than position in the log.
    Skew,
    /// Goals that reach the position loop late.
    GoalDelay,
    /// Gains of the position loop.
    Loop,
    /// Time for which a goal is held.
    GoalHold,
}

/// Half the sum and half the difference of the levels in both directions.
///
/// ```text
/// friction = -(mean sign(qd) + difference)
/// ```
pub fn levels(a: &Actuator) -> (f64, f64) {
    (0.5 * (a.coulomb_forward + a.coulomb_backward), 0.5 * (a.coulomb_forward - a.coulomb_backward))
}

/// Every property in which the drive of a link differs from an ideal one, with its size in words.
pub fn quantities(robot: &Robot, link: &Link) -> Vec<(DriveQuantity, String)> {
    use DriveQuantity as Q;
    let a = &link.actuator;
    let rotates = link.joint.kind.is_rotation();
    let [nm, rad, kg] = if rotates { ["N·m", "rad", "kg·m²"] } else { ["N", "m", "kg"] };
    let (mean, difference) = levels(a);
    let mut list: Vec<(DriveQuantity, String)> = vec![];
    let mut add = |quantity, value: f64, ideal: f64, words: &str, unit: &str| {
        if (value - ideal).abs() > 0.0 {
            list.push((quantity, format!("{words} {} {unit}", size(value)).trim_end().to_owned()));
        }
    };
    add(Q::Rotor, a.rotor_inertia, 0.0, "rotor inertia", kg);
    add(Q::Viscous, a.viscous, 0.0, "viscous friction", &format!("{nm}·s/{rad}"));
    add(Q::Coulomb, mean, 0.0, "Coulomb friction", nm);
    add(Q::Asymmetry, difference, 0.0, "difference of its directions, half", nm);
    let stribeck = a.stribeck.map_or(0.0, |s| s.excess);
    add(Q::Stribeck, stribeck, 0.0, "Stribeck friction", nm);
    add(Q::LoadFriction, a.load_friction, 0.0, "friction per load", "");
    add(Q::Presliding, a.presliding.unwrap_or(0.0), 0.0, "presliding over", rad);
    add(Q::FrictionWave, a.friction_wave.map_or(0.0, |w| w.share), 0.0, "friction wave", "");
    let lost = a.warming.map_or(0.0, |w| w.coulomb_lost + w.viscous_lost);
    add(Q::Warming, lost, 0.0, "friction lost in a warm drive at 1 rad/s", nm);
    add(Q::Ripple, a.ripple.map_or(0.0, |r| r.amplitude), 0.0, "torque ripple", nm);
    add(Q::Spring, a.spring_stiffness, 0.0, "spring", &format!("{nm}/{rad}"));
    add(Q::SpringCubic, a.spring_cubic, 0.0, "spring, cubic", &format!("{nm}/{rad}³"));
    add(Q::SpringHysteresis, a.spring_hysteresis, 0.0, "hysteresis of the spring", nm);
    add(
        Q::Counterbalance,
        a.counterbalance.map_or(0.0, |c| c.amplitude),
        0.0,
        "counterbalance",
        nm,
    );
    add(Q::EffortGain, a.torque_gain, 1.0, "effort per torque", "");
    add(Q::EffortOffset, a.torque_offset, 0.0, "effort at no torque", nm);
    add(Q::Backlash, a.backlash, 0.0, "play", rad);
    add(Q::Elasticity, a.elasticity.unwrap_or(0.0), 0.0, "stiffness", &format!("{nm}/{rad}"));
    add(Q::Delay, milliseconds(a.delay_s), 0.0, "delay", "ms");
    add(Q::Lag, milliseconds(a.lag_s), 0.0, "lag", "ms");
    add(Q::EncoderOffset, a.encoder_offset, 0.0, "encoder offset", rad);
    add(Q::Ratio, a.transmission_ratio, 1.0, "true over reported position", "");
    add(Q::Skew, milliseconds(a.effort_skew_s), 0.0, "effort late by", "ms");
    add(Q::GoalDelay, milliseconds(a.goal_delay_s), 0.0, "goals late by", "ms");
    if let Some(PdGain { kp, kd }) = a.position_loop {
        let what = format!("position loop {} {nm}/{rad}, {} {nm}·s/{rad}", size(kp), size(kd));
        list.push((Q::Loop, what));
        if let Some(hold_s) = a.goal_hold_s {
            list.push((Q::GoalHold, format!("goals held for {} ms", size(milliseconds(hold_s)))));
        }
    }
    if let Some(coupling) = a.coupling {
        let other = robot.joint_names().nth(coupling.other).unwrap_or_default();
        list.push((Q::Coupling, format!("friction of motors shared with {other}")));
    }
    list
}
