use std::panic::{AssertUnwindSafe, catch_unwind};

use motion::Motion;

/// The torque that the reference needs, without feedback.
pub trait Feedforward: Send {
    /// Number of joints.
    fn joints(&self) -> usize;

    /// What it is, in words.
    fn words(&self) -> String;

    /// Fills `prediction`, whose vectors have one entry a joint, with the torque and leads that the
    /// motion needs at a time (s).
    ///
    /// The feedback does not wait for it, so it may be slow. It has to return, as a run ends only
    /// then. A panic ends the predictor.
    fn predict(&mut self, motion: &Motion, time_s: f64, prediction: &mut TorquePrediction);
}

/// The output of a feedforward, one entry a joint.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TorquePrediction {
    /// Torque (N m or N).
    pub tau: Vec<f64>,
    /// By how much the motor has to lead the reference of its link (rad or m), because of backlash
    /// and elasticity.
    pub q_lead: Vec<f64>,
    /// The rate of that (rad/s or m/s).
    pub qd_lead: Vec<f64>,
}

impl TorquePrediction {
    /// A prediction of zeros.
    pub fn zero(joints: usize) -> Self {
        let zeros = vec![0.0; joints];
        Self { tau: zeros.clone(), q_lead: zeros.clone(), qd_lead: zeros }
    }

    /// Whether every joint has its three finite numbers.
    pub(crate) fn is_usable(&self, joints: usize) -> bool {
        let signals = [&self.tau, &self.q_lead, &self.qd_lead];
        signals.iter().all(|s| s.len() == joints && s.iter().all(|value| value.is_finite()))
    }
}

/// Feedback alone.
#[derive(Debug, Clone, Copy)]
pub struct NoFeedforward {
    /// Number of joints.
    pub joints: usize,
}

impl Feedforward for NoFeedforward {
    fn joints(&self) -> usize {
        self.joints
    }

    fn words(&self) -> String {
        "no feedforward".to_owned()
    }

    fn predict(&mut self, _: &Motion, _: f64, prediction: &mut TorquePrediction) {
        for signal in [&mut prediction.tau, &mut prediction.q_lead, &mut prediction.qd_lead] {
            signal.fill(0.0);
        }
    }
}

/// Asks a feedforward; the error is the message of a panic.
pub(crate) fn ask(
    feedforward: &mut dyn Feedforward,
    motion: &Motion,
    time_s: f64,
    prediction: &mut TorquePrediction,
) -> Result<(), String> {
    // Nobody asks a feedforward again, or looks at its prediction, once it has panicked.
    let asked = AssertUnwindSafe(|| feedforward.predict(motion, time_s, prediction));
    catch_unwind(asked).map_err(|payload| {
        let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
        let text = text.or_else(|| payload.downcast_ref::<String>().cloned());
        text.unwrap_or_else(|| "a panic without words".to_owned())
    })
}
