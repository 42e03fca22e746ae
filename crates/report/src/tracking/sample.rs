//! A small result made by hand, for the tests of this module.

use crate::learning::comparison::ComparedJoint;
use crate::tracking::comparison::{
    ControllerGains, ErrorSweep, FirstSeconds, SweptFeedforward, TrackedModel, TrackingComparison,
};
use pages::Provenance;

/// A hinge and a slide that follow a sine of 1 rad and 1 m with no feedforward, which the slide
/// loses its encoder with, with rigid bodies, and with both rigid bodies and a process.
pub fn comparison() -> TrackingComparison {
    let joint = |name: &str, effort_unit| ComparedJoint { name: name.into(), effort_unit };
    let swept = |name: &str, factor: f64| SweptFeedforward {
        name: name.into(),
        rmse_rad: [4.0, 2.0, 1.0].map(|rise| vec![0.02 * factor * rise; 2]).to_vec(),
    };
    TrackingComparison {
        robot: "arm".into(),
        joints: vec![joint("shoulder", "N m"), joint("slide", "N")],
        motion: "a sine of 0.5 Hz".into(),
        gains: ControllerGains { name: "low".into(), kp: vec![20.0, 300.0], kd: vec![1.5, 7.0] },
        clock: "a prediction takes no time".into(),
        duration_s: 60.0,
        models: vec![
            TrackedModel {
                stopped: Some("slide: its encoder failed after 12 s".into()),
                ..model("none", [0.2, f64::NAN], 0.1)
            },
            model("rbd", [0.02, 0.004], 0.01),
            model("gp-rbd", [0.005, 0.001], 0.0025),
        ],
        sweep: Some(ErrorSweep {
            gains: "compliant".into(),
            duration_s: 20.0,
            scales: vec![0.1, 0.25, 1.0],
            models: vec![swept("rbd", 1.0), swept("gp-rbd", 0.25)],
        }),
        warnings: vec!["shoulder: its gains are below what friction needs".into()],
        provenance: Provenance {
            program: "plumbline",
            version: "0.1.0",
            command: vec!["plumbline".into(), "track".into()],
            files: Vec::new(),
            seed: Some(7),
        },
    }
}

fn model(name: &str, rmse: [f64; 2], tip: f64) -> TrackedModel {
    let time: Vec<f64> = (0..6000).map(|k| 0.002 * f64::from(k)).collect();
    let desired: Vec<f64> = time.iter().map(|t| (std::f64::consts::PI * t).sin()).collect();
    let measured: Vec<f64> = desired.iter().map(|q| q * (1.0 - 2.0 * rmse[0])).collect();
    TrackedModel {
        name: name.into(),
        words: "what it is".into(),
        rmse_rad: rmse.to_vec(),
        rmse_first_10_s_rad: rmse.to_vec(),
        max_error_rad: rmse.map(|error| 3.0 * error).to_vec(),
        tip_rmse_m: Some(tip),
        tip_max_m: Some(3.0 * tip),
        link_rmse_rad: None,
        effort_rms_nm: vec![10.0, 40.0],
        feedback_rms_nm: vec![20.0 * rmse[0], 300.0 * rmse[1]],
        largest_jump_nm: vec![0.13, 0.25],
        prediction_us: 12.5,
        stopped: None,
        events: Vec::new(),
        timing: None,
        first_seconds: FirstSeconds::of(&time, &[&desired, &desired], &[&measured, &measured]),
    }
}
