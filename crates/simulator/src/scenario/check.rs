use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use document::{Document, DocumentError, KeyPath};
use motion::{Motion, MotionError};
use robot::{Loaded, PdGain, Robot};

use crate::effects::mistake::Mistake;
use crate::effects::spec::EffectSpec;
use crate::error::SimulatorError;
use crate::scenario::resolved::resolve;
use crate::scenario::spec::{HiddenSpec, ScenarioSpec};
use crate::sensors::{JointSensor, LinkEncoder, Sensors, VelocitySource};
use crate::simulator::Stepping;
use crate::strangers::spec::StrangerSpec;
use crate::{effects, strangers};

/// A checked scenario, ready to run.
#[derive(Debug, Clone)]
pub struct Scenario {
    spec: ScenarioSpec,
    robot: Robot,
    robot_file: PathBuf,
    resolved: String,
    gains: Vec<PdGain>,
    stepping: Stepping,
    rows_per_log: usize,
    runs: Vec<ScenarioRun>,
}

/// One run of a scenario.
#[derive(Debug, Clone)]
pub struct ScenarioRun {
    /// Name of the log's file, without extension.
    pub name: String,
    /// The motion that is followed.
    pub motion: Motion,
    /// Time for which the arm is held before the log begins (s).
    pub lead_in_s: f64,
    /// Effects of this run alone.
    pub effects: Vec<EffectSpec>,
}

impl Scenario {
    /// Reads a scenario from a document.
    ///
    /// # Errors
    ///
    /// [`SimulatorError::Scenario`] at the value at fault, also for a robot or a log that cannot be used.
    pub fn from_document(document: &Document) -> Result<Self, SimulatorError> {
        let spec: ScenarioSpec = document.parse()?;
        let robot_key = KeyPath::root().key("robot");
        let robot_file = document.directory_of(&robot_key).join(&spec.robot);
        let loaded = Robot::load(&robot_file).map_err(|e| {
            document.mistake(&robot_key, format!("the robot cannot be used: {e}"), None)
        })?;
        let check = Checker { document, spec: &spec, loaded: &loaded };
        let stepping = check.stepping()?;
        let gains = check.gains()?;
        check.servo()?;
        check.sensors()?;
        check.effects()?;
        check.strangers()?;
        check.hidden()?;
        let rows_per_log = check.rows_per_log()?;
        let runs = check.runs()?;
        let resolved = resolve(document, &spec);
        Ok(Self {
            robot: loaded.robot,
            robot_file,
            resolved,
            gains,
            stepping,
            rows_per_log,
            runs,
            spec,
        })
    }

    /// The robot without effects.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Path of the robot.
    pub fn robot_file(&self) -> &Path {
        &self.robot_file
    }

    /// The scenario as one self-contained text.
    pub fn self_contained_text(&self) -> &str {
        &self.resolved
    }

    /// Its runs.
    pub fn runs(&self) -> &[ScenarioRun] {
        &self.runs
    }

    /// Seed of every draw.
    pub fn seed(&self) -> u64 {
        self.spec.seed
    }

    /// The effects that it states.
    pub fn effects(&self) -> &[EffectSpec] {
        &self.spec.effect
    }

    /// The strangers that it states.
    pub fn strangers(&self) -> &[StrangerSpec] {
        &self.spec.stranger
    }

    /// The hidden effects to draw.
    pub fn hidden(&self) -> Option<&HiddenSpec> {
        self.spec.hidden.as_ref()
    }

    /// The same arm with these effects and none to be drawn.
    pub(crate) fn with_effects(&self, effects: Vec<EffectSpec>) -> Self {
        let spec = ScenarioSpec { effect: effects, hidden: None, ..self.spec.clone() };
        Self { spec, ..self.clone() }
    }

    /// Its values.
    pub fn spec(&self) -> &ScenarioSpec {
        &self.spec
    }

    pub(crate) fn gains(&self) -> &[PdGain] {
        &self.gains
    }

    /// Time from one command of the controller to the next (s).
    pub fn period_s(&self) -> f64 {
        self.stepping.step_s * self.stepping.steps_per_period.max(1) as f64
    }

    pub(crate) fn stepping(&self) -> Stepping {
        self.stepping
    }

    /// Periods of the controller per row of the log.
    pub(crate) fn rows_per_log(&self) -> usize {
        self.rows_per_log
    }

    /// The sensors of a run, with a seed of its own.
    pub(crate) fn sensors(&self, seed: u64) -> Sensors {
        let s = &self.spec.sensors;
        let of = |map: &BTreeMap<String, f64>, name: &str| map.get(name).copied().unwrap_or(0.0);
        let joint = |name: &str| JointSensor {
            resolution: of(&s.position_resolution_rad, name),
            position_noise: of(&s.position_noise_rad, name),
            effort_noise: of(&s.effort_noise_nm, name),
        };
        let (steps, noises) = (&s.link_position_resolution_rad, &s.link_position_noise_rad);
        let link = |name: &str| {
            let has_one = steps.contains_key(name) || noises.contains_key(name);
            has_one.then(|| LinkEncoder { resolution: of(steps, name), noise: of(noises, name) })
        };
        let joints = self.robot.joint_names().map(joint).collect();
        let links = self.robot.joint_names().map(link).collect();
        let steps = self.robot.joint_names().map(|name| of(&s.effort_resolution_nm, name));
        Sensors::new(s.position, s.effort, s.velocity, joints, seed)
            .with_links(links)
            .with_link_lag(1e-3 * s.link_position_lag_ms)
            .with_effort_steps(steps.collect())
    }

    /// The same sensors without any error: no noise, no steps, no lag, and velocity as it is.
    pub(crate) fn noise_free_sensors(&self) -> Sensors {
        let s = &self.spec.sensors;
        let joint = JointSensor { resolution: 0.0, position_noise: 0.0, effort_noise: 0.0 };
        let ideal = LinkEncoder { resolution: 0.0, noise: 0.0 };
        let (steps, noises) = (&s.link_position_resolution_rad, &s.link_position_noise_rad);
        let link =
            |name: &str| (steps.contains_key(name) || noises.contains_key(name)).then_some(ideal);
        let links = self.robot.joint_names().map(link).collect();
        let joints = vec![joint; self.robot.joint_count()];
        Sensors::new(s.position, s.effort, VelocitySource::Ideal, joints, 0).with_links(links)
    }
}

struct Checker<'a> {
    document: &'a Document,
    spec: &'a ScenarioSpec,
    loaded: &'a Loaded,
}

impl Checker<'_> {
    fn mistake(&self, path: &KeyPath, message: String) -> DocumentError {
        self.document.mistake(path, message, None)
    }

    /// Refuses a number outside of `low..=high`.
    fn within(&self, path: &KeyPath, value: f64, low: f64, high: f64) -> Result<(), DocumentError> {
        if value.is_finite() && (low..=high).contains(&value) {
            return Ok(());
        }
        let message = format!("{value}, a number from {low} to {high} was expected");
        Err(self.mistake(path, message))
    }

    fn stepping(&self) -> Result<Stepping, DocumentError> {
        let engine = KeyPath::root().key("engine").key("step_ms");
        let control = KeyPath::root().key("control").key("rate_hz");
        self.within(&engine, self.spec.engine.step_ms, 0.001, 5.0)?;
        let rate = self.control_rate_hz();
        self.within(&control, rate, 1.0, 20_000.0)?;
        let step_s = 1e-3 * self.spec.engine.step_ms;
        let steps = 1.0 / (rate * step_s);
        if steps < 0.5 || (steps - steps.round()).abs() > 1e-6 {
            let message = format!(
                "{} ms goes {steps:.4} times into the {} ms of a period of control at {rate} Hz, a whole number was expected",
                self.spec.engine.step_ms,
                1e3 / rate
            );
            return Err(self.mistake(&engine, message));
        }
        Ok(Stepping {
            step_s,
            steps_per_period: steps.round() as usize,
            stops: self.spec.engine.joint_stops,
            order: self.spec.engine.order,
        })
    }

    fn control_rate_hz(&self) -> f64 {
        self.spec.control.rate_hz.or(self.loaded.control.rate_hz).unwrap_or(500.0)
    }

    fn gains(&self) -> Result<Vec<PdGain>, DocumentError> {
        let control = KeyPath::root().key("control");
        let settings = &self.loaded.control;
        let mut gains: Vec<Option<PdGain>> = match &self.spec.control.gains {
            None => settings.gains.clone(),
            Some(name) => match settings.gain_sets.get(name) {
                Some(set) => set.iter().copied().map(Some).collect(),
                None => {
                    let names: Vec<&str> = settings.gain_sets.keys().map(String::as_str).collect();
                    let path = control.key("gains");
                    return Err(self.document.unknown_name(&path, "set of gains", name, &names));
                }
            },
        };
        gains.resize(self.loaded.robot.joint_count(), None);
        for (key, map) in [
            ("kp_nm_per_rad", &self.spec.control.kp_nm_per_rad),
            ("kd_nm_s_per_rad", &self.spec.control.kd_nm_s_per_rad),
        ] {
            self.by_joint(&control.key(key), map, 1e6)?;
            for (name, &value) in map {
                let Some(joint) = self.loaded.robot.joint_index(name) else { continue };
                let gain = gains[joint].get_or_insert(PdGain { kp: 0.0, kd: 0.0 });
                if key == "kp_nm_per_rad" { gain.kp = value } else { gain.kd = value }
            }
        }
        let missing = gains.iter().position(Option::is_none);
        if let Some(name) = missing.and_then(|i| self.loaded.robot.joint_names().nth(i)) {
            return Err(self.no_gains(name));
        }
        Ok(gains.into_iter().flatten().collect())
    }

    fn servo(&self) -> Result<(), DocumentError> {
        let Some(servo) = self.spec.control.servo else { return Ok(()) };
        let path = KeyPath::root().key("control").key("servo");
        self.within(&path.key("goal_rate_hz"), servo.goal_rate_hz, 1.0, self.control_rate_hz())?;
        self.within(&path.key("goal_delay_ms"), servo.goal_delay_ms, 0.0, 1000.0)
    }

    /// The error for a joint without gains, shown at the given gains or else at the robot.
    fn no_gains(&self, joint: &str) -> DocumentError {
        let given = &self.spec.control;
        let is_silent = given.gains.is_none()
            && given.kp_nm_per_rad.is_empty()
            && given.kd_nm_s_per_rad.is_empty();
        let path = KeyPath::root().key(if is_silent { "robot" } else { "control" });
        let message = format!("joint {joint} has no gains, neither in the robot's file nor here");
        let help = "`plumbline robot init` writes a robot.toml with guessed ones; `control` takes `gains`, \
                    or `kp_nm_per_rad` and `kd_nm_s_per_rad`";
        self.document.mistake(&path, message, Some(help.to_owned()))
    }

    /// Refuses joints that the robot does not have, and values outside of `0..=high`.
    fn by_joint(
        &self,
        path: &KeyPath,
        map: &BTreeMap<String, f64>,
        high: f64,
    ) -> Result<(), DocumentError> {
        let names: Vec<&str> = self.loaded.robot.joint_names().collect();
        for (name, &value) in map {
            let path = path.key(name.clone());
            if !names.contains(&name.as_str()) {
                return Err(self.document.unknown_name(&path, "joint", name, &names));
            }
            self.within(&path, value, 0.0, high)?;
        }
        Ok(())
    }

    fn sensors(&self) -> Result<(), DocumentError> {
        let path = KeyPath::root().key("sensors");
        let s = &self.spec.sensors;
        self.by_joint(&path.key("position_resolution_rad"), &s.position_resolution_rad, 0.1)?;
        self.by_joint(&path.key("position_noise_rad"), &s.position_noise_rad, 0.1)?;
        let steps = &s.link_position_resolution_rad;
        self.by_joint(&path.key("link_position_resolution_rad"), steps, 0.1)?;
        let noises = &s.link_position_noise_rad;
        self.by_joint(&path.key("link_position_noise_rad"), noises, 0.1)?;
        self.by_joint(&path.key("effort_noise_nm"), &s.effort_noise_nm, 1000.0)?;
        self.by_joint(&path.key("effort_resolution_nm"), &s.effort_resolution_nm, 1000.0)?;
        self.link_lag(&path.key("link_position_lag_ms"))?;
        if let Some(dropouts) = s.dropouts {
            let path = path.key("dropouts");
            self.within(&path.key("per_minute"), dropouts.per_minute, 0.0, 60.0)?;
            self.within(&path.key("length_ms"), dropouts.length_ms, 1.0, 2000.0)?;
        }
        self.within(&path.key("dropped_share"), s.dropped_share, 0.0, 0.5)?;
        if let VelocitySource::FilteredDifference { cutoff_hz } = s.velocity {
            let path = path.key("velocity").key("filtered_difference").key("cutoff_hz");
            self.within(&path, cutoff_hz, 0.1, 0.5 * self.control_rate_hz())?;
        }
        let fifth_ms = 200.0 / s.log_rate_hz.unwrap_or(self.control_rate_hz());
        self.within(&path.key("time_jitter_ms"), s.time_jitter_ms, 0.0, fifth_ms)
    }

    fn link_lag(&self, path: &KeyPath) -> Result<(), DocumentError> {
        let s = &self.spec.sensors;
        self.within(path, s.link_position_lag_ms, 0.0, 1000.0)?;
        let none =
            s.link_position_resolution_rad.is_empty() && s.link_position_noise_rad.is_empty();
        if s.link_position_lag_ms > 0.0 && none {
            let message = format!(
                "{} ms for no encoder at a link, 0 was expected, or a joint in link_position_resolution_rad",
                s.link_position_lag_ms
            );
            return Err(self.mistake(path, message));
        }
        Ok(())
    }

    fn rows_per_log(&self) -> Result<usize, DocumentError> {
        let rate = self.control_rate_hz();
        let Some(log_rate) = self.spec.sensors.log_rate_hz else { return Ok(1) };
        let path = KeyPath::root().key("sensors").key("log_rate_hz");
        self.within(&path, log_rate, 0.1, rate)?;
        let rows = rate / log_rate;
        if (rows - rows.round()).abs() > 1e-9 * rows {
            let message = format!(
                "{log_rate} Hz, a whole part of the controller's {rate} Hz was expected, such as {} Hz",
                rate / rows.round()
            );
            return Err(self.mistake(&path, message));
        }
        Ok(rows.round() as usize)
    }

    fn effects(&self) -> Result<(), DocumentError> {
        self.effects_at(&KeyPath::root().key("effect"), &self.spec.effect)
    }

    /// Refuses effects, stated at `path`, that the robot cannot have.
    fn effects_at(&self, path: &KeyPath, stated: &[EffectSpec]) -> Result<(), DocumentError> {
        let Err((index, mistake)) = effects::chain::inject_all(stated, &self.loaded.robot) else {
            return Ok(());
        };
        let name = stated[index].kind().name();
        Err(self.mistake_in(path.clone().index(index).key(name), mistake))
    }

    fn strangers(&self) -> Result<(), DocumentError> {
        let injected = strangers::chain::inject_all(&self.spec.stranger, &self.loaded.robot);
        let Err((index, mistake)) = injected else { return Ok(()) };
        let name = self.spec.stranger[index].kind().name();
        let path = KeyPath::root().key("stranger").index(index).key(name);
        Err(self.mistake_in(path, mistake))
    }

    /// A mistake of an effect or a stranger that stands at `path`.
    fn mistake_in(&self, path: KeyPath, mistake: Mistake) -> DocumentError {
        let path = mistake.key.split('.').fold(path, |path, key| path.key(key));
        self.mistake(&path, mistake.found)
    }

    fn hidden(&self) -> Result<(), DocumentError> {
        let Some(hidden) = &self.spec.hidden else { return Ok(()) };
        let path = KeyPath::root().key("hidden");
        let [low, high] = hidden.count;
        if low > high || high > 20 {
            let message =
                format!("[{low}, {high}], the least and the largest number up to 20 were expected");
            return Err(self.mistake(&path.key("count"), message));
        }
        let [least, largest] = hidden.torque_share;
        if !(least > 0.0 && least <= largest && largest <= 1.0) {
            let message = format!(
                "[{least}, {largest}], the least and the largest share above 0 up to 1 were expected"
            );
            return Err(self.mistake(&path.key("torque_share"), message));
        }
        Ok(())
    }

    fn runs(&self) -> Result<Vec<ScenarioRun>, SimulatorError> {
        let path = KeyPath::root().key("run");
        let mut names = BTreeSet::new();
        if self.spec.run.is_empty() {
            return Err(self.mistake(&path, "no run, at least one was expected".into()).into());
        }
        let mut runs = Vec::with_capacity(self.spec.run.len());
        for (i, run) in self.spec.run.iter().enumerate() {
            let path = path.index(i);
            if !is_file_stem(&run.name) {
                let message = format!(
                    "{:?}, a name of letters, digits, - and _ was expected: the log's file is called so",
                    run.name
                );
                return Err(self.mistake(&path.key("name"), message).into());
            }
            if !names.insert(&run.name) {
                let message = format!("there are two runs called {}", run.name);
                return Err(self.mistake(&path.key("name"), message).into());
            }
            self.within(&path.key("lead_in_s"), run.lead_in_s, 0.0, 600.0)?;
            self.effects_at(&path.key("effect"), &run.effect)?;
            let path = path.key("motion");
            let folder = self.document.directory_of(&path);
            let motion = run
                .motion
                .build(&self.loaded.robot, folder)
                .map_err(|error| self.motion_mistake(&path, &error))?;
            runs.push(ScenarioRun {
                name: run.name.clone(),
                motion,
                lead_in_s: run.lead_in_s,
                effects: run.effect.clone(),
            });
        }
        Ok(runs)
    }

    fn motion_mistake(&self, path: &KeyPath, error: &MotionError) -> DocumentError {
        let inside: KeyPath = error.key().parse().unwrap_or_else(|_| KeyPath::root());
        let segments = path.segments().iter().chain(inside.segments()).cloned();
        self.mistake(&segments.collect(), error.to_string())
    }
}

fn is_file_stem(name: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    !name.is_empty() && name.len() <= 100 && name.chars().all(plain)
}
