use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;

use logs::{Channel, LogWriter, write_parquet};
use recording::{
    Arm, BarSeries, Listener, Recorder, RecordingError, RowBlock, Scene, SceneRole, SceneSignal,
    SignalQuantity,
};
use tracking::{ControlTick, Event, Level, TrackingWatch};

use crate::error::ExperimentError;
use crate::models::learned::Learned;
use crate::progress::Progress;
use crate::scenario::feedforward_kind::FeedforwardKind;
use crate::scenario::tracking_scenario::TrackingScenario;
use crate::tracking::outputs::{Outputs, file};
use crate::tracking::predictions::Predictions;
use crate::tracking::tracked_run::{TrackedRun, Written};
use crate::tracking::words::words;

/// Number of ticks that are handed over at a time: half a second at 500 Hz.
const BLOCK: usize = 250;

/// Writes a run in a thread of its own while the run goes on, so that the loop never waits.
pub struct Stream<'a> {
    progress: &'a dyn Progress,
    block: Block,
    /// The thread that writes the blocks; `None` where nothing is written.
    writer: Option<Writing>,
    second: f64,
}

/// The thread that writes, and its files.
struct Writing {
    to: Sender<Message>,
    thread: JoinHandle<Files>,
    /// The log while the run goes on.
    growing: PathBuf,
    log: PathBuf,
    recording: Option<PathBuf>,
    name: String,
}

/// The open files of a run.
struct Files {
    log: LogWriter,
    recorder: Option<Recorder>,
    /// The first error of the recorder.
    refused: Option<RecordingError>,
}

enum Message {
    Rows(Block),
    Event(Event),
}

/// Consecutive ticks, with row-major signals.
#[derive(Debug, Clone, Default)]
struct Block {
    time_s: Vec<f64>,
    q_ref: Vec<f64>,
    qd_ref: Vec<f64>,
    qdd_ref: Vec<f64>,
    q: Vec<f64>,
    qd: Vec<f64>,
    command: Vec<f64>,
    feedforward: Vec<f64>,
    error: Vec<f64>,
}

impl Block {
    fn push(&mut self, tick: &ControlTick) {
        self.time_s.push(tick.time_s);
        self.q_ref.extend(&tick.reference.q);
        self.qd_ref.extend(&tick.reference.qd);
        self.qdd_ref.extend(&tick.reference.qdd);
        self.q.extend(&tick.reading.q);
        self.qd.extend(&tick.reading.qd);
        self.command.extend(tick.command);
        self.feedforward.extend(&tick.feedforward.tau);
        self.error.extend(tick.reference.q.iter().zip(&tick.reading.q).map(|(r, q)| r - q));
    }
}

/// The signals of the recording, in the order in which [`Files::rows`] gives them.
fn signals() -> Vec<SceneSignal<'static>> {
    let signal = |quantity, name, role| SceneSignal { quantity, name, role };
    vec![
        signal(SignalQuantity::Position, "desired", SceneRole::Desired),
        signal(SignalQuantity::Position, "measured", SceneRole::Actual),
        signal(SignalQuantity::Velocity, "desired", SceneRole::Desired),
        signal(SignalQuantity::Velocity, "measured", SceneRole::Actual),
        signal(SignalQuantity::Torque, "applied", SceneRole::Actual),
        signal(SignalQuantity::Torque, "fed forward", SceneRole::Predicted),
        signal(SignalQuantity::Error, "desired - measured", SceneRole::Error),
    ]
}

impl<'a> Stream<'a> {
    /// Opens the files of a run, if it has any.
    ///
    /// # Errors
    ///
    /// [`ExperimentError::Log`] and [`ExperimentError::Recording`].
    pub fn start(
        scenario: &TrackingScenario,
        kind: FeedforwardKind,
        outputs: Option<&Outputs>,
        progress: &'a dyn Progress,
    ) -> Result<Self, ExperimentError> {
        let writer = outputs.map(|outputs| Writing::start(scenario, kind, outputs)).transpose()?;
        Ok(Self { progress, block: Block::default(), writer, second: 0.0 })
    }

    /// Closes the files. The log becomes one Parquet file, and the recording gets the predictions of the other
    /// models.
    pub fn finish(
        mut self,
        scenario: &TrackingScenario,
        learned: &Learned,
        run: &TrackedRun,
    ) -> Option<Written> {
        self.hand_over();
        let writing = self.writer?;
        Some(writing.finish(scenario, learned, run))
    }

    fn hand_over(&mut self) {
        let block = std::mem::take(&mut self.block);
        if let Some(writing) = self.writer.as_ref().filter(|_| !block.time_s.is_empty()) {
            // That a thread has died is told at the end.
            let _ = writing.to.send(Message::Rows(block));
        }
    }
}

impl TrackingWatch for Stream<'_> {
    fn tick(&mut self, tick: &ControlTick) -> ControlFlow<()> {
        if tick.time_s >= self.second + 1.0 {
            self.second += 1.0;
            self.progress.second();
        }
        if self.writer.is_some() {
            self.block.push(tick);
            if self.block.time_s.len() >= BLOCK {
                self.hand_over();
            }
        }
        if self.progress.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn event(&mut self, event: &Event) {
        self.hand_over();
        if let Some(writing) = &self.writer {
            let _ = writing.to.send(Message::Event(event.clone()));
        }
    }
}

impl Writing {
    fn start(
        scenario: &TrackingScenario,
        kind: FeedforwardKind,
        outputs: &Outputs,
    ) -> Result<Self, ExperimentError> {
        let robot = scenario.robot();
        let name = kind.name().to_owned();
        let title = format!("{}: {}, gains {}", robot.name(), kind.words(), scenario.gains_name());
        let scene = Scene {
            title: &title,
            robot,
            looks: &scenario.loaded_robot().looks,
            arms: vec![
                Arm { name: "measured", role: SceneRole::Actual },
                Arm { name: "desired", role: SceneRole::Desired },
            ],
            signals: signals(),
        };
        let recording = outputs.recordings.as_ref().map(|folder| file(folder, kind, "rrd"));
        let growing = file(&outputs.logs, kind, "csv");
        let record = |path: &PathBuf| Recorder::create(path, &scene, outputs.live);
        let recorder = recording.as_ref().map(record).transpose()?;
        let log = log_writer(scenario, &growing)?;
        let (to, from) = channel();
        let mut files = Files { log, recorder, refused: None };
        let thread = std::thread::spawn(move || {
            files.write(&from);
            files
        });
        let log = file(&outputs.logs, kind, "parquet");
        Ok(Self { to, thread, growing, log, recording, name })
    }

    /// Closes every file, whether or not closing another one fails.
    fn finish(self, scenario: &TrackingScenario, learned: &Learned, run: &TrackedRun) -> Written {
        let Self { to, thread, growing, log, recording, name } = self;
        drop(to);
        let (mut problems, mut listener) = (Vec::new(), Listener::NotAsked);
        let mut grown = Ok(());
        match thread.join() {
            Ok(files) => {
                grown = files.log.finish();
                let ended = match (files.refused, files.recorder) {
                    (Some(error), _) => Err(error),
                    (None, Some(recorder)) => end(recorder, scenario, learned, run),
                    (None, None) => Ok(Listener::NotAsked),
                };
                match ended {
                    Ok(seen) => listener = seen,
                    Err(error) => problems.push(error.to_string()),
                }
            }
            Err(_) => {
                let died = ExperimentError::WriterDied { path: growing.clone() };
                problems.push(died.to_string());
            }
        }
        let written = match write_log(&log, &name, scenario, run) {
            Ok(()) => {
                // The Parquet file beside it holds all of it and more.
                let _ = std::fs::remove_file(&growing);
                problems.extend(grown.err().map(|error| error.to_string()));
                log
            }
            Err(error) => {
                problems.push(error.to_string());
                problems.extend(grown.err().map(|error| error.to_string()));
                growing
            }
        };
        Written { log: written, recording, listener, problems }
    }
}

/// Writes the whole log.
fn write_log(
    path: &Path,
    name: &str,
    scenario: &TrackingScenario,
    run: &TrackedRun,
) -> Result<(), ExperimentError> {
    Ok(write_parquet(path, &run.tracking.to_run(name, scenario.robot())?)?)
}

/// Adds to a recording the results that are known at the end of the run, and closes it.
fn end(
    mut recorder: Recorder,
    scenario: &TrackingScenario,
    learned: &Learned,
    run: &TrackedRun,
) -> Result<Listener, RecordingError> {
    let predictions = Predictions::of(scenario, learned, run);
    let signal = |name, place| SceneSignal {
        quantity: SignalQuantity::Torque,
        name,
        role: SceneRole::Model(place),
    };
    let models = predictions.models.iter();
    let models = models.map(|m| (signal(m.kind.name(), m.place), m.tau.as_slice()));
    let models: Vec<(SceneSignal<'_>, &[f64])> = models.collect();
    if !models.is_empty() {
        recorder.further(&predictions.time_s, &models)?;
    }
    recorder.document(&words(scenario, run))?;
    let joints = run.metrics.joints.iter();
    let (errors, feedback): (Vec<f64>, Vec<f64>) =
        joints.map(|j| (1e3 * j.rmse, 100.0 * j.feedback_share)).unzip();
    let name = run.kind.name();
    let bar = |role, values| [BarSeries { name, role, values }];
    recorder.bars("RMSE (mrad)", &bar(SceneRole::Error, &errors))?;
    recorder.bars("feedback (% of the torque)", &bar(SceneRole::Actual, &feedback))?;
    Ok(recorder.finish()?.listener)
}

impl Files {
    /// Writes blocks as they arrive. An error of one file does not stop the other.
    fn write(&mut self, from: &Receiver<Message>) {
        for message in from {
            let recorded = match message {
                Message::Rows(block) => self.rows(&block),
                Message::Event(Event { time_s, level, words }) => {
                    let level = match level {
                        Level::Info => recording::EventLevel::Info,
                        Level::Warning => recording::EventLevel::Warning,
                        Level::Error => recording::EventLevel::Error,
                    };
                    self.recorder.as_mut().map_or(Ok(()), |r| r.event(time_s, level, &words))
                }
            };
            if let Err(error) = recorded {
                self.refused.get_or_insert(error);
            }
        }
    }

    fn rows(&mut self, b: &Block) -> Result<(), RecordingError> {
        let (joints, mut row) = (b.q.len() / b.time_s.len().max(1), Vec::new());
        let signals: [&[f64]; 7] =
            [&b.q, &b.qd, &b.command, &b.q_ref, &b.qd_ref, &b.qdd_ref, &b.feedforward];
        for (k, time_s) in b.time_s.iter().enumerate() {
            row.clear();
            row.push(*time_s);
            signals.iter().for_each(|s| row.extend(&s[k * joints..(k + 1) * joints]));
            // Rows that the disk refuses stay collected; the end tells whether they were lost.
            let _ = self.log.row(&row);
        }
        let signals: [&[f64]; 7] =
            [&b.q_ref, &b.q, &b.qd_ref, &b.qd, &b.command, &b.feedforward, &b.error];
        let rows = RowBlock { time_s: &b.time_s, arms: &[&b.q, &b.q_ref], signals: &signals };
        self.recorder.as_mut().map_or(Ok(()), |recorder| recorder.rows(&rows))
    }
}

/// A writer of a growing log with the columns of [`Files::rows`].
fn log_writer(scenario: &TrackingScenario, path: &Path) -> Result<LogWriter, ExperimentError> {
    let joints: Vec<&str> = scenario.robot().joint_names().collect();
    let channels = [
        Channel::Position,
        Channel::Velocity,
        Channel::Effort,
        Channel::DesiredPosition,
        Channel::DesiredVelocity,
        Channel::DesiredAcceleration,
    ];
    let further: Vec<String> = joints.iter().map(|joint| format!("{joint}.feedforward")).collect();
    let further: Vec<&str> = further.iter().map(String::as_str).collect();
    Ok(LogWriter::create(path, &joints, &channels, &further)?)
}
