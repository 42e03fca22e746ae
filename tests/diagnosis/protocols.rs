//! Recorded logs as workshops take them: joint by joint, with coarse encoders, with dropouts.

use std::path::Path;

use catalogue::EffectKind as E;
use checks::recorded::folder;
use diagnosis::{Diagnosis, Settings, Silent, Verdict, diagnose};
use logs::{ReadOptions, Run, read_run};
use robot::Robot;

fn diagnosis(folder: &Path, runs: &[&str]) -> Diagnosis {
    let robot =
        ["robot.toml", "robot.urdf"].map(|f| folder.join(f)).into_iter().find(|f| f.exists());
    let robot = Robot::load(&robot.unwrap()).unwrap().robot;
    let options = ReadOptions { map: None, effort: "effort" };
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
