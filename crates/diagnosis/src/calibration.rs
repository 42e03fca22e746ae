//! How often the sign-flip test calls significant what cannot be a cause, on the residuals
//! of recorded arms: friction columns that are reversed or shifted in time.

use std::path::{Path, PathBuf};

use catalogue::EffectKind;
use logs::{PrepareSettings, ReadOptions, prepare, read_run};
use robot::Robot;

use crate::blocks::blocks;
use crate::design::Design;
use crate::extent::inadequate;
use crate::flip_test::p_value;
use crate::gram::Grams;
use crate::log::Log;
use crate::problem::{Model, Problem};
use crate::search::Record;

const FLIPS: usize = 999;

/// Ways to move a column to where it can explain nothing: sample `t` of `n` comes from there.
const MOVES: [fn(usize, usize) -> usize; 5] = [
    |t, n| n - 1 - t,
    |t, n| (t + n / 3) % n,
    |t, n| (t + 2 * n / 3) % n,
    |t, n| (2 * n - 1 - t + n / 3) % n,
    |t, n| (2 * n - 1 - t + 2 * n / 3) % n,
];

fn is_friction(kind: EffectKind) -> bool {
    matches!(kind, EffectKind::CoulombFriction | EffectKind::ViscousFriction)
}

/// The design with friction columns moved, and what the best model leaves as the effort.
fn impossible(design: &Design, weights: &[f64], from: fn(usize, usize) -> usize) -> Design {
    let mut moved = design.clone();
    let friction = design.groups.iter().filter(|g| is_friction(g.hypothesis.kind));
    let columns: Vec<usize> = friction.flat_map(|g| g.columns.clone()).collect();
    for (r, run) in moved.runs.iter_mut().enumerate() {
        for (j, joint) in run.joints.iter_mut().enumerate() {
            let left = design.remaining(r, j, weights);
            joint.measured = joint.nominal.iter().zip(left).map(|(n, l)| n + l).collect();
            let n = joint.measured.len();
            for (k, _) in design.local[j].iter().enumerate().filter(|(_, c)| columns.contains(c)) {
                let old: Vec<f64> = joint.x.column(k).iter().copied().collect();
                (0..n).for_each(|t| joint.x[(t, k)] = old[from(t, n)]);
            }
        }
    }
    moved
}

/// p-values of impossible friction at every joint, in every way.
fn p_values(robot: &Robot, files: &[PathBuf]) -> Vec<f64> {
    let read = |f: &PathBuf| read_run(f, robot, &ReadOptions::default()).unwrap();
    let runs: Vec<_> = files.iter().map(read).collect();
    let prepared = prepare(&runs, &PrepareSettings::default()).unwrap();
    let moved: Vec<bool> = inadequate(robot, &prepared).iter().map(Option::is_none).collect();
    let design = Design::new(robot, &Log::new(&prepared, &moved)).unwrap();
    let practical = vec![0.0; design.joints()];
    // Blocks as a diagnosis cuts them: by the memory of what a model of everything leaves.
    let rough = blocks(&design, 1.0);
    let grams = Grams::new(&design, &rough);
    let record =
        Record { robot, design: &design, blocks: &rough, grams: &grams, practical: &practical };
    let blocks = blocks(&design, record.memory());
    let grams = Grams::new(&design, &blocks);
    let record = Record { blocks: &blocks, grams: &grams, ..record };
    let all: Vec<usize> = (0..blocks.len()).collect();
    let (problem, model) = record.search(&all);
    let weights = problem.fit(&model).unwrap().expand(design.width);
    let mut p = Vec::new();
    for from in MOVES {
        let design = impossible(&design, &weights, from);
        let grams = Grams::new(&design, &blocks);
        let problem = Problem::new(&design, &blocks, &grams, &all, problem.weight.clone());
        let friction =
            (0..design.groups.len()).filter(|&g| is_friction(design.groups[g].hypothesis.kind));
        p.extend(friction.filter_map(|g| p_value(&problem, &Model::new(), g, FLIPS, 1)));
    }
    p
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path());
    let mut files: Vec<_> =
        entries.filter(|p| p.extension().is_some_and(|e| e == "parquet")).collect();
    files.sort();
    files
}

#[test]
fn recorded_residuals_make_few_impossible_causes_significant() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let beside = root.join("../../../shared/data");
    let data = std::env::var_os("PLUMBLINE_DATA").map_or(beside, PathBuf::from);
    if !data.is_dir() {
        println!("skipped: no recorded logs here (set PLUMBLINE_DATA to their folder)");
        return;
    }
    let mut counts = (0, 0);
    for arm in ["kinova_gen3", "staubli_tx40", "kuka_lwr4"] {
        let robot = Robot::load(&data.join(arm).join("robot.urdf")).unwrap().robot;
        let p = p_values(&robot, &files(&data.join(arm)));
        let alarms = p.iter().filter(|p| **p < 0.05).count();
        println!("{arm}: {alarms} of {} impossible causes have p < 0.05", p.len());
        if arm == "kuka_lwr4" {
            // Above nominal, and known to be: slow sines, whose moved columns resemble them,
            // and a residual that repeats from run to run. 24 when repeats are flipped apart.
            assert!(alarms <= 14 && p.len() == 70, "{alarms} of {}", p.len());
        } else {
            counts = (counts.0 + alarms, counts.1 + p.len());
        }
    }
    // 0.05 of 130 tests is 6.5, and at most 13 in 99 of 100 draws.
    assert!(counts.0 <= 13 && counts.1 == 130, "{counts:?}");
}
