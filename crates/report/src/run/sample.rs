//! A small run made by hand, for the tests of this module.

use diagnosis::{EffectAt, Verdict};
use experiment::{
    Drift, Estimated, ForwardGap, ForwardWindow, Injected, Metrics, Named, Score, Size,
    TorqueError, TrackedError,
};

use crate::run::diagnosis_summary::{DiagnosisSummary, summarise};
use crate::run::run_report::RunReport;
use crate::sample::DiagnosisSample as Diagnosed;

/// What a [`RunReport`] borrows.
pub struct RunSample {
    pub diagnosed: Diagnosed,
    pub metrics: Metrics,
    pub summary: DiagnosisSummary,
    pub next: [[String; 2]; 1],
}

impl RunSample {
    pub fn report(&self) -> RunReport<'_> {
        RunReport {
            metrics: &self.metrics,
            robot: &self.diagnosed.robot,
            diagnosis: &self.summary,
            motion: "<svg></svg>",
            next: &self.next,
            provenance: &self.diagnosed.provenance,
        }
    }
}

/// The arm of [`crate::sample`] with friction at the shoulder, which is found, and a payload, which
/// is not.
pub fn run() -> RunSample {
    let diagnosed = crate::sample::arm();
    let summary = summarise(&diagnosed.report()).unwrap();
    let next = [["Look at it:".to_owned(), "plumbline view out".to_owned()]];
    RunSample { diagnosed, metrics: metrics(), summary, next }
}

fn metrics() -> Metrics {
    let torque = |model: &str, rms: [f64; 2]| TorqueError {
        model: model.into(),
        rms_nm: rms.to_vec(),
        nmse: vec![Some(rms[0].powi(2)), None],
    };
    let tracked = |model: &str, tip_rms_m: Option<f64>| TrackedError {
        model: model.into(),
        rms: tip_rms_m.map(|tip| vec![tip, 0.5 * tip]),
        tip_rms_m,
        feedback_share: vec![0.1, 0.2],
    };
    let drift = |tip: f64| Drift {
        rms: Some(vec![2.0 * tip, tip]),
        tip_rms_m: Some(tip),
        tip_course_m: vec![0.5 * tip, tip],
        ..Drift::default()
    };
    let window =
        ForwardWindow { window_s: 0.2, windows: 7, nominal: drift(0.04), extended: drift(0.002) };
    Metrics {
        robot: "arm".into(),
        joints: vec!["shoulder".into(), "elbow".into()],
        score: score(),
        learned: vec!["run_1".into()],
        test: vec!["run_2".into()],
        torque: vec![torque("cad", [0.3, 0.4]), torque("named", [0.03, 0.04])],
        forward: ForwardGap { windows: vec![window] },
        gains: "low".into(),
        tracking: vec![
            tracked("cad", Some(0.03)),
            tracked("named", Some(0.001)),
            tracked("gp", None),
        ],
        claims: Vec::new(),
    }
}

fn score() -> Score {
    let at = |effect, joint: &str| EffectAt { effect, joint: Some(joint.into()), link: None };
    let friction = at(catalogue::EffectKind::CoulombFriction, "shoulder");
    let estimate = Estimated {
        value: 2.0,
        ci95: [1.8, 2.2],
        noise95: Some([1.8, 2.2]),
        determined: true,
        covers: true,
        relative_error: Some(0.05),
    };
    let level = Size { name: "level".into(), truth: 2.1, estimate: Some(estimate) };
    let payload = EffectAt {
        effect: catalogue::EffectKind::Payload,
        joint: None,
        link: Some("<elbow>".into()),
    };
    let mass = Size { name: "mass".into(), truth: 0.5, estimate: None };
    let named = |at: &EffectAt| Named {
        at: at.clone(),
        share_explained: 0.41,
        not_separable_from: Vec::new(),
    };
    Score {
        seed: 1,
        looked_for: true,
        verdict: Verdict::PartlyExplained,
        findings: vec![named(&friction)],
        exactly: false,
        as_one_of: false,
        stray: vec![at(catalogue::EffectKind::Backlash, "elbow")],
        injected: vec![
            Injected {
                at: friction,
                finding: Some(0),
                one_of: Some(0),
                sizes: vec![level],
                of_smallest: None,
            },
            Injected {
                at: payload,
                finding: None,
                one_of: None,
                sizes: vec![mass],
                of_smallest: Some(0.6),
            },
        ],
    }
}
