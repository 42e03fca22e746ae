//! A small diagnosis made by hand, for the tests of this crate.

use catalogue::EffectKind;
use diagnosis::{
    AlsoFitted, DataSummary, Dependence, Diagnosis, EffectAt, Estimate, Finding, FittedParameter,
    FoldGain, Gain, InverseGain, JointReport, JointTraces, NoiseFloorSource, NoiseSpectrum,
    RuledOut, RunSummary, RunTraces, SCHEMA, Unexplained, Verdict,
};
use experiment::{Drift, ForwardGap, ForwardWindow};
use quick_xml::Reader;
use quick_xml::events::Event;
use robot::{Actuator, Inertia, Joint, JointKind, Limits, Link, Robot};

use crate::diagnosis::report::Report;
use crate::diagnosis::residual::{LengthScale, ResidualJointRow, ResidualModel};
use pages::{FileHash, Provenance};

/// What a [`Report`] borrows.
pub struct DiagnosisSample {
    pub diagnosis: Diagnosis,
    pub traces: Vec<RunTraces>,
    pub robot: Robot,
    pub provenance: Provenance,
}

impl DiagnosisSample {
    pub fn report(&self) -> Report<'_> {
        Report {
            diagnosis: &self.diagnosis,
            traces: &self.traces,
            robot: &self.robot,
            residual: None,
            forward: None,
            descriptions: &[],
            input: None,
            provenance: &self.provenance,
        }
    }
}

/// A two-joint arm with Coulomb friction at the shoulder, an inertia finding and structure
/// left at the elbow.
pub fn arm() -> DiagnosisSample {
    let names = ["shoulder", "elbow"];
    let links = names.iter().enumerate().map(|(i, name)| link(i, name)).collect();
    DiagnosisSample {
        diagnosis: diagnosis(&names),
        traces: vec![trace("run_1", &names), trace("run_2", &names)],
        robot: Robot::new("arm", nalgebra::Vector3::new(0.0, 0.0, -9.81), links).unwrap(),
        provenance: Provenance {
            program: "plumbline",
            version: "0.1.0",
            command: vec!["plumbline".into(), "diagnose".into(), "--robot".into(), "a b".into()],
            files: vec![FileHash {
                role: "urdf",
                path: "arm.urdf".into(),
                sha256: "ab".repeat(32),
            }],
            seed: Some(1),
        },
    }
}

/// A residual model of [`arm`] that is used at the elbow.
pub fn residual() -> ResidualModel {
    let unused = ResidualJointRow {
        name: "shoulder".into(),
        extended_rms_nm: 0.4,
        with_residual_rms_nm: 0.5,
        share: -0.5625,
        better_in: 1,
        is_used: false,
        length_scales: Vec::new(),
    };
    let used = ResidualJointRow {
        name: "elbow".into(),
        extended_rms_nm: 0.5,
        with_residual_rms_nm: 0.32,
        share: 0.5904,
        better_in: 3,
        is_used: true,
        length_scales: vec![LengthScale {
            signal: "position of elbow".into(),
            share_of_range: 0.21,
        }],
    };
    ResidualModel {
        model: "named-gp",
        words: "Gaussian process, mean by the robot with its named effects",
        file: "models/named-gp.parquet".into(),
        points: 600,
        parts: 3,
        joints: vec![unused, used],
        remarks: vec!["one thing to know".into()],
    }
}

/// One length of time, of which two windows in five ran away with the nominal simulation.
pub fn forward_gap() -> ForwardGap {
    let nominal = Drift {
        rms: Some(vec![0.1, 0.02]),
        tip_rms_m: Some(0.05),
        tip_course_m: vec![0.02, 0.05],
        runaways: 2,
        trouble: None,
    };
    let extended = Drift {
        rms: Some(vec![0.01, 0.002]),
        tip_rms_m: Some(0.004),
        tip_course_m: vec![0.003, 0.004],
        runaways: 0,
        trouble: Some("a reason".into()),
    };
    ForwardGap { windows: vec![ForwardWindow { window_s: 0.2, windows: 5, nominal, extended }] }
}

fn link(index: usize, joint: &str) -> Link {
    Link {
        name: format!("{joint}_link"),
        parent: index.checked_sub(1),
        joint: Joint {
            name: joint.to_owned(),
            kind: JointKind::Revolute,
            parent_from_joint: nalgebra::Isometry3::identity(),
            axis_in_joint: nalgebra::Vector3::y_axis(),
            limits: Limits::default(),
        },
        inertia: Inertia::zero(),
        actuator: Actuator::default(),
        merged: Vec::new(),
    }
}

/// A rotor of .05 kg m2 that is fitted as .07; without it the shoulder is off by .5 N m.
pub fn also_fitted() -> AlsoFitted {
    let at =
        EffectAt { effect: EffectKind::RotorInertia, joint: Some("shoulder".into()), link: None };
    let rotor = FittedParameter { at, name: "inertia", value: 0.07, before: 0.05, unit: "kg m^2" };
    AlsoFitted { parameters: vec![rotor], rms_named_nm: vec![0.5, 0.5] }
}

fn diagnosis(names: &[&str]) -> Diagnosis {
    let pair = |a: f64, b: f64| vec![a, b];
    Diagnosis {
        schema: SCHEMA,
        robot: "arm".into(),
        verdict: Verdict::PartlyExplained,
        joints: vec![
            joint(names[0], Verdict::Explained),
            joint(names[1], Verdict::PartlyExplained),
        ],
        findings: vec![coulomb(names[0]), inertia("elbow_link")],
        negligible: Vec::new(),
        also_fitted: None,
        unexplained: vec![Unexplained {
            joint: names[1].into(),
            share: 0.29,
            depends_on: vec![Dependence { signal: "position of elbow".into(), share: 0.31 }],
        }],
        ruled_out: vec![rule_out(names[0], Some(0.02)), rule_out(names[1], None)],
        gain: Gain {
            inverse: InverseGain {
                nmse_before: pair(0.2, 0.1),
                nmse_after: pair(0.01, 0.04),
                rms_before_nm: pair(2.1, 0.9),
                rms_after_nm: pair(0.4, 0.5),
                held_out: "each run in turn".into(),
                folds: vec![FoldGain {
                    name: "run_1".into(),
                    torque_rms_nm: pair(5.0, 3.0),
                    rms_before_nm: pair(2.1, 0.9),
                    rms_after_nm: pair(0.4, 0.5),
                }],
            },
        },
        data: DataSummary {
            put_right: false,
            runs: vec![RunSummary {
                name: "run_1".into(),
                sha256: "cd".repeat(32),
                samples: 5000,
                duration_s: 20.0,
                rate_hz: 250.0,
            }],
            cutoff_hz: 8.0,
            cutoff_reason: "the motion has no power above".into(),
            regression_rate_hz: 40.0,
            block_s: 2.0,
            blocks: 10,
            hypotheses: 14,
        },
        warnings: vec!["elbow: quantised in steps of 0.01 N m".into()],
    }
}

fn joint(name: &str, verdict: Verdict) -> JointReport {
    JointReport {
        name: name.into(),
        verdict,
        because: "the reason in a sentence".into(),
        torque_rms_nm: 5.0,
        residual_rms_nm: 2.1,
        remaining_rms_nm: 0.4,
        noise_floor_rms_nm: 0.35,
        noise_floor_from: NoiseFloorSource::Effort,
        is_lost_in_noise: false,
        spectrum: NoiseSpectrum::default(),
        autocorrelation_time_s: 0.4,
        effective_samples: 120.0,
        range: 2.5,
    }
}

fn coulomb(joint: &str) -> Finding {
    Finding {
        at: EffectAt { effect: EffectKind::CoulombFriction, joint: Some(joint.into()), link: None },
        parameters: vec![estimate("level", 2.0, [1.8, 2.2], "N m")],
        share_explained: 0.71,
        log_evidence: 214.0,
        held_out_gain: 0.62,
        not_separable_from: vec![EffectAt {
            effect: EffectKind::ViscousFriction,
            joint: Some(joint.into()),
            link: None,
        }],
        told_apart_by: Some("constant speeds, slow and fast, in both directions"),
        evidence: vec!["the residual jumps by 4.0 N m <at> reversals".into()],
        undetermined: Vec::new(),
    }
}

fn inertia(link: &str) -> Finding {
    Finding {
        at: EffectAt {
            effect: EffectKind::InertialParameters,
            joint: None,
            link: Some(link.into()),
        },
        parameters: vec![
            estimate("mass", 2.5, [2.3, 2.7], "kg"),
            Estimate { determined: false, ..estimate("com_y", 0.0, [-0.1, 0.1], "m") },
        ],
        not_separable_from: Vec::new(),
        told_apart_by: None,
        undetermined: vec!["centre of mass along y".into()],
        ..coulomb("shoulder")
    }
}

fn estimate(name: &'static str, value: f64, ci95: [f64; 2], unit: &'static str) -> Estimate {
    Estimate { name, value, ci95, noise95: ci95, nominal: 0.0, unit, determined: true }
}

fn rule_out(joint: &str, smallest: Option<f64>) -> RuledOut {
    RuledOut {
        at: EffectAt { effect: EffectKind::CableSpring, joint: Some(joint.into()), link: None },
        parameter: "stiffness",
        smallest_detectable: smallest,
        unit: "N m/rad",
        because: "no gain on held-out data".into(),
    }
}

/// Slow and fast sine, Coulomb friction of 2 N m, a spike of 9 N m in the measured effort.
fn trace(name: &str, joints: &[&str]) -> RunTraces {
    let time: Vec<f64> = (0..4000).map(|k| f64::from(k) * 0.005).collect();
    let signal = |f: &dyn Fn(f64) -> f64| -> Vec<f64> { time.iter().map(|&t| f(t)).collect() };
    let one = |_: &&str| {
        let nominal = signal(&|t| 5.0 * t.cos());
        let extended = signal(&|t| 5.0 * t.cos() + 2.0 * t.cos().signum());
        let mut measured =
            signal(&|t| 5.0 * t.cos() + 2.0 * t.cos().signum() + 0.1 * (17.0 * t).sin());
        measured[1234] += 9.0;
        JointTraces {
            position: signal(&f64::sin),
            velocity: signal(&f64::cos),
            measured,
            nominal,
            extended,
        }
    };
    RunTraces { name: name.into(), joints: joints.iter().map(one).collect(), time }
}

/// The text between the tags of a well-formed document.
pub fn text_of_xml(xml: &str) -> String {
    let mut reader = Reader::from_str(xml);
    let mut text = String::new();
    loop {
        match reader.read_event().unwrap() {
            Event::Eof => return text,
            Event::Text(piece) => text.push_str(&piece.decode().unwrap()),
            _ => {}
        }
    }
}
