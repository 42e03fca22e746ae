use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use robot::Robot;
use simulator::VelocitySource;
use simulator::scenario::SensorSpec;

use crate::bench::{BenchWishes, LabBench};
use crate::corner::ArmClass;
use crate::dice::{happens, one_of};
use crate::error::PopulationError;
use crate::hidden::HiddenThings;
use crate::log_kind::LogKind;
use crate::spec::PopulationSpec;
use crate::trial::servo::{ServoDraw, whole_part};
use crate::trial::spoilt::log_damage::LogDamage;

/// Streams of a trial's seed: whether each kind of log is drawn, what it does, and its servos. The first ones are
/// those of the trial's tries.
const KINDS: u64 = 1 << 32;
const DAMAGE: u64 = 2 << 32;
const SERVOS: u64 = 3 << 32;
const SERVO_CAUSES: u64 = SERVOS + 1;

/// Rates of logs with few rows (Hz), before they become a whole part of the controller's.
const LOW_HZ: [f64; 3] = [20.0, 30.0, 50.0];

/// In what the logs of a trial differ from usual ones, drawn apart from everything else.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LogDraw {
    seed: u64,
    /// The kinds that are drawn, with their sizes.
    kinds: Vec<(LogKind, Option<f64>)>,
    /// The servos, where the arm has such.
    pub servo: Option<ServoDraw>,
}

impl LogDraw {
    /// Draws it from streams of its own.
    pub fn new(spec: &PopulationSpec, seed: u64) -> Self {
        let is_drawn =
            |kind: LogKind, share| happens(&mut stream(seed, KINDS + kind as u64), share);
        let kinds = spec.log_kinds.iter().filter(|(kind, log)| is_drawn(**kind, log.share));
        let kinds = kinds.map(|(kind, log)| (*kind, log.size)).collect();
        let mut random = stream(seed, SERVOS);
        let servo = spec.servos.filter(|servos| happens(&mut random, servos.share));
        let servo = servo.map(|servos| ServoDraw::draw(&servos, &mut random));
        Self { seed, kinds, servo }
    }

    /// What is wished of the bench: servos are those of hobby arms.
    pub fn wishes(&self, wishes: BenchWishes) -> BenchWishes {
        let classes = match self.servo {
            Some(_) => vec![ArmClass::Hobby],
            None => wishes.classes,
        };
        BenchWishes { classes, ..wishes }
    }

    /// Gives a bench its servos and a low rate.
    pub fn prepare(&self, bench: &mut LabBench) -> Result<(), PopulationError> {
        let wished = self.size_of(LogKind::LowRate);
        let drawn = |wished: Option<f64>| {
            wished.unwrap_or_else(|| one_of(&mut self.damage_stream(LogKind::LowRate), LOW_HZ))
        };
        let low_hz = wished.map(drawn);
        if let Some(servo) = &self.servo {
            return servo.prepare(bench, low_hz);
        }
        if let Some(low_hz) = low_hz {
            let control_hz = bench.truth.load()?.control.rate_hz.unwrap_or(500.0);
            bench.sensors.log_rate_hz = Some(whole_part(control_hz, low_hz));
        }
        Ok(())
    }

    /// Adds what the servos are off by.
    pub fn add_causes(&self, robot: &Robot, hidden: &mut HiddenThings) {
        if let Some(servo) = &self.servo {
            servo.add_causes(robot, hidden, &mut stream(self.seed, SERVO_CAUSES));
        }
    }

    /// The sensors of the logs: those drawn, or the same without noise, steps, lag and lost rows.
    pub fn sensors(&self, drawn: &SensorSpec) -> SensorSpec {
        if self.size_of(LogKind::NoNoise).is_none() {
            return drawn.clone();
        }
        let mut links = drawn.link_position_resolution_rad.clone();
        links.values_mut().for_each(|step| *step = 0.0);
        SensorSpec {
            position: drawn.position,
            effort: drawn.effort,
            velocity: VelocitySource::Ideal,
            velocity_logged: drawn.velocity_logged,
            log_rate_hz: drawn.log_rate_hz,
            link_position_resolution_rad: links,
            ..SensorSpec::default()
        }
    }

    /// What spoils the logs: the first kind that is drawn and that they can have, or else `usual`, which the trial has
    /// drawn itself.
    pub fn damage(
        &self,
        (robot, runs): (&Robot, usize),
        usual: Option<LogDamage>,
    ) -> Option<LogDamage> {
        let has_effort = self.servo.is_none();
        let fits = |kind: &LogKind| match kind {
            LogKind::NormalisedUnits => !has_effort,
            kind => has_effort || !kind.is_of_effort(),
        };
        let spoilt = self.kinds.iter().filter(|(kind, _)| kind.is_spoilt() && fits(kind));
        let mut own = spoilt.filter_map(|(kind, size)| {
            LogDamage::of_kind(*kind, *size, (robot, runs), &mut self.damage_stream(*kind))
        });
        let usual = usual.filter(|usual| fits(&usual.kind));
        own.next().or(usual)
    }

    /// The repetition of messages, where the logs hold their values.
    pub fn repetition(&self, robot: &Robot) -> Option<LogDamage> {
        let size = self.size_of(LogKind::HeldValues)?;
        let random = &mut self.damage_stream(LogKind::HeldValues);
        LogDamage::of_kind(LogKind::HeldValues, size, (robot, 1), random)
    }

    /// The kinds of the logs: those of true logs, and that of the damage.
    pub fn kinds(&self, damage: Option<&LogDamage>) -> Vec<LogKind> {
        let plain = self.kinds.iter().map(|(kind, _)| *kind).filter(|kind| !kind.is_spoilt());
        damage.map(|damage| damage.kind).into_iter().chain(plain).collect()
    }

    /// The size of a kind that is drawn.
    fn size_of(&self, kind: LogKind) -> Option<Option<f64>> {
        self.kinds.iter().find(|(drawn, _)| *drawn == kind).map(|(_, size)| *size)
    }

    fn damage_stream(&self, kind: LogKind) -> ChaCha8Rng {
        stream(self.seed, DAMAGE + kind as u64)
    }
}

fn stream(seed: u64, number: u64) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(number);
    random
}
