//! Every effect of the catalogue hidden in the simulated arm, its place and size drawn from a seed,
//! and asked for through files; the truth is opened after the answer. Each has a twin: the same arm,
//! seed and motion without it, in which it must not be named.
//!
//! Two runs of 15 s, or of 30 s where bristles bend or a cable drags, are a quarter or half of what
//! blind trials have (`scenarios/campaigns/trials.toml`), which count how often this comes out right.

use std::collections::BTreeMap;
use std::sync::{Mutex, OnceLock};

use benchmark::{Hidden, Trial};
use catalogue::EffectKind;
use checks::arms::workspace_root;
use diagnosis::{EffectAt, Settings, Silent, Verdict};
use experiment::{Blinded, Score, Size};
use logs::{ReadOptions, Run, read_run};
use rayon::prelude::*;
use robot::Robot;

use EffectKind as E;

/// Relative error of a parameter that the columns are linear in, and of one that they are not.
const LINEAR: f64 = 0.05;
const SHAPE: f64 = 0.15;

/// Parameters that shape an effect, rather than scale it; of bristles all but their level do.
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

/// A motion in parts, each of sines.
pub type Parts = [&'static str];

/// What most effects show in.
const SLOW: &Parts = &["terms=3, lowest_hz=0.1, highest_hz=0.5, duration_s=15.0"];

/// As long again: the drag of a cable is a tenth of its torque, which 15 s show to some 20 %.
const LONG: &Parts = &["terms=3, lowest_hz=0.1, highest_hz=0.5, duration_s=30.0"];

/// Fast enough to tell a delay from a lag.
const LIVELY: &Parts = &["terms=4, lowest_hz=0.4, highest_hz=1.5, duration_s=15.0"];

/// Over the range, and then to and fro over some ten times the way that bristles bend.
const DWELLING: &Parts = &[
    "terms=3, lowest_hz=0.1, highest_hz=0.5, duration_s=15.0",
    "terms=3, lowest_hz=0.15, highest_hz=0.4, duration_s=15.0, amplitude_rad={ \
     j1_base_yaw=0.06, j2_shoulder_pitch=0.06, j3_shoulder_yaw=0.06, j4_elbow_pitch=0.06, \
     j5_wrist_yaw=0.06, j6_wrist_pitch=0.06, j7_palm_yaw=0.06 }",
];

/// Twice the step that scenarios have by default, for half the steps. A leapfrog's error in the acceleration of a
/// motion of 1.5 Hz is `(w h)² / 12`, 3e-7 of it.
pub const STEP: &str = "engine.step_ms=0.2";

/// `motion` with the phases of `seed`, in TOML.
fn motion_of(motion: &Parts, seed: u64) -> String {
    let part = |part: &&str| format!("sinusoids={{ seed={seed}, {part} }}");
    match motion {
        [only] => part(only),
        parts => {
            let parts: Vec<String> = parts.iter().map(|p| format!("{{ {} }}", part(p))).collect();
            format!("sequence=[{}]", parts.join(", "))
        }
    }
}

fn trial(hidden: Hidden, seed: u64, motion: &Parts) -> Trial {
    let run = |name: &str, seed: u64| {
        format!("{{ name='{name}', motion={{ {} }} }}", motion_of(motion, seed))
    };
    let mut settings = vec![format!("run=[{}, {}]", run("a", 11), run("b", 12)), STEP.to_owned()];
    if ![SLOW, LONG].contains(&motion) {
        settings.push("hidden.torque_share=[0.2, 0.3]".to_owned());
    }
    let scenario = workspace_root().join("scenarios/demos/no_effects.toml");
    Trial { scenario, hidden, seed, settings, gains: false }
}

fn score(hidden: Hidden, seed: u64) -> Score {
    score_along(hidden, seed, SLOW)
}

pub fn score_along(hidden: Hidden, seed: u64, motion: &Parts) -> Score {
    let folder = tempfile::tempdir().unwrap();
    trial(hidden, seed, motion).make(folder.path()).unwrap();
    let loaded = Robot::load(&folder.path().join("nominal/robot.toml")).unwrap();
    let read = |name: &str| {
        let log = folder.path().join(format!("logs/{name}.parquet"));
        read_run(&log, &loaded.robot, &ReadOptions::default()).unwrap()
    };
    let runs: Vec<Run> = ["a", "b"].map(read).to_vec();
    let without = match hidden {
        Hidden::Unknown(kind) => vec![kind],
        _ => Vec::new(),
    };
    let settings =
        Settings { control_rate_hz: loaded.control.rate_hz, without, ..Settings::default() };
    let answer = diagnosis::diagnose(&loaded.robot, &runs, &settings, &Silent).unwrap();
    let truth = Blinded::open(&folder.path().join("truth")).unwrap();
    let score = Score::new(&answer.diagnosis, &truth.effects, truth.seed);
    println!("{}", score.words());
    for finding in &score.findings {
        let rivals = &finding.not_separable_from;
        let is_again = |(i, rival)| rivals[..i].contains(rival) || *rival == finding.at;
        assert!(!rivals.iter().enumerate().any(is_again), "{}", score.words());
    }
    score
}

/// The arm of `seed` without anything hidden, made once for all the tests that ask for it.
fn twin(seed: u64, motion: &'static Parts) -> &'static Score {
    type Twins = BTreeMap<(u64, &'static Parts), &'static OnceLock<Score>>;
    static TWINS: Mutex<Twins> = Mutex::new(Twins::new());
    let mut twins = TWINS.lock().unwrap();
    let twin = *twins.entry((seed, motion)).or_insert_with(|| Box::leak(Box::default()));
    drop(twins);
    twin.get_or_init(|| score_along(Hidden::Nothing, seed, motion))
}

/// Nothing that is said of the twin of `found` is what was hidden in `found`.
fn check_twin(found: &Score, seed: u64, motion: &'static Parts) {
    let twin = twin(seed, motion);
    assert!(!names(twin).any(|at| *at == found.injected[0].at), "twin: {}", twin.words());
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
fn check(kind: EffectKind, seed: u64, name: Name, motion: &'static Parts) {
    let found = score_along(Hidden::One(kind), seed, motion);
    assert!(found.as_one_of && (name == Name::OneOf || found.exactly), "{}", found.words());
    check_sizes(&found);
    check_twin(&found, seed, motion);
}

fn check_sizes(found: &Score) {
    for injected in &found.injected {
        for size in &injected.sizes {
            let Some(estimate) = size.estimate.as_ref().filter(|e| e.determined) else { continue };
            let Some(error) = estimate.relative_error else { continue };
            println!("  {} {:.4}: {:.4}, {error:.3} off", size.name, size.truth, estimate.value);
            let shapes = SHAPES.contains(&size.name.as_str());
            let is_bent = injected.at.effect == E::PreslidingFriction && size.name != "level";
            let most = if shapes || is_bent { SHAPE } else { LINEAR };
            assert!(error < most, "{} {size:?}", injected.at.words());
        }
    }
}

/// Whether the truth is in the interval of noise: nothing else is wrong with the arm.
fn is_held(size: &Size) -> bool {
    let noise95 = size.estimate.as_ref().and_then(|estimate| estimate.noise95);
    noise95.is_some_and(|[low, high]| (low..=high).contains(&size.truth))
}

macro_rules! hidden {
    ($($test:ident: $kind:expr, $seed:expr, $name:expr, $motion:expr;)*) => {
        /// The effects that are hidden, one a test.
        pub const HIDDEN: &[EffectKind] = &[$($kind),*];

        $(#[test]
        fn $test() {
            check($kind, $seed, $name, $motion);
        })*
    };
}

hidden! {
    hidden_viscous_friction: E::ViscousFriction, 1, Name::First, SLOW;
    hidden_coulomb_friction: E::CoulombFriction, 1, Name::First, SLOW;
    hidden_asymmetric_friction: E::AsymmetricFriction, 1, Name::First, SLOW;
    hidden_stribeck_friction: E::StribeckFriction, 1, Name::OneOf, SLOW;
    hidden_presliding_friction: E::PreslidingFriction, 1, Name::First, DWELLING;
    hidden_load_dependent_friction: E::LoadDependentFriction, 1, Name::First, SLOW;
    hidden_position_dependent_friction: E::PositionDependentFriction, 101, Name::First, SLOW;
    hidden_payload: E::Payload, 2, Name::OneOf, SLOW;
    hidden_inertial_parameters: E::InertialParameters, 2, Name::First, SLOW;
    hidden_rotor_inertia: E::RotorInertia, 1, Name::First, SLOW;
    hidden_torque_ripple: E::TorqueRipple, 1, Name::First, SLOW;
    hidden_torque_constant: E::TorqueConstant, 1, Name::First, SLOW;
    hidden_torque_offset: E::TorqueOffset, 1, Name::First, SLOW;
    hidden_actuator_lag: E::ActuatorLag, 101, Name::OneOf, SLOW;
    hidden_actuator_delay: E::ActuatorDelay, 101, Name::OneOf, SLOW;
    hidden_backlash: E::Backlash, 1, Name::First, SLOW;
    hidden_joint_elasticity: E::JointElasticity, 1, Name::First, SLOW;
    hidden_differential_coupling: E::DifferentialCoupling, 1, Name::First, SLOW;
    hidden_transmission_ratio: E::TransmissionRatio, 1, Name::First, SLOW;
    hidden_gravity_direction: E::GravityDirection, 2, Name::First, SLOW;
    hidden_cable_spring: E::CableSpring, 1, Name::First, LONG;
    hidden_external_disturbance: E::ExternalDisturbance, 1, Name::First, SLOW;
    hidden_encoder_offset: E::EncoderOffset, 1, Name::First, SLOW;
    hidden_time_skew: E::TimeSkew, 1, Name::First, SLOW;
}

/// In half that time it is named as well, with sizes that their intervals hold.
#[test]
fn hidden_cable_springs_are_named_in_short_logs() {
    let found = score(Hidden::One(E::CableSpring), 1);
    assert!(found.exactly, "{}", found.words());
    for size in &found.injected[0].sizes {
        let Some(estimate) = &size.estimate else { continue };
        assert!(!estimate.determined || is_held(size), "{estimate:?}");
    }
    check_twin(&found, 1, SLOW);
}

#[test]
fn hidden_pairs_are_both_found() {
    let pairs = [(E::CoulombFriction, E::Payload, 4), (E::TorqueOffset, E::ViscousFriction, 4)];
    for (a, b, seed) in pairs {
        let found = score(Hidden::Two(a, b), seed);
        assert!(found.as_one_of && found.stray.is_empty(), "{}", found.words());
        check_sizes(&found);
    }
}

/// In columns about the robot without either the two are one.
#[test]
fn hidden_delays_are_told_from_lags_in_lively_motions() {
    let found = score_along(Hidden::One(E::ActuatorDelay), 1, LIVELY);
    assert!(found.exactly, "{}", found.words());
    assert!(!names(&found).any(|at| at.effect == E::ActuatorLag), "{}", found.words());
    check_sizes(&found);
}

/// Where a joint turns, its direction is not known, and its friction is as large as around it.
#[test]
fn hidden_coulomb_friction_is_not_taken_for_one_that_grows_towards_rest() {
    for seed in [1, 2, 3, 4] {
        let found = score_along(Hidden::One(E::CoulombFriction), seed, DWELLING);
        assert!(found.exactly && found.stray.is_empty(), "{}", found.words());
        let level = found.injected[0].sizes[0].estimate.as_ref().unwrap();
        assert!(level.relative_error.unwrap() < 0.02, "{level:?}");
    }
}

/// Links whose motion is not far below where they ring on their springs.
#[test]
fn hidden_springs_swing() {
    for seed in [1, 2] {
        let found = score_along(Hidden::One(E::JointElasticity), seed, LIVELY);
        assert!(found.exactly && found.stray.is_empty(), "{}", found.words());
        check_sizes(&found);
    }
}

/// Gaps that a link takes tenths of a second to cross, and narrow ones: the time goes with the third
/// root of the gap, so that the effort of the one is of no use in finding the other.
#[test]
fn hidden_plays_are_as_wide_as_they_are() {
    for seed in [1, 2, 3] {
        let found = score_along(Hidden::One(E::Backlash), seed, LIVELY);
        if found.injected[0].of_smallest.is_some_and(|times| times < 2.0) {
            continue;
        }
        assert!(found.exactly, "{}", found.words());
        let gap = found.injected[0].sizes[0].estimate.as_ref().unwrap();
        assert!(gap.relative_error.unwrap() < 0.05, "{gap:?}");
    }
}

/// Its frequency lies in the band of the motion.
#[test]
fn hidden_slow_disturbances_are_told_from_the_motion() {
    for seed in [1, 2] {
        let found = score_along(Hidden::One(E::ExternalDisturbance), seed, LIVELY);
        assert!(found.exactly, "{}", found.words());
        check_sizes(&found);
    }
}

/// What a tone adds to an effort is all of it, of a size that its interval holds: no lag, rotor or
/// friction has a part in it, be it in the band of the motion or far above.
#[test]
fn hidden_tones_are_whole() {
    let kinds = [E::TorqueRipple, E::ExternalDisturbance];
    let trials: Vec<_> =
        kinds.into_iter().flat_map(|kind| [15, 16, 17, 18].map(|seed| (kind, seed))).collect();
    let score = |(kind, seed)| score_along(Hidden::One(kind), seed, LIVELY);
    let all: Vec<Score> = trials.into_par_iter().map(score).collect();
    let (mut intervals, mut hold) = (0, 0);
    for found in &all {
        assert!(found.exactly && found.stray.is_empty(), "{}", found.words());
        let sizes = found.injected[0].sizes.iter();
        for (size, estimate) in sizes.filter_map(|s| s.estimate.as_ref().map(|e| (s, e))) {
            println!("  {} {:.5}: {:?}", size.name, size.truth, estimate.noise95);
            intervals += 1;
            hold += usize::from(is_held(size));
        }
    }
    // Of 24 that hold with probability 0.95 fewer than 20 do with 0.006.
    assert!(6 * hold >= 5 * intervals, "{hold} of {intervals}");
}

#[test]
fn hidden_nothing_is_called_consistent() {
    for seed in 1..=2 {
        let clean = twin(seed, SLOW);
        assert!(clean.exactly && clean.verdict == Verdict::Consistent, "{}", clean.words());
    }
}

/// A ripple is faster than what the other effects explain, and leaves them alone.
#[test]
fn hidden_effects_without_a_name_get_no_wrong_one() {
    for (kind, seed) in [(E::TorqueRipple, 1), (E::ExternalDisturbance, 1)] {
        let found = score(Hidden::Unknown(kind), seed);
        assert!(!found.is_found() && found.stray.is_empty(), "{}", found.words());
    }
}
