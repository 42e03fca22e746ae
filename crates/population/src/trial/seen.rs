use nalgebra::DMatrix;
use robot::Robot;
use simulator::scenario::Scenario;
use simulator::{StrangerTruth, Truth};

use crate::error::PopulationError;
use crate::hidden::{HiddenThings, Which};
use crate::oracle::along::{HiddenArm, added_torque};
use crate::oracle::column::{StandIn, TorqueColumn};
use crate::oracle::motion::SeenRun;
use crate::oracle::noise::OracleNoise;
use crate::oracle::regression::strengths;
use crate::oracle::runs::{HELD_OUT, OracleRuns, in_steps_of};
use crate::oracle::scales::torque_scales;
use crate::oracle::stand_ins::stand_ins;
use crate::sheet::{CauseRole, TrueCause, TrueStranger};
use crate::trial::background::{Friction, effects};
use crate::trial::differences::{Difference, Drives, differences};
use crate::trial::step::whole_step_ms;

/// Longest simulation step for sizing causes and for what an oracle sees (ms).
pub(crate) const COARSE_MS: f64 = 2.0;

/// What there is to be seen in a trial.
pub(crate) struct Seen {
    /// What the oracle looks at of these logs.
    pub runs: Vec<SeenRun>,
    /// Noise of the sensors of each joint.
    pub noise: Vec<OracleNoise>,
    /// The logs that take part, without errors of the sensors.
    pub clean: Vec<logs::Run>,
    /// Scale of torques at each joint; see [`crate::sheet::TruthSheet::torque_rms`].
    pub scales: Vec<f64>,
    pub causes: Vec<TrueCause>,
    pub strangers: Vec<TrueStranger>,
}

/// The arm of a trial and what is hidden in it.
pub(crate) struct Truths<'a> {
    /// Everything but the held-out run is seen.
    pub scenario: &'a Scenario,
    pub nominal: &'a Robot,
    pub friction: &'a [Friction],
    pub hidden: &'a HiddenThings,
    /// Differences from the nominal model beyond those of bodies, rotors and friction, along what is seen.
    pub beside: &'a dyn Fn(&[SeenRun]) -> Vec<Difference>,
}

impl Truths<'_> {
    /// Visibility of every difference from the nominal model and of everything hidden.
    pub fn weigh(&self) -> Result<Seen, PopulationError> {
        let robot = self.scenario.robot();
        let runs = self.runs()?;
        let drives = if runs.sensing.sees_drives() { Drives::Seen } else { Drives::Unseen };
        let mut differ = differences(robot, self.friction, self.nominal, &runs.seen, drives);
        differ.extend((self.beside)(&runs.seen));
        let base = effects(robot, self.friction);
        let arm = HiddenArm { robot, sensing: runs.sensing, base: &base, hidden: self.hidden };
        let added = |which| added_torque(arm, &runs.truly, &runs.seen, which);
        let causes: Vec<(Truth, Vec<DMatrix<f64>>)> = (self.hidden.causes.iter().enumerate())
            .map(|(k, cause)| Ok((cause.truth(), added(Which::Cause(k))?)))
            .collect::<Result<_, PopulationError>>()?;
        let strangers: Vec<(StrangerTruth, Vec<DMatrix<f64>>)> =
            (self.hidden.strangers.iter().enumerate())
                .map(|(k, stranger)| Ok((stranger.truth(), added(Which::Stranger(k))?)))
                .collect::<Result<_, PopulationError>>()?;
        let scales = torque_scales(&runs.seen, robot, &runs.noise);
        let (causes, strangers) = judge(robot, &runs, &scales, differ, causes, strangers);
        let OracleRuns { truly, seen, noise, .. } = runs;
        let clean = truly.into_iter().map(|run| run.log).collect();
        Ok(Seen { runs: seen, noise, clean, scales, causes, strangers })
    }

    /// The runs for the oracle, in the longest steps that hidden springs allow, at least those of the logs.
    fn runs(&self) -> Result<OracleRuns, PopulationError> {
        let shortest_ms = self.scenario.spec().engine.step_ms;
        let period_ms = 1e3 / control_rate_hz(self.scenario);
        let mut step = whole_step_ms(period_ms, COARSE_MS).max(shortest_ms);
        loop {
            let runs = in_steps_of(self.scenario, step)
                .and_then(|scenario| OracleRuns::new(&scenario, &|name| name != HELD_OUT));
            if runs.is_ok() || step <= shortest_ms {
                return runs;
            }
            step = (0.5 * step).max(shortest_ms);
        }
    }
}

/// Rate of the controller of a scenario (Hz).
pub(crate) fn control_rate_hz(scenario: &Scenario) -> f64 {
    1.0 / scenario.period_s()
}

type Hidden<T> = Vec<(T, Vec<DMatrix<f64>>)>;

fn judge(
    robot: &Robot,
    runs: &OracleRuns,
    scales: &[f64],
    differ: Vec<Difference>,
    hidden: Hidden<Truth>,
    strange: Hidden<StrangerTruth>,
) -> (Vec<TrueCause>, Vec<TrueStranger>) {
    let column = |stands_for, torque| TorqueColumn { stands_for, torque, prior: 0.0 };
    let count = differ.len() + hidden.len() + strange.len();
    let (mut places, mut columns): (Vec<_>, Vec<_>) =
        differ.into_iter().map(|d| ((d.role, d.truth), d.column)).unzip();
    for (truth, torque) in hidden {
        columns.push(column(StandIn::of(&truth, robot), torque));
        places.push((CauseRole::Hidden, truth));
    }
    let (strange, torques): (Vec<_>, Vec<_>) = strange.into_iter().unzip();
    columns.extend(torques.into_iter().map(|torque| column(StandIn::Itself, torque)));
    columns.extend(stand_ins(robot, &runs.seen));
    let mut strengths = strengths(&runs.seen, &columns, count, &runs.noise, scales).into_iter();
    let mut causes: Vec<TrueCause> = places
        .into_iter()
        .zip(strengths.by_ref())
        .map(|((role, truth), strength)| TrueCause { role, truth, strength })
        .collect();
    // A link that is hidden on purpose is told once: its parameters are stated in whole.
    let link = |cause: &TrueCause| (cause.truth.effect, cause.truth.link.clone());
    let hidden: Vec<_> = causes.iter().filter(|c| c.role == CauseRole::Hidden).map(link).collect();
    causes.retain(|c| c.role != CauseRole::Nominal || !hidden.contains(&link(c)));
    let unnamed = |(truth, strength): (StrangerTruth, _)| TrueStranger {
        name: truth.stranger.name().to_owned(),
        joint: truth.joint,
        strength,
        spoiling: None,
    };
    let strangers = strange.into_iter().zip(strengths).map(unnamed).collect();
    (causes, strangers)
}
