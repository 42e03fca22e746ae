//! Arms on their benches: what is drawn could stand in a workshop, and moves as it is asked to.

use std::collections::BTreeSet;
use std::path::Path;

use document::Document;
use motion::State;
use population::{ArmClass, BenchWishes, EffortClass, LabBench, MotionClass, draw_bench};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use robot::{Loaded, Robot};
use simulator::scenario::{RunSpec, Scenario, ScenarioSpec};
use simulator::simulate;

const SEEDS: u64 = 40;

fn wishes(classes: &[ArmClass], motions: &[MotionClass]) -> BenchWishes {
    BenchWishes {
        classes: classes.to_vec(),
        motions: motions.to_vec(),
        logs: [1, 8],
        log_s: [5.0, 60.0],
        instruments: None,
    }
}

fn bench(class: ArmClass, seed: u64) -> LabBench {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    draw_bench(&wishes(&[class], MotionClass::ALL), &mut random).unwrap()
}

fn loaded(files: &population::RobotFiles) -> Loaded {
    let folder = tempfile::tempdir().unwrap();
    Robot::load(&files.write(folder.path()).unwrap()).unwrap()
}

fn all(bench: &LabBench) -> impl Iterator<Item = &RunSpec> {
    bench.runs.iter().chain([&bench.held_out])
}

/// A bench as a scenario of some runs, its engine at a step of a quarter of a millisecond.
fn scenario(bench: &LabBench, folder: &Path, runs: Vec<RunSpec>) -> Scenario {
    let mut spec: ScenarioSpec = toml::from_str("robot = ''\nrun = []").unwrap();
    spec.robot = bench.truth.write(folder).unwrap();
    spec.engine.step_ms = 0.25;
    spec.control = bench.control.clone();
    spec.sensors = bench.sensors.clone();
    spec.run = runs;
    let text = toml::to_string(&spec).unwrap();
    let document = Document::from_text("bench", &text).unwrap();
    Scenario::from_document(&document).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

#[test]
fn bodies_could_be_and_a_nominal_model_is_near_them() {
    for &class in ArmClass::ALL {
        let furthest_m = if class == ArmClass::Hobby { 0.002 } else { 0.005 };
        for seed in 0..SEEDS {
            let bench = bench(class, seed);
            let [truth, nominal] = [&bench.truth, &bench.nominal].map(loaded);
            assert_eq!(truth.robot.joint_count(), bench.friction.len());
            assert_eq!(truth.control, nominal.control, "{class} {seed}");
            assert_eq!(truth.robot.gravity_in_base(), nominal.robot.gravity_in_base());
            for (a, b) in truth.robot.links().iter().zip(nominal.robot.links()) {
                assert_eq!(a.joint, b.joint, "{class} {seed}");
                for link in [a, b] {
                    let defects = link.inertia.defects();
                    assert!(defects.is_empty(), "{class} {seed} {}: {defects:?}", link.name);
                }
                let mass = b.inertia.mass / a.inertia.mass - 1.0;
                assert!(mass.abs() <= 0.05, "{class} {seed} {}: {mass}", a.name);
                let com = (a.inertia.com_in_link - b.inertia.com_in_link).norm();
                assert!(com <= furthest_m, "{class} {seed} {}: {com}", a.name);
                assert!(a.actuator.coulomb_forward == 0.0 && a.actuator.viscous == 0.0);
                assert!(a.actuator.rotor_inertia > 0.0);
                assert!(a.joint.limits.effort.unwrap() > 0.0);
            }
        }
    }
}

#[test]
fn motions_stay_within_position_speed_and_length() {
    for &class in ArmClass::ALL {
        for seed in 0..SEEDS {
            let bench = bench(class, seed);
            let robot = loaded(&bench.truth).robot;
            for run in all(&bench) {
                let motion = run.motion.build(&robot, Path::new("")).unwrap();
                let length = motion.duration_s();
                assert!(
                    (4.0..60.1).contains(&length),
                    "{class} {seed} {}: {length} s",
                    bench.motion
                );
                let mut state = State::default();
                let mut moved = false;
                for k in 0..(50.0 * length) as usize {
                    motion.sample(0.02 * k as f64, &mut state);
                    for (i, link) in robot.links().iter().enumerate() {
                        let (low, high) = link.joint.limits.position.unwrap();
                        assert!((low..=high).contains(&state.q[i]), "{class} {seed}");
                        assert!(state.qd[i].abs() <= link.joint.limits.velocity.unwrap());
                        moved |= state.qd[i].abs() > 1e-3;
                    }
                }
                assert!(moved, "{class} {seed} {} {}", bench.motion, run.name);
            }
        }
    }
}

#[test]
fn an_arm_follows_its_motion() {
    for &class in ArmClass::ALL {
        for seed in 0..3 {
            let bench = bench(class, seed);
            let folder = tempfile::tempdir().unwrap();
            let runs = vec![bench.runs[0].clone()];
            let scenario = scenario(&bench, folder.path(), runs);
            let log = simulate(&scenario, &|| {}).unwrap().runs.remove(0);
            for (joint, link) in log.joints.iter().zip(scenario.robot().links()) {
                let desired = joint.desired_position.as_ref().unwrap();
                let errors = joint.position.iter().zip(desired).map(|(q, d)| (q - d).abs());
                let largest = errors.fold(0.0, f64::max);
                let effort = joint.effort.iter().fold(0.0_f64, |most, tau| most.max(tau.abs()));
                let limit = link.joint.limits.effort.unwrap();
                println!(
                    "{class} {seed} {}: error {largest:.4}, effort {effort:.3} of {limit}",
                    joint.name
                );
                assert!(largest <= 0.2, "{class} {seed} {}: {largest}", joint.name);
                assert!(effort <= 1.2 * limit, "{class} {seed} {}: {effort}", joint.name);
            }
        }
    }
}

#[test]
fn a_seed_says_everything() {
    for &class in ArmClass::ALL {
        assert_eq!(bench(class, 7), bench(class, 7));
        assert_ne!(bench(class, 7).sensors, bench(class, 8).sensors);
    }
}

#[test]
fn everything_that_varies_comes_up() {
    let wishes = wishes(ArmClass::ALL, MotionClass::ALL);
    let [mut classes, mut motions, mut efforts] = [(); 3].map(|()| BTreeSet::new());
    let (mut joints, mut logs, mut repeats) = (BTreeSet::new(), BTreeSet::new(), 0);
    let (mut slides, mut springs, mut hangs, mut unlogged) = (0, 0, 0, 0);
    for seed in 0..200 {
        let bench = draw_bench(&wishes, &mut ChaCha8Rng::seed_from_u64(seed)).unwrap();
        classes.insert(bench.class.name());
        motions.insert(bench.motion.name());
        efforts.insert(bench.effort.name());
        joints.insert(bench.friction.len());
        logs.insert(bench.runs.len());
        repeats += usize::from(bench.repeats);
        slides += usize::from(bench.truth.urdf.contains("prismatic"));
        springs += usize::from(bench.truth.toml.contains("spring_stiffness"));
        hangs += usize::from(bench.truth.toml.contains("gravity_m_per_s2"));
        unlogged += usize::from(bench.sensors.velocity_logged == simulator::scenario::Logged::No);
        if bench.repeats {
            assert!(bench.runs.iter().all(|run| run.motion == bench.runs[0].motion));
            assert_ne!(bench.held_out.motion, bench.runs[0].motion);
        }
    }
    assert_eq!(classes.len(), ArmClass::ALL.len());
    assert_eq!(motions.len(), MotionClass::ALL.len());
    assert_eq!(efforts.len(), EffortClass::ALL.len());
    assert_eq!(joints, (1..=7).collect());
    assert_eq!(logs, (1..=8).collect());
    assert!(repeats >= 5 && slides >= 5 && springs >= 3 && hangs >= 20 && unlogged >= 20);
}

#[test]
fn nothing_to_draw_from_is_refused() {
    let error = draw_bench(&wishes(&[], MotionClass::ALL), &mut ChaCha8Rng::seed_from_u64(0));
    assert!(error.unwrap_err().to_string().starts_with("classes: nothing to draw from"));
}
