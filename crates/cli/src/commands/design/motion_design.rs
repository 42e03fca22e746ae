use std::path::Path;

use logs::{PrepareSettings, Prepared, Run, centre_commands, prepare};
use next_motion::{DesignSettings, DesignedMotion, ExcitationDesign, Goal, Prospect, Question};
use robot::{Loaded, Robot};
use schemars::{JsonSchema, Schema};
use serde::Serialize;

use super::cause;
use super::diagnosis_file::DiagnosisFile;
use super::files::{self, JointMotion, MotionFiles};
use crate::design_error::DesignError;
use crate::error::CliError;
use crate::output::display_path;

/// Rate of a motion where neither log nor robot says one (Hz).
const RATE_HZ: f64 = 500.0;

/// Name and version of the schema of what `--json` prints.
const SCHEMA: &str = "plumbline.design/1";

/// What a motion is searched for.
pub struct MotionRequest<'a> {
    /// The robot that was diagnosed.
    pub loaded: &'a Loaded,
    /// A diagnosis and its logs, where there is one.
    pub diagnosed: Option<(&'a DiagnosisFile, &'a [Run])>,
    /// Two causes to tell apart, such as `FR01@elbow`, instead of what the diagnosis left open.
    pub separate: Option<[&'a str; 2]>,
    /// Length and seed.
    pub settings: DesignSettings,
}

/// The result of a search: the motion, where one is worth running, and its information.
pub struct MotionDesign {
    robot: Robot,
    design: ExcitationDesign,
    text: String,
    rate_hz: f64,
}

/// What `design --json` prints.
#[derive(Serialize, JsonSchema)]
pub struct DesignSummary {
    schema: &'static str,
    /// What is to be settled; none where nothing is open.
    goals: Vec<GoalSummary>,
    /// The motion; none where no motion settles anything.
    motion: Option<MotionSummary>,
}

/// What is to be settled, and what the motion is worth for it.
#[derive(Serialize, JsonSchema)]
struct GoalSummary {
    /// It in words.
    goal: String,
    /// Log evidence of the logs at hand (nats).
    logs_nats: f64,
    /// Log evidence of one run of the motion; none where no motion helps.
    motion_nats: Option<f64>,
    /// How often the motion is to be run; none where it settles nothing.
    runs: Option<usize>,
}

/// The motion that was written.
#[derive(Serialize, JsonSchema)]
struct MotionSummary {
    /// The motion as CSV, as Parquet and as a scenario.
    files: [String; 3],
    /// Its length.
    duration_s: f64,
    /// Rate of its samples.
    rate_hz: f64,
    /// One entry a joint, in the order of the robot.
    joints: Vec<JointMotion>,
}

impl DesignSummary {
    /// Its JSON schema.
    pub fn schema() -> Schema {
        report::written_schema::<Self>(SCHEMA, "Plumbline design")
    }
}

impl Default for DesignSummary {
    /// Nothing is open.
    fn default() -> Self {
        Self { schema: SCHEMA, goals: Vec::new(), motion: None }
    }
}

impl MotionDesign {
    /// Searches the motion that reaches the goals of a request.
    ///
    /// # Errors
    ///
    /// [`CliError::Design`] where there is nothing to settle or a cause has no place, and what the logs refuse.
    pub fn new(request: &MotionRequest) -> Result<Self, CliError> {
        let shaped = next_motion::with_trial_shapes(&request.loaded.robot);
        let robot = &shaped.robot;
        let goals = match request.separate {
            None => Vec::new(),
            Some(pair) => vec![goal_of_pair(pair, robot)?],
        };
        let (question, logs) = match request.diagnosed {
            None => (Question::without_logs(&shaped, goals), None),
            Some((diagnosis, runs)) => {
                let question = Question {
                    shaped: &shaped,
                    goals: if goals.is_empty() { diagnosis.goals(robot)? } else { goals },
                    findings: diagnosis.findings(robot)?,
                    noise: diagnosis.noise(),
                    cutoff_hz: diagnosis.cutoff_hz(),
                };
                if question.goals.is_empty() {
                    return Err(DesignError::NothingOpen { path: diagnosis.path() }.into());
                }
                (question, Some(prepare_logs(request.loaded, diagnosis, runs)?))
            }
        };
        let design = next_motion::design(&question, logs.as_ref(), &request.settings);
        let design = design.map_err(DesignError::from)?;
        let text = files::words(&design, robot, logs.as_ref());
        let rate_hz = rate_hz(request.loaded, logs.as_ref());
        Ok(Self { robot: shaped.robot, design, text, rate_hz })
    }

    /// What the motion is for and what it brings, goal by goal.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// What the motion is worth, goal by goal: what it is for, and the nats of log evidence of the logs at hand and of
    /// one run of it; none where no motion helps.
    pub fn worth(&self) -> Vec<(String, f64, Option<f64>)> {
        let of = |p: &Prospect| (files::title(p.goal, &self.robot), p.before, p.after);
        self.design.prospects.iter().map(of).collect()
    }

    /// What is printed for programs, of a motion that was written into a folder.
    pub fn summary(&self, out: Option<&Path>) -> DesignSummary {
        let goal = |p: &Prospect| GoalSummary {
            goal: files::title(p.goal, &self.robot),
            logs_nats: p.before,
            motion_nats: p.after,
            runs: p.runs(),
        };
        let motion = |out: &Path| -> Option<MotionSummary> {
            Some(MotionSummary {
                files: files::FILES.map(|name| display_path(&out.join(name))),
                duration_s: self.motion()?.motion.duration_s(),
                rate_hz: self.rate_hz,
                joints: files::joint_motions(&self.run()?),
            })
        };
        DesignSummary {
            goals: self.design.prospects.iter().map(goal).collect(),
            motion: out.and_then(motion),
            ..DesignSummary::default()
        }
    }

    /// The motion as a log: positions, velocities, accelerations (rad or m, s) and the effort to expect (N m or N);
    /// none where no motion would settle anything.
    pub fn run(&self) -> Option<Run> {
        Some(files::run_of(&self.robot, self.motion()?, self.rate_hz))
    }

    /// Writes the motion as a log of the reference and as a scenario of the robot in a file, and
    /// says where. Returns none where there is no motion.
    ///
    /// # Errors
    ///
    /// [`CliError::Folder`], and what the disk refuses.
    pub fn write(&self, out: &Path, robot_file: &Path) -> Result<Option<String>, CliError> {
        let (Some(designed), Some(run)) = (self.motion(), self.run()) else { return Ok(None) };
        let files = MotionFiles {
            robot: &self.robot,
            robot_file,
            text: &self.text,
            designed,
            run: &run,
            rate_hz: self.rate_hz,
        };
        files.write(out).map(Some)
    }

    /// The motion, where running it tells something.
    fn motion(&self) -> Option<&DesignedMotion> {
        let is_useful = self.design.prospects.iter().any(|p| p.runs().is_some());
        self.design.motion.as_ref().filter(|_| is_useful)
    }
}

/// Two causes that are to be told apart.
fn goal_of_pair([one, other]: [&str; 2], robot: &Robot) -> Result<Goal, CliError> {
    let [finding, rival] = [cause::parse(one, robot)?, cause::parse(other, robot)?];
    Ok(Goal::Separate { finding, rival })
}

/// The logs that were diagnosed, prepared as they were then.
fn prepare_logs(
    loaded: &Loaded,
    diagnosis: &DiagnosisFile,
    runs: &[Run],
) -> Result<Prepared, CliError> {
    let settings = PrepareSettings { cutoff_hz: Some(diagnosis.cutoff_hz()) };
    let mut prepare_logs = prepare(runs, &settings)?;
    centre_commands(&loaded.robot, &mut prepare_logs.runs, loaded.control.rate_hz);
    Ok(prepare_logs)
}

/// Rate at which the motion is written (Hz): that of the logs, or else of the controller.
fn rate_hz(loaded: &Loaded, logs: Option<&Prepared>) -> f64 {
    let of_logs = logs.and_then(|l| l.runs.iter().map(|run| run.rate_hz).reduce(f64::max));
    of_logs.or(loaded.control.rate_hz).unwrap_or(RATE_HZ)
}
