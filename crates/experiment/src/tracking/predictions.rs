use learner::{Model, SampleState, TorqueModel};
use rayon::prelude::*;
use tracking::Signal;

use crate::models::learned::Learned;
use crate::scenario::feedforward_kind::FeedforwardKind;
use crate::scenario::tracking_scenario::TrackingScenario;
use crate::tracking::tracked_run::TrackedRun;

/// Time between two predictions (s).
const PERIOD_S: f64 = 0.04;

/// Torques that the other models of a scenario predict along the motion of a finished run.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Predictions {
    /// Times since the motion began (s).
    pub time_s: Vec<f64>,
    pub models: Vec<Predicted>,
}

/// Torques that one model predicts.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Predicted {
    pub kind: FeedforwardKind,
    /// Index of the model in the feedforward of the scenario.
    pub place: usize,
    /// Row-major torque of all joints (N m or N).
    pub tau: Vec<f64>,
}

impl Predictions {
    /// The predictions of every model that the scenario feeds forward in another run.
    pub fn of(scenario: &TrackingScenario, learned: &Learned, run: &TrackedRun) -> Self {
        let step = (PERIOD_S / run.tracking.period_s).round().max(1.0) as usize;
        let kinds = scenario.feedforward().par_iter().enumerate();
        let others = kinds.filter(|(_, kind)| **kind != run.kind).filter_map(|(place, &kind)| {
            let model = learned.model(kind.model()?)?;
            Some(Predicted { kind, place, tau: torque(model, kind, run, step) })
        });
        let time_s = run.tracking.rows.time_s().step_by(step).collect();
        Self { time_s, models: others.collect() }
    }
}

/// The torque of a model at the references of every `step`-th tick.
fn torque(model: &Model, kind: FeedforwardKind, run: &TrackedRun, step: usize) -> Vec<f64> {
    let rows = &run.tracking.rows;
    let joints = rows.joints();
    let (mut workspace, rest) = (model.workspace(), vec![0.0; joints]);
    let mut tau = vec![0.0; rows.len().div_ceil(step) * joints];
    for (tick, tau) in (0..rows.len()).step_by(step).zip(tau.chunks_exact_mut(joints.max(1))) {
        let of = |signal| match kind {
            FeedforwardKind::Gravity => rest.as_slice(),
            _ => rows.row(tick, signal),
        };
        let q = rows.row(tick, Signal::QRef);
        let state = SampleState { q, qd: of(Signal::QdRef), qdd: of(Signal::QddRef) };
        model.torque_into(&mut workspace, state, tau);
    }
    tau
}
