//! Motions that show little: what is named in their logs is what was hidden, or is said to be what it
//! may as well be.

use benchmark::Hidden;
use catalogue::EffectKind as E;
use diagnosis::EffectAt;
use experiment::Score;

use crate::hidden::{Parts, score_along};

/// One frequency: positions and accelerations are one but for a factor there.
const TONE: &Parts = &["terms=1, lowest_hz=0.2, highest_hz=0.2, duration_s=15.0"];

/// About one posture: gravity is a constant, and a gap never opens.
const POSTURE: &Parts = &["terms=3, lowest_hz=0.15, highest_hz=0.4, duration_s=15.0, \
    amplitude_rad={ j1_base_yaw=0.06, j2_shoulder_pitch=0.06, j3_shoulder_yaw=0.06, \
    j4_elbow_pitch=0.06, j5_wrist_yaw=0.06, j6_wrist_pitch=0.06, j7_palm_yaw=0.06 }"];

/// Findings, in words, that are not what was hidden and are not said to be it perhaps.
fn wrong(score: &Score) -> Vec<String> {
    let is_hidden = |at: &EffectAt| score.injected.iter().any(|injected| injected.at == *at);
    let findings = score.findings.iter();
    let wrong =
        findings.filter(|f| !is_hidden(&f.at) && !f.not_separable_from.iter().any(is_hidden));
    wrong.map(|finding| finding.at.words()).collect()
}

/// Kinds of which something is named wrongly.
fn wrongly_named(kinds: &[E], motion: &Parts) -> Vec<(E, Vec<String>)> {
    let of = |&kind: &E| {
        let wrong = wrong(&score_along(Hidden::One(kind), 31, motion));
        (!wrong.is_empty()).then_some((kind, wrong))
    };
    kinds.iter().filter_map(of).collect()
}

const KINDS: [E; 10] = [
    E::ViscousFriction,
    E::CoulombFriction,
    E::LoadDependentFriction,
    E::PositionDependentFriction,
    E::Payload,
    E::RotorInertia,
    E::TorqueOffset,
    E::GravityDirection,
    E::CableSpring,
    E::EncoderOffset,
];

#[test]
fn blind_nothing_else_is_named_in_logs_of_one_frequency() {
    let kinds = [&KINDS[..], &[E::ActuatorDelay, E::Backlash]].concat();
    let wrong = wrongly_named(&kinds, TONE);
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// Without delays: one that is a fifth of the torque of so slow a motion makes the arm shake.
#[test]
fn blind_nothing_else_is_named_in_logs_about_one_posture() {
    let wrong = wrongly_named(&KINDS, POSTURE);
    assert!(wrong.is_empty(), "{wrong:?}");
}
