use std::path::PathBuf;

use logs::Run;
use nalgebra::Point3;
use rayon::prelude::*;
use robot::{Machine, PdGain};
use tracking::{
    Ahead, Controller, ErrorRate, Feedforward, GravityFeedforward, ModelFeedforward,
    NamedFeedforward, NoFeedforward, RunClock, TorqueLimits, TorquePrediction, TrackingMetrics,
    TrackingSettings, TrackingWatch, VirtualClock, WallClock,
};

use crate::error::ExperimentError;
use crate::models::learned::Learned;
use crate::models::median_time::median_time_s;
use crate::progress::Progress;
use crate::scenario::feedforward_kind::FeedforwardKind;
use crate::scenario::tracking_scenario::TrackingScenario;
use crate::scenario::tracking_spec::{AheadSpec, ClockSpec, ErrorRateSpec, PredictionTimeSpec};
use crate::tracking::outputs::Outputs;
use crate::tracking::stream::Stream;
use crate::tracking::tracked_run::TrackedRun;

/// Simulates the logs that a scenario's models are learned from.
///
/// # Errors
///
/// [`ExperimentError::Simulator`].
pub fn simulated_logs(
    scenario: &TrackingScenario,
    progress: &dyn Progress,
) -> Result<Vec<Run>, ExperimentError> {
    let learn = scenario.learn();
    let is_learned =
        |name: &str| learn.train.iter().chain(&learn.regression).any(|run| run == name);
    let runs = scenario.plant().runs().iter().filter(|run| is_learned(&run.name));
    let seconds: f64 = runs.map(|run| run.motion.duration_s()).sum();
    progress.begin(&format!("simulating {seconds:.0} s of motion to learn from"));
    let second = || progress.second();
    Ok(simulator::simulate_only(scenario.plant(), &is_learned, &second)?.runs)
}

/// Tracks the motion of a scenario with every feedforward that it lists: in parallel on the virtual clock, one after
/// the other on the wall clock.
///
/// # Errors
///
/// [`ExperimentError`] when the arm cannot be simulated or tracked, or a file cannot be written.
pub fn track_all(
    scenario: &TrackingScenario,
    learned: &Learned,
    outputs: Option<&Outputs>,
    progress: &dyn Progress,
) -> Result<Vec<TrackedRun>, ExperimentError> {
    let controller = controller(scenario, scenario.gains())?;
    let track = |&kind: &FeedforwardKind| {
        let parts = Parts { scenario, learned, kind, controller: &controller };
        let mut stream = Stream::start(scenario, kind, outputs, progress)?;
        let mut run = parts.run(&mut stream)?;
        run.written = stream.finish(scenario, learned, &run);
        Ok(run)
    };
    let kinds = scenario.feedforward();
    let seconds = kinds.len() as f64 * scenario.motion().duration_s();
    progress.begin(&format!("tracking for {seconds:.0} s"));
    match scenario.prediction().clock {
        ClockSpec::Virtual => kinds.par_iter().map(track).collect(),
        ClockSpec::Wall => kinds.iter().map(track).collect(),
    }
}

/// The feedback of a scenario with these gains.
pub(crate) fn controller(
    scenario: &TrackingScenario,
    gains: &[PdGain],
) -> Result<Controller, ExperimentError> {
    let limits = scenario.robot().links().iter();
    let limits = limits.map(|link| link.joint.limits.effort.unwrap_or(f64::INFINITY)).collect();
    let pairs = scenario.loaded_robot().control.differentials.clone();
    let error_rate = match scenario.error_rate() {
        ErrorRateSpec::Reading => ErrorRate::Reading,
        ErrorRateSpec::FilteredDifference { cutoff_hz } => {
            ErrorRate::FilteredDifference { cutoff_hz }
        }
    };
    Ok(Controller { gains: gains.to_vec(), limits: TorqueLimits::new(limits, pairs)?, error_rate })
}

/// The parts of one run.
pub(crate) struct Parts<'a> {
    pub scenario: &'a TrackingScenario,
    pub learned: &'a Learned,
    pub kind: FeedforwardKind,
    pub controller: &'a Controller,
}

impl Parts<'_> {
    /// Tracks the motion with a new arm, which is the same for every feedforward.
    pub fn run(&self, watch: &mut dyn TrackingWatch) -> Result<TrackedRun, ExperimentError> {
        let Self { scenario, kind, .. } = *self;
        let mut arm = simulator::arm(scenario.plant(), 0)?;
        let motion = scenario.motion();
        let start = motion.at(0.0);
        arm.start_moving(&start.q, &start.qd);
        let mut feedforward = self.feedforward(arm.period_s())?;
        let prediction_time_s = self.prediction_time_s(&mut *feedforward);
        let settings = self.settings(prediction_time_s);
        let tracking = tracking::track(
            &mut arm,
            motion,
            self.controller,
            &mut *feedforward,
            &settings,
            watch,
        )?;
        // The point that is looked at is where the last link begins.
        let metrics = TrackingMetrics::of(&tracking.rows, scenario.robot(), &Point3::origin())?;
        Ok(TrackedRun { kind, prediction_time_s, tracking, metrics, written: None })
    }

    /// The feedforward for a machine that holds a command for `period_s` (s): the torque at the middle of that time.
    fn feedforward(&self, period_s: f64) -> Result<Box<dyn Feedforward + '_>, ExperimentError> {
        let lead_s = 0.5 * period_s;
        let joints = self.scenario.robot().joint_count();
        let Some(kind) = self.kind.model() else {
            return Ok(Box::new(NoFeedforward { joints }));
        };
        let missing = || ExperimentError::NoModel { path: PathBuf::from(kind.name()), model: kind };
        if let (FeedforwardKind::Model(learner::ModelKind::Named), Some(named)) =
            (self.kind, self.learned.named_torque())
        {
            let (robot, speeds) = (named.robot(), named.rest_speed());
            return Ok(Box::new(NamedFeedforward::new(robot, speeds, lead_s)?));
        }
        let model = self.learned.model(kind).ok_or_else(missing)?;
        Ok(match self.kind {
            FeedforwardKind::Gravity => Box::new(GravityFeedforward::new(model, lead_s)),
            _ => Box::new(ModelFeedforward::new(model, lead_s)),
        })
    }

    /// Median time of a prediction over states of the motion (s).
    fn prediction_time_s(&self, feedforward: &mut dyn Feedforward) -> f64 {
        let motion = self.scenario.motion();
        let mut prediction = TorquePrediction::zero(feedforward.joints());
        median_time_s(|call| {
            // A step that meets the motion in ever new places: the golden section.
            let part = (0.618_034 * call as f64).fract();
            feedforward.predict(motion, part * motion.duration_s(), &mut prediction);
            std::hint::black_box(&mut prediction);
        })
    }

    fn settings(&self, measured_s: f64) -> TrackingSettings {
        let spec = self.scenario.prediction();
        let ahead = match spec.ahead {
            AheadSpec::Now => Ahead::Now,
            AheadSpec::Arrival => Ahead::Arrival,
        };
        let clock = match spec.clock {
            ClockSpec::Virtual => RunClock::Virtual(VirtualClock {
                prediction_time_s: match spec.time_ms {
                    PredictionTimeSpec::Given(time_ms) => 1e-3 * time_ms,
                    PredictionTimeSpec::Here(_) => measured_s,
                },
                ahead,
                stops_at_s: spec.stops_at_s,
            }),
            ClockSpec::Wall => RunClock::Wall(WallClock { ahead }),
        };
        TrackingSettings { clock, ..TrackingSettings::default() }
    }
}
