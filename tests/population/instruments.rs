//! Logs are read with what a population asks for, whatever arms of the class have.

use population::{ArmClass, Corner, EffortClass, Instruments, PopulationSpec, TruthSheet, make};
use robot::Robot;

use crate::made::short;

/// A clean trial with one instrument, its corner, and the largest distance of a position from a whole step.
fn made(class: ArmClass, rate_hz: f64, bits: u8, effort: EffortClass) -> (Corner, f64, f64) {
    let instruments = Instruments {
        rates_hz: vec![rate_hz],
        encoder_bits: vec![bits],
        effort_kinds: vec![effort],
    };
    let spec = PopulationSpec {
        clean: 1.0,
        strangers: 0.0,
        instruments: Some(instruments),
        logs: [1, 1],
        log_s: [5.0, 5.0],
        ..short(class, [0, 0])
    };
    let folder = tempfile::tempdir().unwrap();
    make(&spec, 11, folder.path()).unwrap();
    let robot = Robot::load(&folder.path().join("nominal/robot.toml")).unwrap().robot;
    let log = folder.path().join("logs/log_1.parquet");
    let run = logs::read_run(&log, &robot, &logs::ReadOptions::default()).unwrap();
    let [first, last] = [run.time.first().unwrap(), run.time.last().unwrap()];
    let mut periods: Vec<f64> = run.time.windows(2).map(|pair| pair[1] - pair[0]).collect();
    periods.sort_by(f64::total_cmp);
    assert!(last - first > 4.0, "{first} to {last}");
    let sheet = TruthSheet::open(folder.path()).unwrap();
    assert!(sheet.causes.is_empty() && sheet.strangers.is_empty());
    let step = sheet.corner.encoder_step;
    let off = |q: &f64| (q / step - (q / step).round()).abs();
    let turning = run.joints.iter().zip(robot.links());
    let turning = turning.filter(|(_, link)| link.joint.kind.is_rotation());
    let off = turning.flat_map(|(joint, _)| &joint.position).map(off).fold(0.0, f64::max);
    (sheet.corner, periods[periods.len() / 2], off)
}

#[test]
fn rate_encoder_and_effort_are_those_that_a_population_states() {
    let asked = [
        (ArmClass::Hobby, 20.0, 16, EffortClass::JointTorque),
        (ArmClass::Wam, 1000.0, 12, EffortClass::Current),
        (ArmClass::Cobot, 2000.0, 14, EffortClass::Command),
        (ArmClass::Industrial, 50.0, 13, EffortClass::Command),
    ];
    for (class, rate_hz, bits, effort) in asked {
        let (corner, period_s, off) = made(class, rate_hz, bits, effort);
        assert_eq!((corner.rate_hz, corner.effort), (rate_hz, effort), "{class}");
        // Half of the stamps are less than a tenth of a period of jitter off.
        assert!((period_s * rate_hz - 1.0).abs() < 0.1, "{class}: {period_s} s");
        let turn = corner.encoder_step * 2_f64.powi(i32::from(bits));
        assert!((turn / std::f64::consts::TAU - 1.0).abs() < 1e-5, "{class}: {turn}");
        assert!(off < 1e-6, "{class}: {off} of a step");
    }
}

#[test]
fn a_population_that_states_none_is_drawn_as_before() {
    let spec = short(ArmClass::Hobby, [0, 0]);
    let text = toml::to_string(&spec).unwrap();
    assert!(!text.contains("instruments"), "{text}");
}
