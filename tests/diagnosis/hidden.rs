//! Every effect of the catalogue hidden in the simulated arm, its place and size drawn from a seed,
//! and asked for through files; the truth is opened after the answer. Each has a twin: the same arm,
//! seed and motion without it, in which it must not be named.
//!
//! Two runs of 15 s are a quarter of what blind trials have (`scenarios/trials.toml`), which count how
//! often this comes out right.

use catalogue::EffectKind;
use checks::arms::workspace_root;
use diagnosis::{EffectAt, Verdict};
use evaluation::{Hidden, Score, Trial};

use EffectKind as E;

/// Relative error of a parameter that the columns are linear in, and of one that they are not.
const LINEAR: f64 = 0.05;
const SHAPE: f64 = 0.15;

/// Parameters that shape an effect, rather than scale it.
const SHAPES: [&str; 9] = [
    "stribeck_velocity",
    "periods_per_turn",
    "share",
    "frequency",
    "ratio",
    "rest",
    "gap",
    "cubic",
    "hysteresis",
];

/// Bristles in motions that hardly dwell near rest.
const BRISTLES: f64 = 0.5;

/// Motions slow enough for a spring to give way as if it were at rest.
const SLOW: &str = "terms=3, lowest_hz=0.1, highest_hz=0.5, duration_s=15.0";

/// Motions fast enough to tell a delay from a lag.
const LIVELY: &str = "terms=4, lowest_hz=0.4, highest_hz=1.5, duration_s=15.0";

fn trial(hidden: Hidden, seed: u64, motion: &str) -> Trial {
    let run = |name: &str, seed: u64| {
        format!("{{ name='{name}', motion={{ sinusoids={{ seed={seed}, {motion} }} }} }}")
    };
    let mut settings = vec![format!("run=[{}, {}]", run("a", 11), run("b", 12))];
    if motion == LIVELY {
        settings.push("hidden.torque_share=[0.2, 0.3]".to_owned());
    }
    Trial { scenario: workspace_root().join("scenarios/clean.toml"), hidden, seed, settings }
}

fn score(hidden: Hidden, seed: u64) -> Score {
    score_along(hidden, seed, SLOW)
}

fn score_along(hidden: Hidden, seed: u64, motion: &str) -> Score {
    let folder = tempfile::tempdir().unwrap();
    let score = trial(hidden, seed, motion).run(folder.path()).unwrap();
    println!("{}", score.words());
    score
}

/// Everything that a diagnosis names, and what it may as well be.
fn names(score: &Score) -> impl Iterator<Item = &EffectAt> {
    score.findings.iter().flat_map(|f| std::iter::once(&f.at).chain(&f.not_separable_from))
}

/// How precisely it must be named.
#[derive(Clone, Copy, PartialEq)]
enum Name {
    /// The largest finding is it.
    First,
    /// Or the largest finding may as well be it: these motions do not tell the two apart.
    OneOf,
}

/// The effect is named, each determined size is right, and its twin is not accused of it.
fn check(kind: EffectKind, seed: u64, name: Name, loose: &[(&str, f64)]) {
    let found = score(Hidden::One(kind), seed);
    assert!(found.as_one_of && (name == Name::OneOf || found.exactly), "{}", found.words());
    check_sizes(&found, loose);
    let twin = score(Hidden::Nothing, seed);
    assert!(!names(&twin).any(|at| *at == found.put_in[0].at), "twin: {}", twin.words());
}

fn check_sizes(found: &Score, loose: &[(&str, f64)]) {
    for put_in in &found.put_in {
        for size in &put_in.sizes {
            let Some(estimate) = size.estimate.as_ref().filter(|e| e.determined) else { continue };
            let Some(error) = estimate.relative_error else { continue };
            println!("  {} {:.4}: {:.4}, {error:.3} off", size.name, size.truth, estimate.value);
            let own = loose.iter().find(|(name, _)| *name == size.name).map(|(_, most)| *most);
            let usual = if SHAPES.contains(&size.name.as_str()) { SHAPE } else { LINEAR };
            assert!(error < own.unwrap_or(usual), "{} {size:?}", put_in.at.words());
        }
    }
}

macro_rules! hidden {
    ($($test:ident: $kind:expr, $seed:expr, $name:expr, $loose:expr;)*) => {
        /// The effects that are hidden, one a test.
        pub const HIDDEN: &[EffectKind] = &[$($kind),*];

        $(#[test]
        fn $test() {
            check($kind, $seed, $name, &$loose);
        })*
    };
}

hidden! {
    hidden_viscous_friction: E::ViscousFriction, 1, Name::First, [];
    hidden_coulomb_friction: E::CoulombFriction, 1, Name::First, [];
    hidden_asymmetric_friction: E::AsymmetricFriction, 1, Name::First, [];
    hidden_stribeck_friction: E::StribeckFriction, 1, Name::OneOf, [];
    hidden_presliding_friction: E::PreslidingFriction, 101, Name::OneOf, [("stiffness", BRISTLES)];
    hidden_load_dependent_friction: E::LoadDependentFriction, 1, Name::First, [];
    hidden_position_dependent_friction: E::PositionDependentFriction, 101, Name::First, [];
    hidden_payload: E::Payload, 2, Name::OneOf, [];
    hidden_inertial_parameters: E::InertialParameters, 2, Name::First, [];
    hidden_rotor_inertia: E::RotorInertia, 1, Name::First, [];
    hidden_torque_ripple: E::TorqueRipple, 1, Name::First, [];
    hidden_torque_constant: E::TorqueConstant, 1, Name::First, [];
    hidden_torque_offset: E::TorqueOffset, 1, Name::First, [];
    hidden_actuator_lag: E::ActuatorLag, 101, Name::OneOf, [];
    hidden_actuator_delay: E::ActuatorDelay, 101, Name::OneOf, [];
    hidden_backlash: E::Backlash, 1, Name::First, [];
    hidden_joint_elasticity: E::JointElasticity, 1, Name::First, [];
    hidden_differential_coupling: E::DifferentialCoupling, 1, Name::First, [];
    hidden_transmission_ratio: E::TransmissionRatio, 1, Name::First, [];
    hidden_gravity_direction: E::GravityDirection, 2, Name::First, [];
    hidden_cable_spring: E::CableSpring, 1, Name::First, [];
    hidden_external_disturbance: E::ExternalDisturbance, 1, Name::First, [];
    hidden_encoder_offset: E::EncoderOffset, 1, Name::First, [];
    hidden_time_skew: E::TimeSkew, 1, Name::First, [];
}

#[test]
fn hidden_pairs_are_both_found() {
    let pairs = [(E::CoulombFriction, E::Payload, 4), (E::TorqueOffset, E::ViscousFriction, 4)];
    for (a, b, seed) in pairs {
        let found = score(Hidden::Two(a, b), seed);
        assert!(found.as_one_of && found.stray.is_empty(), "{}", found.words());
        check_sizes(&found, &[]);
    }
}

/// In columns about the robot without either the two are one.
#[test]
fn hidden_delays_are_told_from_lags_in_lively_motions() {
    let found = score_along(Hidden::One(E::ActuatorDelay), 1, LIVELY);
    assert!(found.exactly, "{}", found.words());
    assert!(!names(&found).any(|at| at.effect == E::ActuatorLag), "{}", found.words());
    check_sizes(&found, &[]);
}

/// Its frequency lies in the band of the motion.
#[test]
fn hidden_slow_disturbances_are_told_from_the_motion() {
    for seed in [1, 2] {
        let found = score_along(Hidden::One(E::ExternalDisturbance), seed, LIVELY);
        assert!(found.exactly, "{}", found.words());
        check_sizes(&found, &[]);
    }
}

#[test]
fn hidden_nothing_is_called_consistent() {
    for seed in 1..=2 {
        let clean = score(Hidden::Nothing, seed);
        assert!(clean.exactly && clean.verdict == Verdict::Consistent, "{}", clean.words());
    }
}

/// A ripple is faster than what the other effects explain, and leaves them alone.
#[test]
fn hidden_effects_without_a_name_get_no_wrong_one() {
    for (kind, seed) in [(E::TorqueRipple, 1), (E::ExternalDisturbance, 1)] {
        let found = score(Hidden::Unknown(kind), seed);
        assert!(!found.found() && found.stray.is_empty(), "{}", found.words());
    }
}
