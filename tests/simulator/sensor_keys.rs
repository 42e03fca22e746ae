//! What the log sees and loses, by the keys of `[sensors]`.

use logs::Run;
use robot::{Machine, Reading};
use simulator::scenario::Scenario;
use simulator::{EffortSource, JointSensor, LinkEncoder, PositionSide, Sensors, VelocitySource};

use crate::rig::{STEPPING, flywheel, sensing};
use crate::scenario::document;

/// The log of the WAM in sines for some seconds.
fn log(duration_s: f64, settings: &[&str]) -> Run {
    let mut document = document("");
    document.set(&format!("run.0.motion.sinusoids.duration_s={duration_s:?}")).unwrap();
    for setting in settings {
        document.set(setting).unwrap();
    }
    let scenario = Scenario::from_document(&document).unwrap();
    simulator::simulate(&scenario, &|| {}).unwrap().runs.remove(0)
}

#[test]
fn efforts_are_whole_steps_and_nothing_else_changes() {
    let noise = "sensors.effort_noise_nm={ j4_elbow_pitch = 0.05 }";
    let step = 0.02;
    let stepped = "sensors.effort_resolution_nm={ j4_elbow_pitch = 0.02 }";
    let (mut with, mut without) = (log(1.0, &[noise, stepped]), log(1.0, &[noise]));
    let pairs = with.joints[3].effort.iter().zip(&without.joints[3].effort);
    let mut off = Vec::new();
    for (a, b) in pairs {
        assert!((a / step - (a / step).round()).abs() < 1e-9, "{a}");
        assert!((a - b).abs() <= 0.5 * step + 1e-12, "{a}, not {b}");
        off.push((a - b).powi(2));
    }
    let rms = (off.iter().sum::<f64>() / off.len() as f64).sqrt();
    assert!((rms / (step / 12.0_f64.sqrt()) - 1.0).abs() < 0.1, "{rms}");
    with.joints[3].effort.clear();
    without.joints[3].effort.clear();
    assert_eq!(with, without);
}

/// Under a constant torque `q = a t² / 2`: the encoder at the link says it of a time before.
#[test]
fn oracle_a_lag_makes_the_encoder_at_the_link_say_where_it_was() {
    for lag_s in [0.0, 0.00731, 0.04] {
        let exact = JointSensor { resolution: 0.0, position_noise: 0.0, effort_noise: 0.0 };
        let encoder = LinkEncoder { resolution: 0.0, noise: 0.0 };
        let (side, effort) = (PositionSide::Motor, EffortSource::Motor);
        let sensors = Sensors::new(side, effort, VelocitySource::Ideal, vec![exact], 1)
            .with_links(vec![Some(encoder)])
            .with_link_lag(lag_s);
        let mut wheel = sensing(&flywheel(0.4, 0.1), "effect = []", STEPPING, sensors).unwrap();
        // Twice, since a run starts without a past.
        for _ in 0..2 {
            wheel.start(&[0.3]);
            let mut reading = Reading::zero(1);
            for _ in 0..200 {
                wheel.read(&mut reading).unwrap();
                let t = (reading.time_s - lag_s).max(0.0);
                let expected = 0.3 + 0.5 * (1.0 / 0.5) * t * t;
                wheel.actuate(&[1.0]).unwrap();
                let [Some(link)] = wheel.record_links(&reading)[..] else { unreachable!() };
                // The position of a leapfrog from rest is that of `t² + dt²/4` at most.
                assert!((link - expected).abs() < 1e-7, "{link}, not {expected} at {t} s");
            }
        }
    }
}

#[test]
fn a_lag_of_the_encoders_at_the_links_changes_their_columns_alone() {
    let links = "sensors.link_position_resolution_rad={ j4_elbow_pitch = 0.0 }";
    let mut with = log(1.0, &[links, "sensors.link_position_lag_ms=6.0"]);
    let mut without = log(1.0, &[links]);
    let lagged = with.joints[3].link_position.take().unwrap();
    let true_link = without.joints[3].link_position.take().unwrap();
    assert_eq!(with, without);
    // Three rows of 2 ms.
    for (now, earlier) in lagged[3..].iter().zip(&true_link) {
        assert!((now - earlier).abs() < 1e-9);
    }
}

#[test]
fn a_velocity_that_is_not_logged_is_absent_and_nothing_else_changes() {
    let mut with = log(0.5, &["sensors.velocity_logged='yes'"]);
    assert_eq!(with, log(0.5, &[]));
    let without = log(0.5, &["sensors.velocity_logged='no'"]);
    for joint in &mut with.joints {
        assert!(joint.velocity.take().is_some());
    }
    assert_eq!(with, without);
}

/// The rows that are left are those of the log without dropouts; what is missing between them are
/// stretches of the length asked for, as many as asked for.
#[test]
fn oracle_dropouts_lose_stretches_of_rows_as_often_and_as_long_as_asked() {
    let noise = ["sensors.effort_noise_nm={ j4_elbow_pitch = 0.1 }", "sensors.time_jitter_ms=0.05"];
    let hold = "run.0.motion={ hold = { duration_s = 60.0 } }";
    let log = |more: &str| {
        let mut document = document("");
        for setting in noise.iter().chain(&[hold, "engine.step_ms=1.0", more]) {
            document.set(setting).unwrap();
        }
        let scenario = Scenario::from_document(&document).unwrap();
        simulator::simulate(&scenario, &|| {}).unwrap().runs.remove(0)
    };
    let whole = log("sensors.dropped_share=0.0");
    let lossy = log("sensors.dropouts={ per_minute = 30.0, length_ms = 80.0 }");
    let mut lost = Vec::new();
    let mut at = 0;
    for (row, time) in lossy.time.iter().enumerate() {
        let start = at;
        while whole.time[at] < *time - 1e-9 {
            at += 1;
        }
        assert!((whole.time[at] - time).abs() < 1e-12);
        let effort = |run: &Run, row: usize| run.joints[3].effort[row].to_bits();
        assert_eq!(effort(&whole, at), effort(&lossy, row));
        lost.extend((at > start).then_some(at - start));
        at += 1;
    }
    // 40 rows of 2 ms each, or more where two overlap.
    let single = lost.iter().filter(|rows| (39..=41).contains(*rows)).count();
    assert!(lost.iter().all(|rows| *rows >= 39) && 2 * single > lost.len(), "{lost:?}");
    let count = lost.len() as f64;
    assert!((count - 30.0).abs() < 3.0 * 30.0_f64.sqrt(), "{count}");
    assert_eq!(whole, log("sensors.dropouts={ per_minute = 0.0, length_ms = 80.0 }"));
}
