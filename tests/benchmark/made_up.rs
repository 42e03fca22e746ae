//! Sheets and answers that are made up.

use benchmark::{Answers, Costs, HeldOut};
use catalogue::EffectKind;
use diagnosis::{
    DataSummary, Diagnosis, EffectAt, Estimate, Finding, Gain, InverseGain, SCHEMA, Verdict,
};
use population::{
    CauseRole, Corner, EffortClass, Knowledge, MotionClass, Origin, Strength, TrueCause,
    TrueStranger, TruthSheet,
};
use simulator::Truth;

pub const SEEN: Strength = Strength { sigmas: 50.0, share: 0.3, torque: 0.4 };
pub const FAINT: Strength = Strength { sigmas: 2.0, share: 0.3, torque: 0.4 };

pub fn at(effect: EffectKind, joint: &str) -> EffectAt {
    EffectAt { effect, joint: Some(joint.to_owned()), link: None }
}

/// What a finding says of a parameter that the logs determine, with a 95 % interval.
pub fn estimate(name: &'static str, value: f64, ci95: [f64; 2]) -> Estimate {
    Estimate { name, value, ci95, noise95: ci95, nominal: 0.0, unit: "", determined: true }
}

/// A finding with a share of the residual, and what it may as well be.
pub fn finding(at: EffectAt, share_explained: f64, rivals: &[EffectAt]) -> Finding {
    Finding {
        at,
        parameters: Vec::new(),
        share_explained,
        log_evidence: 40.0,
        held_out_gain: 0.5,
        not_separable_from: rivals.to_vec(),
        told_apart_by: None,
        evidence: Vec::new(),
        undetermined: Vec::new(),
    }
}

pub fn diagnosis(verdict: Verdict, findings: Vec<Finding>) -> Diagnosis {
    let inverse = InverseGain {
        nmse_before: Vec::new(),
        nmse_after: Vec::new(),
        rms_before_nm: Vec::new(),
        rms_after_nm: Vec::new(),
        held_out: String::new(),
        folds: Vec::new(),
    };
    let data = DataSummary {
        put_right: false,
        runs: Vec::new(),
        cutoff_hz: 10.0,
        cutoff_reason: String::new(),
        regression_rate_hz: 50.0,
        block_s: 1.0,
        blocks: 1,
        hypotheses: 1,
    };
    Diagnosis {
        schema: SCHEMA,
        robot: "arm".to_owned(),
        verdict,
        joints: Vec::new(),
        findings,
        negligible: Vec::new(),
        also_fitted: None,
        unexplained: Vec::new(),
        ruled_out: Vec::new(),
        gain: Gain { inverse },
        data,
        warnings: Vec::new(),
    }
}

pub fn answers(verdict: Verdict, findings: Vec<Finding>) -> Answers {
    Answers {
        diagnosis: Ok(diagnosis(verdict, findings)),
        held_out: HeldOut::default(),
        least_squares: Vec::new(),
        costs: Costs { diagnosis_s: 2.0, ..Costs::default() },
    }
}

pub fn corner() -> Corner {
    Corner {
        origin: Origin::Simulated,
        arm: "cobot".to_owned(),
        motion: MotionClass::Sweep,
        effort: EffortClass::Current,
        joints: 2,
        encoder_step: 0.001,
        rate_hz: 250.0,
        logs: 2,
        length_s: 30.0,
        repeats: false,
        field: Vec::new(),
        log_kinds: Vec::new(),
        goal_delay_ms: None,
    }
}

/// An arm of two joints with these causes and nothing else.
pub fn sheet(causes: &[(EffectKind, &str, Strength)]) -> TruthSheet {
    let cause = |&(effect, joint, strength): &(EffectKind, &str, Strength)| TrueCause {
        role: CauseRole::Hidden,
        truth: Truth::at_joint(effect, joint, &[]),
        strength,
    };
    TruthSheet {
        seed: 7,
        corner: corner(),
        knowledge: Knowledge::Whole,
        joints: vec!["shoulder".to_owned(), "elbow".to_owned()],
        torque_rms: vec![10.0, 2.0],
        causes: causes.iter().map(cause).collect(),
        strangers: Vec::new(),
    }
}

pub fn stranger(strength: Strength) -> TrueStranger {
    TrueStranger { name: "soft_wall".to_owned(), joint: None, strength, spoiling: None }
}
