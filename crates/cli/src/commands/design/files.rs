use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use effects::{Frame, RunMotion as Along};
use logs::{Channels, Prepared, Run};
use motion::{MotionSpec, State};
use next_motion::{DesignedMotion, ExcitationDesign, Goal, Prospect, SEPARATING_NATS};
use robot::Robot;
use schemars::JsonSchema;
use serde::Serialize;

use super::cause;
use crate::error::CliError;
use crate::escape::escape_line;
use crate::output::{create_folder, display_path, table};

/// Names of the files: twice the signals, and the scenario.
pub const FILES: [&str; 3] = ["motion.csv", "motion.parquet", "motion.toml"];

/// Columns of a sentence.
const WIDTH: usize = 96;

/// What the motion is for and what it brings, goal by goal.
pub fn words(design: &ExcitationDesign, robot: &Robot, logs: Option<&Prepared>) -> String {
    let runs = logs.map_or_else(Default::default, |logs| logs.runs.as_slice());
    let logged: f64 = runs.iter().map(|run| run.time.len() as f64 / run.rate_hz).sum();
    let length = design.motion.as_ref().map_or(0.0, |m| m.motion.duration_s());
    let of = |prospect: &Prospect| {
        let (title, help) = titles(prospect.goal, robot);
        let sentence = sentence(prospect, [logged, length], help);
        let lines = report::pack(sentence.split_whitespace(), " ", WIDTH - 2);
        format!("{title}\n  {}\n", lines.join("\n  "))
    };
    design.prospects.iter().map(of).collect()
}

/// What a goal is, in words.
pub fn title(goal: Goal, robot: &Robot) -> String {
    titles(goal, robot).0
}

/// What a goal is, and what else than a motion would serve it.
fn titles(goal: Goal, robot: &Robot) -> (String, &'static str) {
    let words = |c| cause::words(c, robot);
    match goal {
        Goal::Separate { finding, rival } => {
            let help = finding.kind.distinguishing_motion([rival.kind]).unwrap_or_default();
            (format!("{} or {}", words(finding), words(rival)), help)
        }
        Goal::Determine { finding } => {
            (format!("the size of {}", words(finding)), finding.kind.entry().needs)
        }
    }
}

fn sentence(prospect: &Prospect, [logged, length]: [f64; 2], help: &str) -> String {
    let digits = |nats: f64| report::significant(nats, 2);
    let before = prospect.before;
    let Some(after) = prospect.after else {
        return match prospect.goal {
            Goal::Separate { .. } => format!(
                "no motion tells them apart: what one adds the other can add whatever the joints \
                 do. What helps: {help}"
            ),
            Goal::Determine { .. } => format!("no motion shows it. What helps: {help}"),
        };
    };
    let sizes = if logged > 0.0 {
        "at the sizes that the logs give them"
    } else {
        "at a tenth of what is believed possible, over a noise of 1 % of the effort limits"
    };
    match (prospect.goal, prospect.runs()) {
        (Goal::Separate { .. }, None) => format!(
            "no motion of {length:.0} s within the robot's limits was found that tells them apart: \
             {sizes} the best is worth {} nats of log evidence, {SEPARATING_NATS} are needed. What may \
             help: {help}",
            digits(after)
        ),
        (Goal::Separate { .. }, Some(runs)) => format!(
            "this motion tells them apart{}: its {length:.0} s are worth {} nats of log evidence \
             {sizes}, {SEPARATING_NATS} are needed{}",
            if runs > 1 { format!(", run {runs} times") } else { String::new() },
            digits(after),
            if before > 0.0 {
                let [same, times] = [before * length / logged, after / before * logged / length];
                format!(
                    "; {length:.0} s of the logs were worth {} ({} times less)",
                    digits(same),
                    digits(times)
                )
            } else {
                String::new()
            }
        ),
        (Goal::Determine { .. }, runs) => format!(
            "{length:.0} s of {} motion halve the width of an interval {:.1} times",
            if runs.is_some() { "this" } else { "the best" },
            (after - before) / std::f64::consts::LN_2
        ),
    }
}

/// A scenario with nothing but a robot and a motion.
#[derive(Serialize)]
struct Scenario<'a> {
    robot: PathBuf,
    run: [OneRun<'a>; 1],
}

#[derive(Serialize)]
struct OneRun<'a> {
    name: &'static str,
    motion: &'a MotionSpec,
}

/// A motion and what is written beside it.
pub struct MotionFiles<'a> {
    /// The robot that moves.
    pub robot: &'a Robot,
    /// The file that describes it.
    pub robot_file: &'a Path,
    /// What the motion is for and what it brings.
    pub text: &'a str,
    /// The motion.
    pub designed: &'a DesignedMotion,
    /// The same as a log.
    pub run: &'a Run,
    /// Samples of the log per second (Hz).
    pub rate_hz: f64,
}

impl MotionFiles<'_> {
    /// Writes the motion as a log of the reference and as a scenario, and says where.
    pub fn write(&self, out: &Path) -> Result<String, CliError> {
        create_folder(out)?;
        logs::write_csv(&out.join(FILES[0]), self.run)?;
        logs::write_parquet(&out.join(FILES[1]), self.run)?;
        let path = self.robot_file.canonicalize().unwrap_or_else(|_| self.robot_file.to_owned());
        let scenario =
            Scenario { robot: path, run: [OneRun { name: "motion", motion: &self.designed.spec }] };
        let toml = toml::to_string(&scenario).map_err(std::io::Error::other)?;
        let comment: String =
            self.text.lines().map(|line| format!("# {}\n", escape_line(line))).collect();
        logs::replace_file(&out.join(FILES[2]), |file| Ok(write!(file, "{comment}\n{toml}")?))?;
        let [csv, parquet, toml] = FILES.map(|name| display_path(&out.join(name)));
        Ok(format!(
            "\n{}\nObstacles are not known here: look at the motion before it is run.\n\n\
             motion    {csv} and {parquet}:\n          \
             position, velocity, acceleration and the effort to expect, {:.0} Hz\n\
             scenario  {toml} (plumbline simulate)\n\
             then      plumbline diagnose, its log together with those there are\n",
            summary(self.robot, self.run),
            self.rate_hz,
        ))
    }
}

/// Where a joint goes, how fast, and with how much effort: rad or m, per second, N m or N.
#[derive(Serialize, JsonSchema)]
pub struct JointMotion {
    name: String,
    /// Its first position (rad or m).
    starts_at: f64,
    /// Its lowest position (rad or m).
    lowest: f64,
    /// Its highest position (rad or m).
    highest: f64,
    /// Its highest speed (rad/s or m/s).
    fastest: f64,
    /// The largest effort to expect (N m or N).
    most_effort: f64,
}

/// Where each joint goes in a motion.
pub fn joint_motions(run: &Run) -> Vec<JointMotion> {
    let largest = |x: &[f64]| x.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let of = |channels: &Channels| JointMotion {
        name: channels.name.clone(),
        starts_at: channels.position.first().copied().unwrap_or(0.0),
        lowest: channels.position.iter().copied().fold(f64::INFINITY, f64::min),
        highest: channels.position.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        fastest: channels.velocity.as_deref().map_or(0.0, largest),
        most_effort: largest(&channels.effort),
    };
    run.joints.iter().map(of).collect()
}

/// The same as a table.
fn summary(robot: &Robot, run: &Run) -> String {
    let rows = joint_motions(run).into_iter().zip(robot.links()).map(|(joint, link)| {
        let JointMotion { name, starts_at, lowest, highest, fastest, most_effort } = joint;
        let (way, torque) =
            if link.joint.kind.is_rotation() { ("rad", "N·m") } else { ("m", "N") };
        let (moves, speed) = match fastest > 0.0 {
            true => (format!("{lowest:.2} to {highest:.2} {way}"), format!("{fastest:.2} {way}/s")),
            false => ("rests".to_owned(), String::new()),
        };
        let effort = format!("{most_effort:.1} {torque}");
        vec![name, format!("{starts_at:.2} {way}"), moves, speed, effort]
    });
    table(&["joint", ">starts at", ">moves over", ">fastest", ">most effort"], rows)
}

/// The motion as a log: positions, velocities, accelerations and the effort that the robot as
/// described needs.
pub fn run_of(robot: &Robot, designed: &DesignedMotion, rate_hz: f64) -> Run {
    let samples = (designed.motion.duration_s() * rate_hz).floor() as usize + 1;
    let time: Vec<f64> = (0..samples).map(|k| k as f64 / rate_hz).collect();
    let states: Vec<State> = time.iter().map(|&t| designed.motion.at(t)).collect();
    let joints = robot.joint_count();
    let signal = |pick: fn(&State) -> &Vec<f64>| -> Vec<Vec<f64>> {
        (0..joints).map(|j| states.iter().map(|s| pick(s)[j]).collect()).collect()
    };
    let [q, qd, qdd] = [signal(|s| &s.q), signal(|s| &s.qd), signal(|s| &s.qdd)];
    let frame = Frame {
        rest_speed: vec![REST_SPEED; joints],
        centre: vec![0.0; joints],
        reach: vec![1.0; joints],
        resolution: vec![0.0; joints],
        trial_gaps: vec![0.0; joints],
        trial_springs: vec![None; joints],
        trial_lateness_s: 0.0,
    };
    let along = Along::new(robot, &frame, [q.clone(), qd.clone(), qdd.clone()], rate_hz.recip());
    let channels = |(j, name): (usize, &str)| Channels {
        name: name.to_owned(),
        position: q[j].clone(),
        velocity: Some(qd[j].clone()),
        acceleration: Some(qdd[j].clone()),
        effort: along.effort[j].clone(),
        ..Channels::default()
    };
    Run {
        name: "motion".to_owned(),
        source: PathBuf::new(),
        sha256: String::new(),
        is_torn: false,
        mended: Vec::new(),
        time,
        joints: robot.joint_names().enumerate().map(channels).collect(),
        extra: BTreeMap::new(),
    }
}

/// Speed below which a joint that is asked to move counts as at rest (rad/s or m/s).
const REST_SPEED: f64 = 1e-6;
