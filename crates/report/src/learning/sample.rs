//! Small results made by hand, for the tests of this module.

use crate::learning::comparison::{
    ComparedJoint, DataSet, KernelRow, LearningComparison, ModelRow,
};
use crate::learning::times::{Curve, Maker, PredictionTimes, TimePoint};
use pages::{FileHash, Provenance};

/// Rigid bodies, a Gaussian process and both, for two joints; nothing is known of the rigid
/// bodies at the elbow.
pub fn comparison() -> LearningComparison {
    let joint = |name: &str, effort_unit| ComparedJoint { name: name.into(), effort_unit };
    let data = |name: &str, rows, points| DataSet {
        logs: vec![FileHash { role: "log", path: name.into(), sha256: "ab".repeat(32) }],
        rows,
        points,
    };
    LearningComparison {
        robot: "arm".into(),
        joints: vec![joint("shoulder", "N m"), joint("elbow", "N")],
        train: data("train.csv", 6000, 3000),
        regression: data("train.csv", 6000, 6000),
        test: data("test.csv", 4000, 4000),
        thinning: "sample floor(i n / points) of n".into(),
        cutoff_hz: 10.0,
        models: vec![
            ModelRow {
                points: 0,
                coverage_95: None,
                log_likelihood: None,
                kernels: None,
                remarks: Vec::new(),
                ..model("rbd", [0.1, f64::NAN])
            },
            model("gp", [0.01, 0.02]),
            model("gp-rbd", [0.001, 0.0200049]),
        ],
        warnings: vec!["elbow: quantised in steps of 0.01 N m".into()],
        provenance: provenance(),
    }
}

fn model(name: &str, nmse: [f64; 2]) -> ModelRow {
    ModelRow {
        name: name.into(),
        words: "what it is".into(),
        points: 3000,
        nmse: nmse.to_vec(),
        rmse_nm: vec![0.3, 0.2],
        coverage_95: Some(vec![0.91, 0.96]),
        log_likelihood: Some(-749.75),
        training_s: 12.345,
        prediction_us: 23.8,
        kernels: Some(vec![kernel(), kernel()]),
        remarks: vec!["the search at elbow was stopped".into()],
    }
}

fn kernel() -> KernelRow {
    KernelRow {
        signal_variance_nm2: 2.0,
        length_scales: vec![("shoulder.position (rad)".into(), 1.25)],
        noise_variance_nm2: 0.01,
        log_likelihood: Some(-374.9),
        search: "converged".into(),
        evaluations: 42,
        lambda: None,
        at_bounds: Vec::new(),
        jitter_nm2: 0.0,
    }
}

fn provenance() -> Provenance {
    Provenance {
        program: "plumbline",
        version: "0.1.0",
        command: vec!["plumbline".into(), "learn".into()],
        files: Vec::new(),
        seed: None,
    }
}

/// Rigid bodies, a Gaussian process and a peer, which was not asked for many points.
pub fn times() -> PredictionTimes {
    let curve = |name: &str, maker, points: &[(usize, f64)]| Curve {
        name: name.into(),
        maker,
        points: points.iter().map(|&(n, microseconds)| TimePoint { n, microseconds }).collect(),
    };
    PredictionTimes {
        robot: "arm".into(),
        joints: 7,
        machine: "a machine".into(),
        curves: vec![
            curve("rbd", Maker::Plumbline, &[(100, 1.1), (10_000, 1.1)]),
            curve("gp", Maker::Plumbline, &[(100, 3.2), (10_000, 900_000.0)]),
            curve("scikit-learn", Maker::Peer, &[(100, 830.0)]),
        ],
        remarks: vec!["numpy: not installed".into()],
        provenance: provenance(),
    }
}
