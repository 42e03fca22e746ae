//! Logs that the model describes: nothing may be found.

use checks::synthetic::{Noise, Truth, log, wam};
use diagnosis::{Settings, Silent, Verdict, diagnose};

use crate::world::named;

/// A log of the model itself plus noise is called consistent at every joint in at least 95
/// of 100 seeds.
#[test]
fn same_model_logs_are_consistent_at_every_joint() {
    let robot = wam();
    let mut bad = Vec::new();
    for seed in 0..100 {
        let runs = log(&Truth::of(&robot), seed);
        let answer = diagnose(&robot, &runs, &Settings::default(), &Silent).unwrap().diagnosis;
        if answer.joints.iter().any(|j| j.verdict != Verdict::Consistent) {
            let findings: Vec<_> = answer.findings.iter().map(|f| f.at.words()).collect();
            let joints: Vec<_> = answer
                .joints
                .iter()
                .filter(|j| j.verdict != Verdict::Consistent)
                .map(|j| {
                    format!(
                        "{}: effort {:.4} residual {:.4} floor {:.4} {:?} memory {:.2} s",
                        j.name,
                        j.torque_rms_nm,
                        j.residual_rms_nm,
                        j.noise_floor_rms_nm,
                        j.noise_floor_from,
                        j.autocorrelation_time_s
                    )
                })
                .collect();
            let data = (answer.data.cutoff_hz, answer.data.regression_rate_hz);
            bad.push(format!("seed {seed} {data:?}: {findings:?} {joints:?}"));
        }
    }
    println!("{} of 100 logs are consistent at every joint", 100 - bad.len());
    assert!(bad.len() <= 5, "{} of 100 logs are not consistent:\n{}", bad.len(), bad.join("\n"));
}

/// With a cut-off in the midst of the motion, which goes up to 1 Hz and beyond: what the model makes
/// of the motion and what was measured are weakened alike, and no cause makes up for a difference.
#[test]
fn a_motion_as_fast_as_the_cutoff_is_weakened_alike_on_both_sides() {
    const CUTOFF_HZ: f64 = 1.5;
    let (robot, noise) = (wam(), Noise::of_a_wam());
    for seed in 200..203 {
        let settings = Settings { cutoff_hz: Some(CUTOFF_HZ), ..Settings::default() };
        let answer = diagnose(&robot, &log(&Truth::of(&robot), seed), &settings, &Silent).unwrap();
        assert_eq!(named(&answer.diagnosis), Vec::<String>::new(), "seed {seed}");
        // Of the wrist most is noise.
        let left = &answer.diagnosis.gain.inverse.rms_before_nm;
        let joints = answer.diagnosis.joints.iter().zip(left);
        for ((joint, left), sd) in joints.zip(&noise.effort).take(4) {
            // The share of white noise, logged at 250 Hz, that lies below the cut-off.
            let floor = sd * (CUTOFF_HZ / 125.0).sqrt();
            assert!(
                *left < 2.0 * floor,
                "seed {seed}, {}: {left} N m, {floor} is noise",
                joint.name
            );
        }
    }
}
