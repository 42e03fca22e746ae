use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use simulator::effects::EffectSpec;
use simulator::scenario::Scenario;
use simulator::strangers::StrangerSpec;
use simulator::{EffectSizer, simulate_noise_free};

use crate::error::PopulationError;
use crate::oracle::column::{StandIn, TorqueColumn};
use crate::oracle::motion::SeenRun;
use crate::oracle::noise::OracleNoise;
use crate::oracle::regression::strengths;
use crate::oracle::scales::torque_scales;
use crate::oracle::stand_ins::stand_ins;
use crate::sheet::Strength;
use crate::trial::hidden::{HiddenKind, SizedCause};

/// First torque share that is tried.
const FIRST_SHARE: f64 = 0.1;

/// Least and largest torque share.
const SHARES: [f64; 2] = [2e-3, 3.0];

/// The first run of a trial, on which hidden causes are sized.
///
/// The torque of most effects is proportional to the requested share, so one run with a tenth of the torque
/// gives the share for the strength wanted:
///
/// ```text
/// share = 0.1 wanted / strength(0.1),   strength = min(sigmas / 5, share / floor)
/// ```
pub(crate) struct Pilot<'a> {
    scenario: &'a Scenario,
    robot: &'a Robot,
    noise: &'a [OracleNoise],
    base: Vec<EffectSpec>,
    bench: EffectSizer<'a>,
    seen: SeenRun,
    scales: Vec<f64>,
    stand_ins: Vec<TorqueColumn>,
}

impl<'a> Pilot<'a> {
    /// The first run of a scenario with nothing but its everyday friction.
    pub fn new(
        scenario: &'a Scenario,
        noise: &'a [OracleNoise],
        base: &[EffectSpec],
    ) -> Result<Self, PopulationError> {
        let robot = scenario.robot();
        let seen = first(scenario, base, &[])?;
        let stand_ins = stand_ins(robot, std::slice::from_ref(&seen));
        let bench = EffectSizer::new(scenario)?;
        let scales = torque_scales(std::slice::from_ref(&seen), robot, noise);
        Ok(Self { scenario, robot, noise, base: base.to_vec(), bench, seen, scales, stand_ins })
    }

    /// A cause of about the strength wanted, with 1 at the threshold of visibility; `None` where the arm runs away
    /// or the cause has no torque.
    pub fn spec_of_strength(
        &self,
        hidden: HiddenKind,
        wanted: f64,
        random: &mut ChaCha8Rng,
    ) -> Option<SizedCause> {
        let joint = random.random_range(0..self.robot.joint_count());
        let seed = random.random::<u64>();
        if matches!(hidden, HiddenKind::Stranger(kind) if !kind.fits(self.robot, joint)) {
            return None;
        }
        let first = self.of_share(hidden, joint, FIRST_SHARE, seed);
        let strength = over_threshold(&self.strength(&first)?);
        if strength <= 1e-6 {
            return None;
        }
        let share = (FIRST_SHARE * wanted / strength).clamp(SHARES[0], SHARES[1]);
        let sized = self.of_share(hidden, joint, share, seed);
        self.strength(&sized).map(|_| sized)
    }

    fn of_share(&self, hidden: HiddenKind, joint: usize, share: f64, seed: u64) -> SizedCause {
        match hidden {
            HiddenKind::Cause(kind) => {
                SizedCause::Cause(self.bench.effect(kind, joint, share, seed))
            }
            HiddenKind::Stranger(kind) => {
                SizedCause::Stranger(self.bench.stranger(kind, joint, share, seed))
            }
        }
    }

    /// Its visibility in the first run; `None` where the arm cannot be simulated with it.
    fn strength(&self, sized: &SizedCause) -> Option<Strength> {
        let mut effects = self.base.clone();
        let mut strangers = Vec::new();
        match sized {
            SizedCause::Cause(effect) => effects.push(effect.clone()),
            SizedCause::Stranger(stranger) => strangers.push(stranger.clone()),
        }
        let with = first(self.scenario, &effects, &strangers).ok()?;
        let rows = with.rows().min(self.seen.rows());
        let torque = with.beyond.rows(0, rows) - self.seen.beyond.rows(0, rows);
        let column = TorqueColumn { stands_for: StandIn::Itself, torque: vec![torque], prior: 0.0 };
        let columns: Vec<TorqueColumn> =
            std::iter::once(column).chain(self.stand_ins.iter().cloned()).collect();
        strengths(std::slice::from_ref(&self.seen), &columns, 1, self.noise, &self.scales).pop()
    }
}

/// Strength relative to the threshold of visibility.
fn over_threshold(strength: &Strength) -> f64 {
    (strength.sigmas / Strength::SIGMAS).min(strength.share / Strength::FLOOR)
}

fn first(
    scenario: &Scenario,
    effects: &[EffectSpec],
    strangers: &[StrangerSpec],
) -> Result<SeenRun, PopulationError> {
    let name = scenario.runs().first().map_or("", |run| run.name.as_str());
    let runs = simulate_noise_free(scenario, &|wanted| wanted == name, effects, strangers)?;
    let run = runs.first().ok_or(PopulationError::NoRun)?;
    Ok(SeenRun::new(scenario.robot(), run))
}
