use std::ops::ControlFlow;

use rayon::prelude::*;
use robot::PdGain;
use tracking::{ControlTick, Event, TrackingWatch};

use crate::error::ExperimentError;
use crate::models::learned::Learned;
use crate::progress::Progress;
use crate::scenario::feedforward_kind::FeedforwardKind;
use crate::scenario::tracking_scenario::TrackingScenario;
use crate::tracking::track::{Parts, controller};

/// Tracking errors at several gains.
#[derive(Debug, Clone, PartialEq)]
pub struct GainSweep {
    /// Name of the set of gains that is scaled.
    pub gains: String,
    /// Duration of the motion that is tracked (s).
    pub duration_s: f64,
    /// Factors of `kp`; those of `kd` are their square roots.
    pub scales: Vec<f64>,
    /// The errors, one entry a feedforward.
    pub models: Vec<SweptModel>,
}

/// The errors of one feedforward at several gains.
#[derive(Debug, Clone, PartialEq)]
pub struct SweptModel {
    /// What is fed forward.
    pub kind: FeedforwardKind,
    /// Root mean square error by joint, for each of the scales (rad or m); NaN where the arm did not reach the end of
    /// the motion.
    pub rmse: Vec<Vec<f64>>,
}

/// Tracks the motion of a scenario over its range of gains, if it has one:
///
/// ```text
/// kp = scale kp_0,   kd = sqrt(scale) kd_0
/// ```
///
/// This keeps the damping ratio of a joint whose inertia dominates.
///
/// # Errors
///
/// [`ExperimentError`] when the arm cannot be simulated or tracked.
pub fn sweep(
    scenario: &TrackingScenario,
    learned: &Learned,
    progress: &dyn Progress,
) -> Result<Option<GainSweep>, ExperimentError> {
    let Some((spec, gains)) = scenario.sweep() else { return Ok(None) };
    let whole_s = scenario.motion().duration_s();
    let duration_s = spec.duration_s.map_or(whole_s, |longest_s| longest_s.min(whole_s));
    let count = spec.feedforward.len() * spec.scales.len();
    progress.begin(&format!("tracking for {:.0} s at other gains", count as f64 * duration_s));
    let runs: Vec<(FeedforwardKind, f64)> = spec
        .feedforward
        .iter()
        .flat_map(|&kind| spec.scales.iter().map(move |&scale| (kind, scale)))
        .collect();
    let errors: Result<Vec<Vec<f64>>, ExperimentError> = runs
        .into_par_iter()
        .map(|(kind, scale)| {
            let controller = controller(scenario, &scale_gains(gains, scale))?;
            let parts = Parts { scenario, learned, kind, controller: &controller };
            let mut watch = Until { end_s: duration_s, second: 0.0, progress };
            let run = parts.run(&mut watch)?;
            let whole = run.tracking.rows.time_s().last().is_some_and(|t| t > duration_s - 0.01);
            Ok(match whole {
                true => run.metrics.joints.iter().map(|joint| joint.rmse).collect(),
                false => vec![f64::NAN; scenario.robot().joint_count()],
            })
        })
        .collect();
    let errors = errors?;
    let models = spec.feedforward.iter().zip(errors.chunks(spec.scales.len()));
    let models = models.map(|(&kind, rmse)| SweptModel { kind, rmse: rmse.to_vec() }).collect();
    let (gains, scales) = (spec.gains.clone(), spec.scales.clone());
    Ok(Some(GainSweep { gains, duration_s, scales, models }))
}

fn scale_gains(gains: &[PdGain], scale: f64) -> Vec<PdGain> {
    gains.iter().map(|g| PdGain { kp: scale * g.kp, kd: scale.sqrt() * g.kd }).collect()
}

/// Ends a run at a given time, or when the user stops it.
struct Until<'a> {
    end_s: f64,
    second: f64,
    progress: &'a dyn Progress,
}

impl TrackingWatch for Until<'_> {
    fn tick(&mut self, tick: &ControlTick) -> ControlFlow<()> {
        if tick.time_s >= self.second + 1.0 {
            self.second += 1.0;
            self.progress.second();
        }
        if tick.time_s >= self.end_s || self.progress.is_stopped() {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }

    fn event(&mut self, _: &Event) {}
}
