//! Recorded logs as workshops take them: joint by joint, with coarse encoders, with dropouts.

use std::f64::consts::TAU;
use std::path::Path;

use catalogue::EffectKind as E;
use checks::recorded::folder;
use checks::synthetic::wam;
use diagnosis::{Diagnosis, Settings, Silent, Verdict, diagnose};
use dynamics::Dynamics;
use logs::{Channels, ReadOptions, Run, read_run};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use robot::Robot;

use crate::world::{named, sign};

fn diagnosis(folder: &Path, runs: &[&str]) -> Diagnosis {
    let robot =
        ["robot.toml", "robot.urdf"].map(|f| folder.join(f)).into_iter().find(|f| f.exists());
    let robot = Robot::load(&robot.unwrap()).unwrap().robot;
    let options = ReadOptions::default();
    let read = |run: &&str| read_run(&folder.join(format!("{run}.parquet")), &robot, &options);
    let runs: Vec<Run> = runs.iter().map(read).collect::<Result<_, _>>().unwrap();
    diagnose(&robot, &runs, &Settings::default(), &Silent).unwrap().diagnosis
}

/// Level of dry friction that is named at each joint (N m), whatever its form; zero where none is.
fn levels(answer: &Diagnosis) -> Vec<f64> {
    let level = |joint: &str| {
        let here = answer.findings.iter().filter(|f| f.at.joint.as_deref() == Some(joint));
        let dry = here.flat_map(|f| &f.parameters).filter(|p| {
            matches!(p.name, "level" | "forward" | "backward" | "coulomb") && p.determined
        });
        let all: Vec<f64> = dry.map(|p| p.value).collect();
        all.iter().sum::<f64>() / all.len().max(1) as f64
    };
    answer.joints.iter().map(|j| level(&j.name)).collect()
}

fn within(found: &[f64], published: &[f64], share: f64) {
    for (found, published) in found.iter().zip(published) {
        assert!((found / published - 1.0).abs() < share, "{found} N m, published {published}");
    }
}

fn kinds(answer: &Diagnosis) -> Vec<E> {
    answer.findings.iter().map(|f| f.at.effect).collect()
}

/// Six logs, in each of which one joint moves. The published fit of the same logs has friction of 12.5,
/// 13.3, 5.0, 2.0, 2.7 and 2.3 N m.
#[test]
fn recorded_ur10e_has_friction_at_every_joint_though_each_moves_in_one_log_alone() {
    let Some(folder) = folder() else { return };
    let runs = ["joint_1", "joint_2", "joint_3", "joint_4", "joint_5", "joint_6"];
    let answer = diagnosis(&folder.join("ur10e_joint_by_joint"), &runs);
    let levels = levels(&answer);
    let gain = &answer.gain.inverse;
    println!("levels {levels:?}, held out {:?} for {:?}", gain.rms_after_nm, gain.rms_before_nm);
    within(&levels, &[12.5, 13.3, 5.0, 2.0, 2.7, 2.3], 0.25);
    let invented = [E::CableSpring, E::JointElasticity, E::DifferentialCoupling];
    assert!(!kinds(&answer).iter().any(|kind| invented.contains(kind)), "{:?}", kinds(&answer));
    let norm = |rms: &[f64]| rms.iter().map(|r| r * r).sum::<f64>().sqrt();
    assert!(norm(&gain.rms_after_nm) < 0.45 * norm(&gain.rms_before_nm));
    for (after, before) in gain.rms_after_nm.iter().zip(&gain.rms_before_nm) {
        assert!(after <= before, "{after} N m after {before}");
    }
}

/// An encoder of 2.9 mrad. Published friction is .16 to .21 N m.
#[test]
fn recorded_pendulum_has_friction_and_no_play_though_its_encoder_is_coarse() {
    let Some(folder) = folder() else { return };
    let folder = folder.join("dfki_pendulum");
    let answer = diagnosis(&folder, &["ddp"]);
    println!("levels {:?}, nMSE {:?}", levels(&answer), answer.gain.inverse.nmse_after);
    within(&levels(&answer), &[0.165], 0.3);
    assert!(answer.gain.inverse.nmse_after[0] < 0.013);
    for runs in [&["ddp", "direct_collocation", "pd"][..], &["gravity_compensation"]] {
        let answer = diagnosis(&folder, runs);
        println!("{runs:?}: {:?} {:?}", answer.verdict, kinds(&answer));
        assert!(!kinds(&answer).contains(&E::Backlash));
        assert_ne!(answer.verdict, Verdict::Explained);
    }
    // The arm was led by a hand, whose force is in no effort.
    assert_eq!(kinds(&diagnosis(&folder, &["gravity_compensation"])), []);
}

/// One log, in which the joints of an arm move one after the other, out and back, in 3 s each; what holds them
/// at rest is balance and friction within its level, of which the log shows nothing.
fn one_after_the_other(level: f64) -> Run {
    let joints = wam().joint_count();
    // q = A / 2 (1 - cos x) sin(2 x), one turn of x in 2.4 s, after .3 s of rest.
    let state = |j: usize, t: f64| -> [f64; 3] {
        let (s, w) = ((t - 3.0 * j as f64 - 0.3) / 2.4, TAU / 2.4);
        if !(0.0..=1.0).contains(&s) {
            return [0.3, 0.0, 0.0];
        }
        let ([one, two], half) = ([TAU * s, 2.0 * TAU * s].map(f64::sin_cos), 0.5 * 0.6);
        let swell = 1.0 - one.1;
        let slope = one.0 * two.0 + 2.0 * swell * two.1;
        let bend = one.1 * two.0 + 4.0 * one.0 * two.1 - 4.0 * swell * two.0;
        [0.3 + half * swell * two.0, half * w * slope, half * w * w * bend]
    };
    logged("one after the other", 3.0 * joints as f64, state, |_, qd| level * sign(qd))
}

/// A log of the WAM in which joint `j` is in `state(j, t)` at time `t` (s), and is held by a torque of
/// `friction(t, qd)`.
fn logged(
    name: &str,
    seconds: f64,
    state: impl Fn(usize, f64) -> [f64; 3],
    friction: impl Fn(f64, f64) -> f64,
) -> Run {
    const RATE_HZ: f64 = 250.0;
    let robot = wam();
    let joints = robot.joint_count();
    let time: Vec<f64> = (0..(seconds * RATE_HZ) as usize).map(|k| k as f64 / RATE_HZ).collect();
    let dynamics = Dynamics::new(&robot);
    let mut noise = ChaCha8Rng::seed_from_u64(5);
    let mut efforts = vec![Vec::new(); joints];
    for t in &time {
        let states: Vec<[f64; 3]> = (0..joints).map(|j| state(j, *t)).collect();
        let of = |k: usize| states.iter().map(|s| s[k]).collect::<Vec<f64>>();
        let torque = dynamics.inverse_dynamics(&of(0), &of(1), &of(2)).unwrap();
        for (j, effort) in efforts.iter_mut().enumerate() {
            let [_, qd, qdd] = states[j];
            let drive = robot.links()[j].actuator.rotor_inertia * qdd + friction(*t, qd);
            effort.push(torque[j] + drive + noise.random_range(-0.02..0.02));
        }
    }
    let channels = |(j, effort): (usize, Vec<f64>)| Channels {
        name: robot.joint_names().nth(j).unwrap().to_owned(),
        position: time.iter().map(|t| state(j, *t)[0]).collect(),
        effort,
        ..Channels::default()
    };
    Run {
        name: name.to_owned(),
        source: Default::default(),
        sha256: String::new(),
        is_torn: false,
        mended: Vec::new(),
        joints: efforts.into_iter().enumerate().map(channels).collect(),
        time,
        extra: Default::default(),
    }
}

/// Every joint moves in a seventh of the log, and most of them in one fifth of it alone.
#[test]
fn joints_that_move_one_after_the_other_in_one_log_are_each_found_to_rub() {
    let answer = diagnose(&wam(), &[one_after_the_other(0.6)], &Settings::default(), &Silent)
        .unwrap()
        .diagnosis;
    println!("{:?}", named(&answer));
    within(&levels(&answer), &[0.6; 7], 0.25);
}

/// The elbow moves for a quarter of every second and stands for the rest, held by anything between its level one
/// way and the other: of 40 s it tells of friction in strokes alone, each as long as the low-pass carries
/// from the stands beside it.
#[test]
fn short_strokes_between_stands_tell_of_friction() {
    const LEVEL: f64 = 0.8;
    const STROKE_S: f64 = 0.25;
    // q = A (x - sin x) / 2 pi, there and back, x one turn in a stroke.
    let state = |j: usize, t: f64| -> [f64; 3] {
        let (stroke, s) = (t.floor(), (t.fract() / STROKE_S).min(1.0));
        let way = if stroke % 2.0 == 0.0 { 1.0 } else { -1.0 };
        if j != 3 {
            return [0.3, 0.0, 0.0];
        }
        let (x, w) = (TAU * s, TAU / STROKE_S);
        let (from, along) = (if way > 0.0 { 0.5 } else { 1.1 }, 0.6 * way / TAU);
        let moves = f64::from(u8::from(s < 1.0));
        [
            from + along * (x - x.sin()),
            moves * along * w * (1.0 - x.cos()),
            moves * along * w * w * x.sin(),
        ]
    };
    // The golden ratio fills -1 to 1 evenly, stand by stand.
    let held = |t: f64| 2.0 * (t.floor() * 0.618_034).fract() - 1.0;
    let friction = |t: f64, qd: f64| LEVEL * if qd == 0.0 { held(t) } else { sign(qd) };
    let run = logged("strokes", 40.0, state, friction);
    let settings = Settings { cutoff_hz: Some(3.0), ..Settings::default() };
    let answer = diagnose(&wam(), &[run], &settings, &Silent).unwrap().diagnosis;
    println!("{:?} {:?}", named(&answer), levels(&answer));
    within(&levels(&answer)[3..4], &[LEVEL], 0.04);
    assert_eq!(named(&answer), ["FR02 Coulomb friction at j4_elbow_pitch"]);
}
