use population::{EffortClass, MotionClass, Origin};
use serde::Serialize;

use crate::alarms::log_property::encoder_bits;
use crate::panel::judgement::Judgement;

/// A false alarm: clean logs in which something false is named or structure is left open.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Alarm {
    /// The seed of the trial.
    pub seed: u64,
    /// What made the logs.
    pub origin: Origin,
    /// Kind of motion.
    pub motion: MotionClass,
    /// Name of the arm.
    pub arm: String,
    /// Number of joints.
    pub joints: usize,
    /// Rate of the log (Hz).
    pub rate_hz: f64,
    /// Resolution of the coarsest encoder (bits a turn).
    pub encoder_bits: u64,
    /// Source of the effort.
    pub effort: EffortClass,
    /// The verdict, in words.
    pub verdict: &'static str,
    /// The false names, the largest share of the residual first.
    pub names: Vec<String>,
}

impl Alarm {
    /// The alarm in a trial; `None` where there is none, or where the logs are not known to be clean.
    pub(super) fn of(judgement: &Judgement) -> Option<Self> {
        let corner = &judgement.corner;
        let names = judgement.findings.iter().filter(|finding| !finding.is_true);
        (judgement.false_alarm() == Some(true)).then(|| Self {
            seed: judgement.seed,
            origin: corner.origin,
            motion: corner.motion,
            arm: corner.arm.clone(),
            joints: corner.joints,
            rate_hz: corner.rate_hz,
            encoder_bits: encoder_bits(corner),
            effort: corner.effort,
            verdict: judgement.verdict.words(),
            names: names.map(|finding| finding.at.words()).collect(),
        })
    }
}
