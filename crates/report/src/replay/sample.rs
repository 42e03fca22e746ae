//! A replay made by hand, for the tests.

use pages::Provenance;

use crate::replay::replay_report::{ReplayReport, ReplayedRun, ReplayedTorque, ReplayedWindow};

/// A run of a two-joint arm, for the tests of this crate.
pub fn sample() -> ReplayReport {
    let window =
        |window_ms, drift_rms, tip_rms_m| ReplayedWindow { window_ms, drift_rms, tip_rms_m };
    ReplayReport {
        robot: "arm".into(),
        joints: vec!["shoulder".into(), "<elbow>".into()],
        runs: vec![ReplayedRun {
            name: "run_1".into(),
            windows: vec![
                window(50.0, Some(vec![0.001, 0.002]), Some(0.008)),
                window(200.0, None, None),
            ],
            torque: Some(ReplayedTorque {
                error_rms_nm: vec![0.5, 0.25],
                measured_rms_nm: vec![12.0, 3.0],
            }),
            remarks: vec!["a joint ran away".into()],
        }],
        warnings: Vec::new(),
        provenance: Provenance {
            program: "plumbline",
            version: "0.1.0",
            command: vec!["plumbline".into(), "replay".into()],
            files: Vec::new(),
            seed: None,
        },
    }
}
