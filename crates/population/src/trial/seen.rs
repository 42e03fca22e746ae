use nalgebra::DMatrix;
use robot::Robot;
use simulator::effects::EffectSpec;
use simulator::scenario::Scenario;
use simulator::strangers::StrangerSpec;
use simulator::{StrangerTruth, Truth, simulate_noise_free};

use crate::error::PopulationError;
use crate::oracle::column::{StandIn, TorqueColumn};
use crate::oracle::motion::SeenRun;
use crate::oracle::noise::OracleNoise;
use crate::oracle::regression::strengths;
use crate::oracle::scales::torque_scales;
use crate::oracle::stand_ins::stand_ins;
use crate::rigid::mass_matrix;
use crate::sheet::{CauseRole, TrueCause, TrueStranger};
use crate::trial::differences::Difference;
use crate::trial::hidden::HiddenThings;

/// The noise-free runs of a trial, and the torque of each hidden cause in them:
///
/// ```text
/// torque of k = (effort - bodies along the motion) of the arm  -  the same of the arm without k
/// ```
///
/// The motion changes where `k` is left out, so the torque of the bodies is subtracted on both sides.
pub(crate) struct OracleRuns {
    pub runs: Vec<SeenRun>,
    causes: Vec<(Truth, Vec<DMatrix<f64>>)>,
    strangers: Vec<(StrangerTruth, Vec<DMatrix<f64>>)>,
}

impl OracleRuns {
    /// Simulates the runs once with everything and once without each hidden cause.
    pub fn new(
        scenario: &Scenario,
        friction: &[EffectSpec],
        hidden: &HiddenThings,
    ) -> Result<Self, PopulationError> {
        let runs = simulate_without_noise(scenario, friction, &hidden.causes, &hidden.strangers)?;
        let without_cause = |k: usize| {
            let others = without(&hidden.causes, k);
            let runs_without =
                simulate_without_noise(scenario, friction, &others, &hidden.strangers)?;
            Ok((hidden.causes[k].truth(), beyond(&runs, &runs_without)))
        };
        let without_stranger = |k: usize| {
            let others = without(&hidden.strangers, k);
            let runs_without = simulate_without_noise(scenario, friction, &hidden.causes, &others)?;
            Ok((hidden.strangers[k].truth(), beyond(&runs, &runs_without)))
        };
        let causes: Result<_, PopulationError> =
            (0..hidden.causes.len()).map(without_cause).collect();
        let strangers: Result<_, PopulationError> =
            (0..hidden.strangers.len()).map(without_stranger).collect();
        let (causes, strangers) = (causes?, strangers?);
        Ok(Self { runs, causes, strangers })
    }

    /// Scale of torques at each joint; see [`crate::sheet::Sheet::torque_rms`].
    pub fn scales(&self, robot: &Robot, noise: &[OracleNoise]) -> Vec<f64> {
        torque_scales(&self.runs, robot, noise)
    }

    /// Visibility of every difference from the nominal model and of every hidden cause.
    pub fn strengths(
        &self,
        robot: &Robot,
        differ: Vec<Difference>,
        noise: &[OracleNoise],
    ) -> (Vec<TrueCause>, Vec<TrueStranger>) {
        let itself = |torque: &Vec<DMatrix<f64>>| TorqueColumn {
            stands_for: StandIn::Itself,
            torque: torque.clone(),
            prior: 0.0,
        };
        let count = differ.len() + self.causes.len() + self.strangers.len();
        let (places, differ): (Vec<_>, Vec<_>) =
            differ.into_iter().map(|d| ((d.role, d.truth), d.column)).unzip();
        let hidden = self.causes.iter().map(|(_, torque)| itself(torque));
        let strange = self.strangers.iter().map(|(_, torque)| itself(torque));
        let columns: Vec<TorqueColumn> = differ
            .into_iter()
            .chain(hidden)
            .chain(strange)
            .chain(stand_ins(robot, &self.runs))
            .collect();
        let scales = self.scales(robot, noise);
        let mut strengths = strengths(&self.runs, &columns, count, noise, &scales).into_iter();
        let roles = places
            .into_iter()
            .chain(self.causes.iter().map(|(truth, _)| (CauseRole::Hidden, truth.clone())));
        let mut causes: Vec<TrueCause> = roles
            .zip(strengths.by_ref())
            .map(|((role, truth), strength)| TrueCause { role, truth, strength })
            .collect();
        // A link that is hidden on purpose is told once: its parameters are stated in whole.
        let link = |truth: &Truth| (truth.effect, truth.link.clone());
        let hidden: Vec<_> = self.causes.iter().map(|(truth, _)| link(truth)).collect();
        causes.retain(|c| c.role != CauseRole::Nominal || !hidden.contains(&link(&c.truth)));
        let unnamed = |((truth, _), strength): (&(StrangerTruth, _), _)| TrueStranger {
            name: truth.stranger.name().to_owned(),
            joint: truth.joint.clone(),
            strength,
            spoiling: None,
        };
        let strangers = self.strangers.iter().zip(strengths).map(unnamed).collect();
        (causes, strangers)
    }
}

fn without<T: Clone>(all: &[T], k: usize) -> Vec<T> {
    let kept = all.iter().enumerate().filter(|(i, _)| *i != k);
    kept.map(|(_, one)| one.clone()).collect()
}

fn simulate_without_noise(
    scenario: &Scenario,
    friction: &[EffectSpec],
    causes: &[EffectSpec],
    strangers: &[StrangerSpec],
) -> Result<Vec<SeenRun>, PopulationError> {
    let effects = [friction, causes].concat();
    let wanted = |name: &str| name != "held_out";
    let runs = simulate_noise_free(scenario, &wanted, &effects, strangers)?;
    Ok(runs.iter().map(|run| SeenRun::new(scenario.robot(), run)).collect())
}

/// Efforts beyond the bodies of one arm minus those of another.
fn beyond(with: &[SeenRun], without: &[SeenRun]) -> Vec<DMatrix<f64>> {
    let run = |(with, without): (&SeenRun, &SeenRun)| &with.beyond - &without.beyond;
    with.iter().zip(without).map(run).collect()
}

/// Inertia of each joint with all others held, drives included, in the middle of its range (kg m2 or kg).
pub(crate) fn inertias(robot: &Robot) -> Vec<f64> {
    let middle = |link: &robot::Link| {
        link.joint.limits.position.map_or(0.0, |(low, high)| 0.5 * (low + high))
    };
    let q: Vec<f64> = robot.links().iter().map(middle).collect();
    mass_matrix(robot, &q).diagonal().iter().copied().collect()
}
