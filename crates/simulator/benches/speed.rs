//! Time of one simulated second of the WAM at steps of 0.1 ms and commands at 500 Hz.
//!
//! `tests/benches/compare_peers.sh` puts MuJoCo's figures for the plain arm and the one with friction beside ours.

use std::path::Path;

use criterion::{Criterion, criterion_group, criterion_main};
use robot::{Machine, Reading, Robot};
use simulator::effects::EffectSpec;
use simulator::{Sensors, Simulator, StepOrder, Stepping};

const FRICTION: [f64; 7] = [1.6, 0.53, 0.37, 0.64, 0.036, 0.071, 0.0125];
const KP: [f64; 7] = [200.0, 300.0, 100.0, 100.0, 10.0, 10.0, 2.5];
const KD: [f64; 7] = [7.0, 15.0, 5.0, 2.5, 0.3, 0.3, 0.05];
/// Stiffness of the elastic joints (N m/rad).
const ELASTIC: [(&str, f64); 2] = [("j2_shoulder_pitch", 1e4), ("j4_elbow_pitch", 4e3)];
const LOOSE: [&str; 2] = ["j2_shoulder_pitch", "j4_elbow_pitch"];

/// The effects of a piece of TOML in the shape of a scenario.
fn effects(toml: &str) -> Vec<EffectSpec> {
    #[derive(serde::Deserialize)]
    struct Effects {
        #[serde(default)]
        effect: Vec<EffectSpec>,
    }
    let parsed: Effects = toml::from_str(toml).unwrap_or(Effects { effect: Vec::new() });
    parsed.effect
}

fn friction(robot: &Robot) -> String {
    let entry = |(name, level): (&str, &f64)| {
        format!("[[effect]]\ncoulomb_friction = {{ joint = '{name}', level_nm = {level} }}\n")
    };
    robot.joint_names().zip(&FRICTION).map(entry).collect()
}

fn elastic() -> String {
    let entry = |(name, stiffness): &(&str, f64)| {
        format!(
            "[[effect]]\njoint_elasticity = {{ joint = '{name}', stiffness_nm_per_rad = {stiffness:.1}, damping_nm_s_per_rad = 10.0 }}\n"
        )
    };
    ELASTIC.iter().map(entry).collect()
}

fn loose() -> String {
    let entry =
        |name: &&str| format!("[[effect]]\nbacklash = {{ joint = '{name}', gap_rad = 0.004 }}\n");
    LOOSE.iter().map(entry).collect()
}

/// One second of a lively motion under sampled feedback.
fn second(simulator: &mut Simulator, reading: &mut Reading) {
    simulator.start(&[-0.5, -0.2, 0.4, 0.8, 0.3, -0.4, 0.5]);
    for tick in 0..500 {
        let phase = 3.0 * tick as f64 * 2e-3;
        if simulator.read(reading).is_err() {
            return;
        }
        let tau: Vec<f64> = (0..7)
            .map(|i| KP[i] * (0.5 * (1.0 - phase.cos()) - reading.q[i]) - KD[i] * reading.qd[i])
            .collect();
        if simulator.actuate(&tau).is_err() {
            return;
        }
    }
}

fn speed(criterion: &mut Criterion) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/wam7/robot.toml");
    let Ok(loaded) = Robot::load(&path) else { return };
    let robot = loaded.robot;
    let arms = [
        ("plain arm", String::new()),
        ("dry friction", friction(&robot)),
        ("two elastic joints, dry friction", friction(&robot) + &elastic()),
        ("backlash at two joints, dry friction", friction(&robot) + &loose()),
    ];
    let stepping =
        Stepping { step_s: 1e-4, steps_per_period: 20, stops: false, order: StepOrder::First };
    let mut group = criterion.benchmark_group("one second of the WAM");
    for (name, toml) in arms {
        let injected: Result<Vec<_>, _> = effects(&toml).iter().map(|e| e.inject(&robot)).collect();
        let Ok(injected) = injected else { return };
        let sensors = Sensors::perfect(robot.joint_count());
        let Ok(mut simulator) = Simulator::new(&robot, injected, sensors, stepping) else { return };
        let mut reading = Reading::zero(7);
        group.bench_function(name, |b| b.iter(|| second(&mut simulator, &mut reading)));
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = speed
}
criterion_main!(benches);
