//! Right descriptions with friction and rotors at every joint: what is named of them, arm by arm, over twenty seeds.
//!
//! `cargo bench -p checks --bench controls [-- SEEDS]` prints a line an arm. Friction and rotors are formulas of this
//! file: dry friction, viscous friction and rotor each have a tenth to three tenths of the RMS of the joint's effort.
#![allow(clippy::unwrap_used, reason = "a benchmark may stop")]

use catalogue::EffectKind;
use checks::arms::{data, generator, workspace_root};
use checks::synthetic::{Noise, Truth, run};
use diagnosis::{Diagnosis, Settings, Silent, diagnose};
use logs::Run;
use rand::RngExt;
use robot::Robot;

/// Runs of a log and their length (s).
const RUNS: u64 = 3;
const SECONDS: f64 = 20.0;

/// The arms: those of the project, and of the recorded logs where they are at hand.
fn arms() -> Vec<(&'static str, Robot)> {
    let own = ["ur5e", "panda", "so101"]
        .map(|name| (name, Some(workspace_root().join("robots").join(name).join("robot.urdf"))));
    let recorded = [
        ("ur10", data("ur10_bag/ur10_robot.urdf")),
        ("kinova_gen3", data("kinova_gen3/robot.urdf")),
        ("xmate7p", data("xmate7p/XM7p.urdf")),
    ];
    let at_hand = own.into_iter().chain(recorded);
    at_hand.filter_map(|(name, path)| Some((name, Robot::load(&path?).unwrap().robot))).collect()
}

/// RMS of a joint's signals over runs.
fn rms(runs: &[Run], of: impl Fn(&Run) -> &Vec<f64>) -> f64 {
    let all = || runs.iter().flat_map(&of);
    (all().map(|x| x * x).sum::<f64>() / all().count() as f64).sqrt()
}

/// Logs of `robot` with friction and a rotor at every joint.
fn log(robot: &Robot, seed: u64) -> Vec<Run> {
    let n = robot.joint_count();
    let silent = Noise { effort: vec![0.0; n], position: 0.0, velocity: 0.0 };
    let runs = |truth: &Truth, noise: &Noise| -> Vec<Run> {
        (0..RUNS).map(|k| run(truth, noise, SECONDS, 10 * seed + k)).collect()
    };
    let plain = runs(&Truth::of(robot), &silent);
    let rate = |j: usize| rms(&plain, |run| run.joints[j].velocity.as_ref().unwrap());
    let effort: Vec<f64> = (0..n).map(|j| rms(&plain, |run| &run.joints[j].effort)).collect();
    let acceleration = |j: usize| {
        let slopes = |run: &Run| -> Vec<f64> {
            let qd = run.joints[j].velocity.as_ref().unwrap();
            qd.windows(2).map(|w| 250.0 * (w[1] - w[0])).collect()
        };
        let all: Vec<f64> = plain.iter().flat_map(slopes).collect();
        (all.iter().map(|x| x * x).sum::<f64>() / all.len() as f64).sqrt()
    };
    let mut rng = generator(seed);
    let mut share = || rng.random_range(0.1..0.3);
    let dry: Vec<f64> = effort.iter().map(|e| share() * e).collect();
    let viscous: Vec<f64> = (0..n).map(|j| share() * effort[j] / rate(j)).collect();
    let mut loaded = robot.clone();
    for (j, effort) in effort.iter().enumerate() {
        loaded.link_mut(j).unwrap().actuator.rotor_inertia += share() * effort / acceleration(j);
    }
    let friction = |j: usize, [_, qd, _]: [f64; 3]| dry[j] * qd.signum() + viscous[j] * qd;
    let noise = Noise { effort: effort.iter().map(|e| 0.01 * e).collect(), ..Noise::of_a_wam() };
    runs(&Truth { robot: &loaded, torque: &friction, reading: &|_, effort| effort }, &noise)
}

/// Number of joints with a finding of a kind.
fn count(diagnosis: &Diagnosis, kind: EffectKind) -> usize {
    diagnosis.findings.iter().filter(|f| f.at.effect == kind).count()
}

fn main() {
    let asked = std::env::args().filter_map(|a| a.parse().ok()).next();
    let seeds: u64 = asked.unwrap_or(20);
    let wanted =
        [EffectKind::CoulombFriction, EffectKind::ViscousFriction, EffectKind::RotorInertia];
    println!("arm           right   Coulomb   viscous    rotors  besides");
    for (name, robot) in arms() {
        let (mut right, mut found, mut besides) = (0, [0; 3], Vec::new());
        for seed in 1..=seeds {
            let runs = log(&robot, seed);
            let diagnosis =
                diagnose(&robot, &runs, &Settings::default(), &Silent).unwrap().diagnosis;
            let counts = wanted.map(|kind| count(&diagnosis, kind));
            let others = diagnosis.findings.iter().filter(|f| !wanted.contains(&f.at.effect));
            let others: Vec<String> = others.map(|f| format!("{seed}: {}", f.at.words())).collect();
            right += u64::from(counts == [robot.joint_count(); 3] && others.is_empty());
            found.iter_mut().zip(counts).for_each(|(all, one)| *all += one);
            besides.extend(others);
        }
        let all = seeds as usize * robot.joint_count();
        let [coulomb, viscous, rotor] = found.map(|f| format!("{f}/{all}"));
        let besides = besides.join(", ");
        println!("{name:12} {right:3}/{seeds:<3} {coulomb:>9} {viscous:>9} {rotor:>9}  {besides}");
    }
}
