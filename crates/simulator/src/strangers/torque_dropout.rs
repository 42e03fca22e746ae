use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, Exp};
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::surroundings::Surroundings;
use crate::mechanics::inject::{Inject, Moment};
use crate::seed::mix_seed;
use crate::strangers::kind::StrangerKind;
use crate::strangers::scenario_stranger::ScenarioStranger;
use crate::strangers::truth::StrangerTruth;

/// Torque that is gone for moments, as with a loose plug.
///
/// ```text
/// tau = kept tau  for start <= t < start + length,  else tau
/// ```
///
/// The starts are those of a Poisson process from the beginning of the log on, one that falls into
/// a dropout is part of it. They come from the seed and from where the run starts, so that runs
/// from one posture have them at the same times.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TorqueDropout {
    /// The joint.
    pub joint: String,
    /// How many a minute, on average, 0 to 6000.
    pub per_minute: f64,
    /// Length of one (ms), 0.1 to 10000.
    pub length_ms: f64,
    /// Share of the torque that stays, 0 to 1.
    #[serde(default)]
    pub kept: f64,
    /// Seed of the starts.
    #[serde(default)]
    pub seed: u64,
}

impl ScenarioStranger for TorqueDropout {
    const KIND: StrangerKind = StrangerKind::TorqueDropout;

    /// The rate is told in 1/s.
    fn truth(&self) -> StrangerTruth {
        let parameters = [
            ("rate", self.per_minute / 60.0),
            ("length", 1e-3 * self.length_ms),
            ("kept", self.kept),
        ];
        StrangerTruth::at_joint(Self::KIND, &self.joint, &parameters)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("per_minute", self.per_minute, 0.0, 6000.0)?;
        within("length_ms", self.length_ms, 0.1, 1e4)?;
        within("kept", self.kept, 0.0, 1.0)?;
        Ok(Box::new(Injected {
            joint,
            kept: self.kept,
            length_s: 1e-3 * self.length_ms,
            between: Exp::new(self.per_minute / 60.0).ok().filter(|_| self.per_minute > 0.0),
            seed: self.seed,
            random: ChaCha8Rng::seed_from_u64(self.seed),
            start_s: f64::INFINITY,
            end_s: f64::NEG_INFINITY,
        }))
    }

    /// Without its torque for a part `p` of the time, a joint lacks `sqrt(p)` of its root mean
    /// square, and what a controller asks for to catch up after 8 to 20 ms is about as much.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let length_ms = random.random_range(8.0..20.0);
        let part = (share * share).min(0.5);
        Self {
            joint: at.joint_name(),
            per_minute: (part * 60_000.0 / length_ms).min(6000.0),
            length_ms,
            kept: 0.0,
            // Whole in the numbers of a TOML file.
            seed: random.random_range(0..1_u64 << 53),
        }
    }
}

struct Injected {
    joint: usize,
    kept: f64,
    length_s: f64,
    /// Time from one start to the next (s).
    between: Option<Exp<f64>>,
    seed: u64,
    random: ChaCha8Rng,
    /// Next start (s).
    start_s: f64,
    /// End of the last dropout (s).
    end_s: f64,
}

impl Injected {
    fn wait(&mut self) -> f64 {
        self.between.map_or(f64::INFINITY, |between| between.sample(&mut self.random))
    }
}

impl Inject for Injected {
    fn on_start(&mut self, q: &[f64]) {
        let seed = q.iter().fold(self.seed, |seed, q| mix_seed(seed, q.to_bits()));
        self.random = ChaCha8Rng::seed_from_u64(seed);
        self.start_s = self.wait();
        self.end_s = f64::NEG_INFINITY;
    }

    fn on_command(&mut self, moment: &Moment<'_>, tau: &mut [f64]) {
        while self.start_s <= moment.time_s {
            self.end_s = self.end_s.max(self.start_s + self.length_s);
            self.start_s += self.wait();
        }
        if moment.time_s < self.end_s {
            tau[self.joint] *= self.kept;
        }
    }
}
