use std::cell::OnceCell;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use simulator::effects::EffectSpec;
use simulator::scenario::Scenario;
use simulator::{EffectSizer, TrueRun, simulate_truly};

use crate::error::PopulationError;
use crate::hidden::{HiddenKind, HiddenThings, SizedCause, Which};
use crate::oracle::along::{HiddenArm, added_torque};
use crate::oracle::column::{StandIn, TorqueColumn};
use crate::oracle::regression::strengths;
use crate::oracle::runs::OracleRuns;
use crate::oracle::scales::torque_scales;
use crate::oracle::stand_ins::stand_ins;
use crate::sheet::Strength;

/// First torque share that is tried.
const FIRST_SHARE: f64 = 0.1;

/// Least and largest torque share. What takes as much torque as the arm itself is found by hand.
pub(crate) const SHARES: [f64; 2] = [2e-3, 1.0];

/// Least share of its way that a joint still makes with a cause in the arm. An arm that lags or sags by more is no
/// longer driven: somebody raises its gains first.
const STILL_MOVES: f64 = 0.5;

/// The runs of a trial in which hidden causes are sized, those in which their joint moves most.
///
/// The torque of most effects is proportional to the requested share, so the torque of a tenth gives the share for
/// the strength wanted:
///
/// ```text
/// share = 0.1 wanted / strength(0.1),   strength = min(sigmas / 5, share / floor)
/// ```
pub(crate) struct Pilot<'a> {
    scenario: &'a Scenario,
    base: &'a [EffectSpec],
    /// Number of the run for each joint.
    run_of_joint: Vec<usize>,
    /// One a run, simulated when it is first needed.
    runs: Vec<OnceCell<Option<PilotRun<'a>>>>,
}

/// A run with nothing but everyday friction.
struct PilotRun<'a> {
    bench: EffectSizer<'a>,
    oracle: OracleRuns,
    scales: Vec<f64>,
    stand_ins: Vec<TorqueColumn>,
}

impl<'a> PilotRun<'a> {
    fn new(scenario: &'a Scenario, run: usize) -> Result<Self, PopulationError> {
        let robot = scenario.robot();
        let name = &scenario.runs()[run].name;
        let oracle = OracleRuns::new(scenario, &|wanted| wanted == name)?;
        let bench = EffectSizer::on(scenario, run)?;
        let scales = torque_scales(&oracle.seen, robot, &oracle.noise);
        let stand_ins = stand_ins(robot, &oracle.seen);
        Ok(Self { bench, oracle, scales, stand_ins })
    }
}

impl<'a> Pilot<'a> {
    /// For a scenario whose only effects are everyday friction, with logs that lose no row.
    pub fn new(scenario: &'a Scenario, base: &'a [EffectSpec]) -> Self {
        let count = scenario.robot().joint_count();
        let seen = scenario.runs().len().saturating_sub(1).max(1);
        let way = |run: usize, joint: usize| {
            let motion = &scenario.runs()[run].motion;
            let at = |k: usize| motion.at(motion.duration_s() * k as f64 / SAMPLES as f64).q[joint];
            (0..SAMPLES).map(|k| (at(k + 1) - at(k)).abs()).sum::<f64>()
        };
        let most = |joint: usize| {
            let far = |run: &usize| way(*run, joint);
            // The first of equals.
            (0..seen).rev().max_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(0)
        };
        let run_of_joint = (0..count).map(most).collect();
        let runs = (0..seen).map(|_| OnceCell::new()).collect();
        Self { scenario, base, run_of_joint, runs }
    }

    fn robot(&self) -> &'a Robot {
        self.scenario.robot()
    }

    /// A cause of about the strength wanted, with 1 at the threshold of visibility, within what workshops have; `None`
    /// where the arm runs away or stops, or the log cannot show the cause.
    pub fn spec_of_strength(
        &self,
        hidden: HiddenKind,
        wanted: f64,
        random: &mut ChaCha8Rng,
    ) -> Option<SizedCause> {
        let joint = random.random_range(0..self.robot().joint_count());
        let seed = random.random::<u64>();
        if matches!(hidden, HiddenKind::Stranger(kind) if !kind.fits(self.robot(), joint)) {
            return None;
        }
        let run = self.run_of_joint[joint];
        let pilot =
            self.runs[run].get_or_init(|| PilotRun::new(self.scenario, run).ok()).as_ref()?;
        let of_share = |share| match hidden {
            HiddenKind::Cause(kind) => {
                SizedCause::Cause(pilot.bench.effect(kind, joint, share, seed))
            }
            HiddenKind::Stranger(kind) => {
                SizedCause::Stranger(pilot.bench.stranger(kind, joint, share, seed))
            }
        };
        let strength = over_threshold(&self.strength(pilot, run, &of_share(FIRST_SHARE))?);
        if strength <= 1e-6 {
            return None;
        }
        let share = (FIRST_SHARE * wanted / strength).clamp(SHARES[0], SHARES[1]);
        let sized = of_share(share).within_workshops();
        let with = self.simulate(run, &sized)?;
        still_moves(&pilot.oracle.truly[0], &with).then_some(sized)
    }

    /// The run with a cause in the arm; `None` where it cannot be simulated.
    fn simulate(&self, run: usize, sized: &SizedCause) -> Option<TrueRun> {
        let hidden = HiddenThings::of(sized.clone());
        let effects = [self.base, &hidden.causes[..]].concat();
        let name = &self.scenario.runs()[run].name;
        let runs =
            simulate_truly(self.scenario, &|wanted| wanted == name, &effects, &hidden.strangers);
        runs.ok()?.pop()
    }

    /// Its visibility in a run. What bends is simulated, all else acts along the motion without it.
    fn strength(&self, pilot: &PilotRun<'_>, run: usize, sized: &SizedCause) -> Option<Strength> {
        let oracle = &pilot.oracle;
        let hidden = HiddenThings::of(sized.clone());
        let bends = matches!(
            sized,
            SizedCause::Cause(EffectSpec::Backlash(_) | EffectSpec::JointElasticity(_))
        );
        let along = if bends { vec![self.simulate(run, sized)?] } else { oracle.truly.clone() };
        let which = if hidden.causes.is_empty() { Which::Stranger(0) } else { Which::Cause(0) };
        let (robot, sensing) = (self.robot(), oracle.sensing);
        let arm = HiddenArm { robot, sensing, base: self.base, hidden: &hidden };
        let torque = added_torque(arm, &along, &oracle.seen, which).ok()?;
        let of = |cause: &EffectSpec| StandIn::of(&cause.truth(), robot);
        let stands_for = hidden.causes.first().map_or(StandIn::Itself, of);
        let column = TorqueColumn { stands_for, torque, prior: 0.0 };
        let columns: Vec<TorqueColumn> =
            std::iter::once(column).chain(pilot.stand_ins.iter().cloned()).collect();
        strengths(&oracle.seen, &columns, 1, &oracle.noise, &pilot.scales).pop()
    }
}

/// Instants at which a motion is looked at for the way of its joints.
const SAMPLES: usize = 200;

/// Whether every link still makes a share of the way that it makes without a cause.
fn still_moves(without: &TrueRun, with: &TrueRun) -> bool {
    let way = |run: &TrueRun, j: usize| {
        let q = |row: &simulator::TrueRow| row.state.q[j];
        run.rows.windows(2).map(|rows| (q(&rows[1]) - q(&rows[0])).abs()).sum::<f64>()
    };
    (0..without.log.joints.len()).all(|j| way(with, j) >= STILL_MOVES * way(without, j))
}

/// Strength relative to the threshold of visibility.
fn over_threshold(strength: &Strength) -> f64 {
    (strength.sigmas / Strength::SIGMAS).min(strength.share / Strength::FLOOR)
}
