//! Logs that the model describes: nothing may be found.

use checks::synthetic::{Truth, log, wam};
use diagnosis::{Settings, Silent, Verdict, diagnose};

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
