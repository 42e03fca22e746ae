use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, Normal};
use robot::Reading;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::delay_line::DelayLine;
use crate::seed::mix_seed;

/// The part of a seed that the encoders at the links draw from.
const LINKS: u64 = 2;

/// Where position is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PositionSide {
    /// At the motor, before the transmission.
    #[default]
    Motor,
    /// At the link, behind it.
    Link,
}

/// What the log's effort is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EffortSource {
    /// What the controller asked for.
    #[default]
    Commanded,
    /// Torque of the motor, as from its current.
    Motor,
    /// Torque behind the transmission, as from a joint torque sensor.
    Link,
}

/// How velocity comes to be.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum VelocitySource {
    /// As it is, without error.
    Ideal,
    /// Difference of measured positions, through a first-order low pass (Hz).
    FilteredDifference {
        /// Corner frequency (Hz).
        cutoff_hz: f64,
    },
}

/// Sensors of one joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointSensor {
    /// Step of the position reading (rad or m), zero for none.
    pub resolution: f64,
    /// Standard deviation of the position reading (rad or m).
    pub position_noise: f64,
    /// Standard deviation of the effort reading (N m or N).
    pub effort_noise: f64,
}

/// An encoder at the link of a joint, beside the sensor that the controller reads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkEncoder {
    /// Step of its reading (rad or m), zero for none.
    pub resolution: f64,
    /// Standard deviation of its reading (rad or m).
    pub noise: f64,
}

/// The sensors of an arm. Every draw comes from their seed.
#[derive(Debug, Clone)]
pub struct Sensors {
    side: PositionSide,
    effort: EffortSource,
    velocity: VelocitySource,
    joints: Vec<JointSensor>,
    /// The encoder at the link of each joint; `None` for a joint without one.
    links: Vec<Option<LinkEncoder>>,
    /// Step of the effort reading of each joint (N m or N), zero for none.
    effort_steps: Vec<f64>,
    link_lag: LinkLag,
    seed: u64,
    random: ChaCha8Rng,
    /// A separate stream, so that a second encoder does not change the noise of other sensors.
    link_random: ChaCha8Rng,
    /// Last measured position of each joint, once there is one.
    last: Option<Vec<f64>>,
    filtered: Vec<f64>,
}

impl Sensors {
    /// Sensors of every joint in the order of the robot.
    pub fn new(
        side: PositionSide,
        effort: EffortSource,
        velocity: VelocitySource,
        joints: Vec<JointSensor>,
        seed: u64,
    ) -> Self {
        let filtered = vec![0.0; joints.len()];
        let links = vec![None; joints.len()];
        let [random, link_random] = streams(seed);
        Self {
            side,
            effort,
            velocity,
            effort_steps: filtered.clone(),
            joints,
            links,
            link_lag: LinkLag::new(0.0, 0),
            seed,
            random,
            link_random,
            last: None,
            filtered,
        }
    }

    /// The same with encoders at some of the links, in the order of the robot.
    pub fn with_links(self, links: Vec<Option<LinkEncoder>>) -> Self {
        Self { links, ..self }
    }

    /// The same with encoders at the links that lag by a time (s).
    pub fn with_link_lag(self, lag_s: f64) -> Self {
        Self { link_lag: LinkLag::new(lag_s, self.joints.len()), ..self }
    }

    /// The same with steps of the effort readings (N m or N), in the order of the robot.
    pub fn with_effort_steps(self, effort_steps: Vec<f64>) -> Self {
        Self { effort_steps, ..self }
    }

    /// Sensors without error.
    pub fn perfect(joint_count: usize) -> Self {
        let joint = JointSensor { resolution: 0.0, position_noise: 0.0, effort_noise: 0.0 };
        Self::new(
            PositionSide::Link,
            EffortSource::Motor,
            VelocitySource::Ideal,
            vec![joint; joint_count],
            0,
        )
    }

    pub(crate) fn position_side(&self) -> PositionSide {
        self.side
    }

    pub(crate) fn effort_source(&self) -> EffortSource {
        self.effort
    }

    /// Resets the sensors and restarts their random draws.
    pub(crate) fn start(&mut self) {
        [self.random, self.link_random] = streams(self.seed);
        self.last = None;
        self.filtered.fill(0.0);
        self.link_lag.clear();
    }

    /// Records the link positions at a time (s), which must be later than all before.
    pub(crate) fn watch_links(&mut self, time_s: f64, q: &[f64]) {
        self.link_lag.watch(time_s, q);
    }

    /// Replaces true positions and velocities by sensor readings, one period after the last call.
    ///
    /// ```text
    /// q_measured = resolution round((q + noise) / resolution)
    /// qd_measured: first-order low pass of the difference of q_measured
    /// ```
    pub(crate) fn measure(&mut self, reading: &mut Reading, period_s: f64) {
        for (q, sensor) in reading.q.iter_mut().zip(&self.joints) {
            *q += draw(&mut self.random, sensor.position_noise);
            *q = round_to_step(*q, sensor.resolution);
        }
        if let VelocitySource::FilteredDifference { cutoff_hz } = self.velocity {
            let kept = (-std::f64::consts::TAU * cutoff_hz * period_s).exp();
            if let Some(last) = &self.last {
                for (i, filtered) in self.filtered.iter_mut().enumerate() {
                    let difference = (reading.q[i] - last[i]) / period_s;
                    *filtered = kept * *filtered + (1.0 - kept) * difference;
                }
            }
            reading.qd.copy_from_slice(&self.filtered);
        }
        self.last = Some(reading.q.clone());
    }

    /// Readings of the encoders at the links at a time (s), from the true positions of the links.
    pub(crate) fn measure_links(&mut self, time_s: f64, q: &[f64]) -> Vec<Option<f64>> {
        let q = self.link_lag.read(time_s, q);
        let mut reading = |encoder: LinkEncoder, q: f64| {
            round_to_step(q + draw(&mut self.link_random, encoder.noise), encoder.resolution)
        };
        self.links.iter().zip(q).map(|(link, &q)| link.map(|link| reading(link, q))).collect()
    }

    /// Adds the noise of the effort readings, and rounds them to their steps.
    pub(crate) fn add_effort_noise(&mut self, effort: &mut [f64]) {
        for (tau, sensor) in effort.iter_mut().zip(&self.joints) {
            *tau += draw(&mut self.random, sensor.effort_noise);
        }
        for (tau, step) in effort.iter_mut().zip(&self.effort_steps) {
            *tau = round_to_step(*tau, *step);
        }
    }
}

/// Delays the readings of the encoders at the links: positions of the engine's steps, linear between them.
#[derive(Debug, Clone)]
struct LinkLag {
    lag_s: f64,
    lines: Vec<DelayLine>,
    /// Positions at the time of the last step minus the lag (rad or m); empty before the first step.
    earlier: Vec<f64>,
}

impl LinkLag {
    fn new(lag_s: f64, joint_count: usize) -> Self {
        Self { lag_s, lines: vec![DelayLine::new(lag_s); joint_count], earlier: Vec::new() }
    }

    fn clear(&mut self) {
        self.lines.iter_mut().for_each(DelayLine::clear);
        self.earlier.clear();
    }

    fn watch(&mut self, time_s: f64, q: &[f64]) {
        if self.lag_s > 0.0 {
            let lines = self.lines.iter_mut().zip(q);
            self.earlier = lines.map(|(line, q)| line.pass(time_s, *q)).collect();
        }
    }

    /// The delayed positions; `q` itself without a lag.
    fn read<'a>(&'a mut self, time_s: f64, q: &'a [f64]) -> &'a [f64] {
        if self.lag_s <= 0.0 {
            return q;
        }
        if self.earlier.is_empty() {
            self.watch(time_s, q);
        }
        &self.earlier
    }
}

/// The draws of the sensors that the controller reads, and those of the encoders at the links.
fn streams(seed: u64) -> [ChaCha8Rng; 2] {
    [seed, mix_seed(seed, LINKS)].map(ChaCha8Rng::seed_from_u64)
}

/// Rounds to whole counts; a resolution of zero rounds nothing.
fn round_to_step(q: f64, resolution: f64) -> f64 {
    if resolution > 0.0 { resolution * (q / resolution).round() } else { q }
}

/// One draw from a normal distribution about zero; a deviation of zero draws nothing.
fn draw(random: &mut ChaCha8Rng, deviation: f64) -> f64 {
    if deviation <= 0.0 {
        return 0.0;
    }
    Normal::new(0.0, deviation).map_or(0.0, |n| n.sample(random))
}
