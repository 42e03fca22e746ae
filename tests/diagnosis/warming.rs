//! Friction that falls as a drive warms up.

use catalogue::EffectKind;
use checks::arms::workspace_root;
use checks::synthetic::{Noise, Truth, run, wam};
use diagnosis::{Diagnosis, Finding};
use document::Document;
use logs::{ReadOptions, Run};
use robot::Robot;
use simulator::scenario::Scenario;

use crate::blind::diagnosed;

const VISCOUS: f64 = 1.2;
const COULOMB: f64 = 1.5;
const LOST: f64 = 0.4;
const TIME_CONSTANT_S: f64 = 900.0;
const AT: usize = 3;

/// A minute of motion from each of these times on, with friction at the elbow that falls by the clock.
fn session(robot: &Robot, starts_s: [f64; 4], lost_when_warm: f64) -> Vec<Run> {
    let minute = |(k, start_s): (usize, f64)| {
        let mut run = run(&Truth::of(robot), &Noise::of_a_wam(), 60.0, 40 + k as u64);
        run.time.iter_mut().for_each(|t| *t += start_s);
        let joint = &mut run.joints[AT];
        let speeds = joint.velocity.as_ref().unwrap();
        for ((effort, t), qd) in joint.effort.iter_mut().zip(&run.time).zip(speeds) {
            let lost = lost_when_warm * (1.0 - (-t / TIME_CONSTANT_S).exp());
            *effort += (1.0 - lost) * (VISCOUS * qd + COULOMB * (qd / 2e-3).tanh());
        }
        run
    };
    starts_s.into_iter().enumerate().map(minute).collect()
}

fn drift(diagnosis: &Diagnosis) -> Option<&Finding> {
    diagnosis.findings.iter().find(|f| f.at.effect == EffectKind::FrictionTemperatureDrift)
}

/// A session of three quarters of an hour with pauses, on one clock.
#[test]
fn friction_that_falls_by_the_clock_is_named_with_what_is_lost_and_how_fast() {
    let robot = wam();
    let starts_s = [0.0, 300.0, 900.0, 2400.0];
    let answer = diagnosed(&robot, &session(&robot, starts_s, LOST)).diagnosis;
    let found = drift(&answer).unwrap_or_else(|| panic!("{:#?}", answer.findings));
    assert_eq!(found.at.joint.as_deref(), Some(robot.links()[AT].joint.name.as_str()));
    let truth = [LOST * VISCOUS, LOST * COULOMB, TIME_CONSTANT_S, LOST];
    for (estimate, truth) in found.parameters.iter().zip(truth) {
        assert!((estimate.value / truth - 1.0).abs() < 0.15, "{estimate:?}, not {truth}");
        let [low, high] = estimate.ci95;
        assert!((low..=high).contains(&truth), "{estimate:?}, not {truth}");
    }
    let steady = diagnosed(&robot, &session(&robot, starts_s, 0.0)).diagnosis;
    assert_eq!(drift(&steady), None);
    let kinds: Vec<EffectKind> = steady.findings.iter().map(|f| f.at.effect).collect();
    assert_eq!(kinds, [EffectKind::ViscousFriction, EffectKind::CoulombFriction]);
}

/// Logs that begin at zero each: no clock tells how warm the drive was.
#[test]
fn logs_without_a_common_clock_name_no_drift() {
    let robot = wam();
    let mut runs = session(&robot, [0.0, 300.0, 900.0, 2400.0], LOST);
    for run in &mut runs {
        let start_s = run.time[0];
        run.time.iter_mut().for_each(|t| *t -= start_s);
    }
    assert_eq!(drift(&diagnosed(&robot, &runs).diagnosis), None);
}

/// Ten minutes of one joint of the simulated arm, from cold.
#[test]
fn blind_ten_minutes_of_a_simulated_drive_show_what_it_loses() {
    let path = workspace_root().join("scenarios/effects/friction_temperature_drift.toml");
    let scenario = Scenario::from_document(&Document::read(path).unwrap()).unwrap();
    let simulation = simulator::simulate(&scenario, &|| {}).unwrap();
    let folder = tempfile::tempdir().unwrap();
    simulator::write(folder.path(), &scenario, &simulation, simulator::LogFormat::Parquet).unwrap();
    let log = folder.path().join("warming_up.parquet");
    let robot = checks::arms::wam();
    let run = logs::read_run(&log, &robot, &ReadOptions::default()).unwrap();
    let answer = diagnosed(&robot, &[run]).diagnosis;
    let found = drift(&answer).unwrap_or_else(|| panic!("{:#?}", answer.findings));
    assert_eq!(found.at.joint.as_deref(), Some("j1_base_yaw"));
    let [.., time_constant, share] = &found.parameters[..] else { panic!("{found:?}") };
    for (estimate, truth) in [(time_constant, 600.0), (share, 0.4)] {
        assert!((estimate.value / truth - 1.0).abs() < 0.1, "{estimate:?}, not {truth}");
        let [low, high] = estimate.ci95;
        assert!((low..=high).contains(&truth), "{estimate:?}, not {truth}");
    }
}
