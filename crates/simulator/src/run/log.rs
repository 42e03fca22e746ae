use std::collections::BTreeMap;

use logs::{Channels, Run};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Exp, Normal};

use crate::run::follow::ControlRow;
use crate::scenario::check::{Scenario, ScenarioRun};
use crate::scenario::spec::DropoutSpec;
use crate::sensors::EffortSource;

/// Errors of the log's clock: jitter, dropped rows, dropouts.
pub(crate) struct LogClock {
    pub random: ChaCha8Rng,
    pub jitter_s: f64,
    pub dropped_share: f64,
    /// Least time between two stamps (s).
    pub shortest_s: f64,
    /// Dropouts, as start and end (s).
    pub lost: Vec<(f64, f64)>,
}

/// Draws the dropouts of a log as starts and ends (s). Their starts are a Poisson process.
pub(crate) fn draw_dropouts(
    dropouts: &DropoutSpec,
    last_s: f64,
    random: &mut ChaCha8Rng,
) -> Vec<(f64, f64)> {
    let mut lost = Vec::new();
    let Ok(between) = Exp::new(dropouts.per_minute / 60.0) else { return lost };
    let mut start_s = between.sample(random);
    while start_s <= last_s {
        lost.push((start_s, start_s + 1e-3 * dropouts.length_ms));
        start_s += between.sample(random);
    }
    lost
}

impl LogClock {
    /// Keeps every `every`-th row, drops some of them and adds jitter to their time stamps.
    pub fn thin(&mut self, rows: Vec<ControlRow>, every: usize) -> Vec<ControlRow> {
        let mut kept: Vec<ControlRow> = Vec::with_capacity(rows.len() / every + 1);
        let jitter = Normal::new(0.0, self.jitter_s).ok().filter(|_| self.jitter_s > 0.0);
        for mut row in rows.into_iter().step_by(every) {
            if self.dropped_share > 0.0 && self.random.random::<f64>() < self.dropped_share {
                continue;
            }
            let time_s = row.reading.time_s;
            row.reading.time_s += jitter.map_or(0.0, |j| j.sample(&mut self.random));
            if self.lost.iter().any(|(start, end)| (*start..*end).contains(&time_s)) {
                continue;
            }
            if let Some(last) = kept.last() {
                row.reading.time_s = row.reading.time_s.max(last.reading.time_s + self.shortest_s);
            }
            kept.push(row);
        }
        kept
    }
}

/// The log of a run: sensor readings, references and commands.
pub(crate) fn log_of_rows(scenario: &Scenario, run: &ScenarioRun, rows: &[ControlRow]) -> Run {
    let asked_is_effort = scenario.spec().sensors.effort == EffortSource::Commanded;
    let follows_velocity = scenario.spec().control.servo.is_none();
    let column = |of: &dyn Fn(&ControlRow) -> f64| rows.iter().map(of).collect::<Vec<f64>>();
    let joint = |(i, name): (usize, &str)| Channels {
        name: name.to_owned(),
        position: column(&|r| r.reading.q[i]),
        effort: column(&|r| r.reading.effort[i]),
        velocity: Some(column(&|r| r.reading.qd[i])),
        acceleration: None,
        desired_position: Some(column(&|r| r.reference.q[i])),
        desired_velocity: follows_velocity.then(|| column(&|r| r.reference.qd[i])),
        desired_acceleration: follows_velocity.then(|| column(&|r| r.reference.qdd[i])),
        commanded_effort: (!asked_is_effort).then(|| column(&|r| r.command[i])),
        link_position: rows.iter().map(|r| r.links[i]).collect(),
        goal_effort: None,
    };
    Run {
        name: run.name.clone(),
        source: Default::default(),
        sha256: String::new(),
        is_torn: false,
        mended: Vec::new(),
        time: column(&|r| r.reading.time_s),
        joints: scenario.robot().joint_names().enumerate().map(joint).collect(),
        extra: BTreeMap::new(),
    }
}
