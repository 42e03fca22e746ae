//! Clean logs of simulated arms, spoilt one way after the other.

use std::collections::BTreeMap;
use std::path::Path;

use inspection::{Observation, Spoils, inspect};
use population::{ArmClass, MotionClass, PopulationSpec, Store};
use robot::{JointKind, Robot};

use crate::recorded::read_logs;
use crate::spoil::{Clean, SPOILS, Sure, is_told};

const ARMS: [ArmClass; 3] = [ArmClass::Wam, ArmClass::Cobot, ArmClass::Industrial];

fn spec(arm: ArmClass) -> PopulationSpec {
    let mut spec: PopulationSpec = toml::from_str("trials = 1").unwrap();
    spec.arms = vec![arm];
    spec.motions =
        vec![MotionClass::Sinusoids, MotionClass::PointToPoint, MotionClass::PickAndPlace];
    spec.logs = [2, 2];
    spec.log_s = [12.0, 16.0];
    (spec.clean, spec.spoilt, spec.strangers) = (1.0, 0.0, 0.0);
    spec
}

/// The trial of a seed, with velocities, of an arm of three joints or more.
fn clean(store: &Store, arm: ArmClass, seed: u64) -> Option<Clean> {
    let kept = store.trial(&spec(arm), seed).ok()?;
    let robot = Robot::load(&kept.folder.join("nominal/robot.toml")).unwrap().robot;
    let runs = read_logs(&kept.folder.join("logs"), &robot).unwrap();
    (robot.joint_count() >= 3).then_some(Clean { robot, runs })
}

/// The rotations that move in the first log and have the largest torques, the first one and the next.
fn loaded(clean: &Clean) -> Option<[usize; 2]> {
    let spread = |j: usize| {
        let all = || clean.runs.iter().flat_map(|r| &r.joints[j].effort);
        let mean = all().sum::<f64>() / all().count() as f64;
        all().map(|e| (e - mean).powi(2)).sum::<f64>()
    };
    let rotates = |j: &usize| clean.robot.links()[*j].joint.kind != JointKind::Prismatic;
    let moves = |j: &usize| {
        let q = &clean.runs[0].joints[*j].position;
        let [low, high] = [f64::min, f64::max].map(|f| q.iter().copied().reduce(f).unwrap());
        high - low > 0.2
    };
    let joints = 0..clean.robot.joint_count();
    let mut joints: Vec<usize> = joints.filter(rotates).filter(moves).collect();
    joints.sort_by(|a, b| spread(*b).total_cmp(&spread(*a)));
    Some([*joints.first()?, *joints.get(1)?])
}

/// Derivatives of the positions where the log has no velocity.
fn with_velocity(clean: &mut Clean) {
    for run in &mut clean.runs {
        let time = run.time.clone();
        let last = time.len() - 1;
        for joint in run.joints.iter_mut().filter(|j| j.velocity.is_none()) {
            let q = &joint.position;
            let rate = |k: usize| {
                let (a, b) = (k.saturating_sub(1), (k + 1).min(last));
                (q[b] - q[a]) / (time[b] - time[a])
            };
            joint.velocity = Some((0..=last).map(rate).collect());
        }
    }
}

/// Seeds of which each way to spoil their logs was not told, and those whose clean logs were.
struct Table {
    missed: BTreeMap<&'static str, Vec<u64>>,
    clean: Vec<u64>,
    seeds: usize,
}

fn table(store: &Store, arm: ArmClass, [first, seeds]: [u64; 2]) -> Table {
    let mut table = Table { missed: BTreeMap::new(), clean: Vec::new(), seeds: 0 };
    for seed in first.. {
        let Some(mut clean) = clean(store, arm, seed) else { continue };
        let Some(joints) = loaded(&clean) else { continue };
        if told_of(&clean).iter().any(|o| o.spoils > Spoils::Nothing) {
            table.clean.push(seed);
        }
        with_velocity(&mut clean);
        for spoil in &SPOILS {
            let mut spoilt = clean.clone();
            (spoil.spoil)(&mut spoilt, joints);
            let told = inspect(&spoilt.robot, &spoilt.runs);
            let missed = table.missed.entry(spoil.name).or_default();
            if !is_told(spoil, joints, &told) {
                missed.push(seed);
                println!("{arm} {seed}: {} is not told", spoil.name);
            }
        }
        table.seeds += 1;
        if table.seeds as u64 >= seeds {
            break;
        }
    }
    table
}

fn told_of(clean: &Clean) -> Vec<Observation> {
    let told = inspect(&clean.robot, &clean.runs);
    told.iter().for_each(|o| println!("clean: {}", o.sentence(&clean.robot, &clean.runs)));
    told
}

/// Two seeds of every arm; with `PLUMBLINE_INSPECTION_SEEDS` as many as it says, from
/// `PLUMBLINE_INSPECTION_FIRST_SEED` on, kept in the folder `PLUMBLINE_INSPECTION_STORE` where that is set.
#[test]
fn spoilt_logs_are_told_and_clean_ones_are_not() {
    let number = |name: &str| std::env::var(name).ok().and_then(|s| s.parse().ok());
    let first = number("PLUMBLINE_INSPECTION_FIRST_SEED").unwrap_or(1);
    let seeds = number("PLUMBLINE_INSPECTION_SEEDS").unwrap_or(2);
    let kept = std::env::var_os("PLUMBLINE_INSPECTION_STORE");
    let own = tempfile::tempdir().unwrap();
    let store = Store::open(kept.as_ref().map_or(own.path(), |p| Path::new(p))).unwrap();
    let tables = ARMS.map(|arm| table(&store, arm, [first, seeds]));
    println!("{:36}{:>12}{:>12}{:>12}", "told", "wam", "cobot", "industrial");
    for spoil in &SPOILS {
        let of = |t: &Table| format!("{}/{}", t.seeds - t.missed[spoil.name].len(), t.seeds);
        let [a, b, c] = tables.each_ref().map(of);
        println!("{:36}{a:>12}{b:>12}{c:>12}", spoil.name);
    }
    let [a, b, c] = tables.each_ref().map(|t| format!("{}/{}", t.clean.len(), t.seeds));
    println!("{:36}{a:>12}{b:>12}{c:>12}", "clean logs");

    let sure: Vec<&str> =
        SPOILS.iter().filter(|s| s.sure == Sure::Nearly).map(|s| s.name).collect();
    let logs: usize = tables.iter().map(|t| sure.len() * t.seeds).sum();
    let missed: usize = tables.iter().flat_map(|t| sure.iter().map(|s| t.missed[s].len())).sum();
    assert!(20 * missed <= logs, "{missed} of {logs} spoilt logs are not told");
    let (clean, all) = tables.iter().fold((0, 0), |s, t| (s.0 + t.clean.len(), s.1 + t.seeds));
    assert!(50 * clean <= all, "something is told of {clean} of {all} clean logs");
}
