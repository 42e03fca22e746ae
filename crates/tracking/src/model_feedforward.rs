use learner::{SampleState, TorqueModel, TorqueWorkspace};
use motion::Motion;

use crate::feedforward::{Feedforward, TorquePrediction};

/// The torque that a model expects along the reference.
///
/// ```text
/// tau(t) = model(q_ref, qd_ref, qdd_ref),   all at t + lead_s
/// ```
pub struct ModelFeedforward<'a>(ModelAhead<'a>);

/// The torque that a model expects if the arm rested on the reference.
///
/// ```text
/// tau(t) = model(q_ref, 0, 0),   q_ref at t + lead_s
/// ```
pub struct GravityFeedforward<'a>(ModelAhead<'a>);

/// A model and what is needed to ask it.
struct ModelAhead<'a> {
    model: &'a dyn TorqueModel,
    workspace: TorqueWorkspace,
    state: motion::State,
    lead_s: f64,
}

impl<'a> ModelFeedforward<'a> {
    /// The feedforward of `model`, asked for `lead_s` (s) later than the tick: half a period
    /// since a command is held for one, and the delay of the motors as far as it is known.
    pub fn new(model: &'a dyn TorqueModel, lead_s: f64) -> Self {
        Self(ModelAhead::new(model, lead_s))
    }
}

impl<'a> GravityFeedforward<'a> {
    /// The feedforward of `model` at rest, asked for `lead_s` (s) later than the tick.
    pub fn new(model: &'a dyn TorqueModel, lead_s: f64) -> Self {
        Self(ModelAhead::new(model, lead_s))
    }
}

impl<'a> ModelAhead<'a> {
    fn new(model: &'a dyn TorqueModel, lead_s: f64) -> Self {
        Self { model, workspace: model.workspace(), state: motion::State::default(), lead_s }
    }

    fn fill(&mut self, prediction: &mut TorquePrediction) {
        let state = SampleState { q: &self.state.q, qd: &self.state.qd, qdd: &self.state.qdd };
        self.model.torque_into(&mut self.workspace, state, &mut prediction.tau);
        prediction.q_lead.fill(0.0);
        prediction.qd_lead.fill(0.0);
    }
}

impl Feedforward for ModelFeedforward<'_> {
    fn joints(&self) -> usize {
        self.0.model.joints()
    }

    fn words(&self) -> String {
        self.0.model.words()
    }

    fn predict(&mut self, motion: &Motion, time_s: f64, prediction: &mut TorquePrediction) {
        motion.sample(time_s + self.0.lead_s, &mut self.0.state);
        self.0.fill(prediction);
    }
}

impl Feedforward for GravityFeedforward<'_> {
    fn joints(&self) -> usize {
        self.0.model.joints()
    }

    fn words(&self) -> String {
        format!("{}, at rest", self.0.model.words())
    }

    fn predict(&mut self, motion: &Motion, time_s: f64, prediction: &mut TorquePrediction) {
        motion.sample(time_s + self.0.lead_s, &mut self.0.state);
        self.0.state.qd.fill(0.0);
        self.0.state.qdd.fill(0.0);
        self.0.fill(prediction);
    }
}
