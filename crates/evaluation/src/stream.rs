use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;

use logs::{Channel, LogWriter, write_parquet};
use recording::{Arm, Listener, Quantity, Recorder, Role, Rows, Scene, Signal};
use tracking::{Event, Level, Tick, Watch};

use crate::track::file;
use crate::{EvaluationError, FeedforwardKind, Outputs, Progress, TrackedRun, TrackingScenario};

/// Ticks that are handed over at a time: half a second at 500 Hz.
const BLOCK: usize = 250;

/// The files of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// The log, whole.
    pub log: PathBuf,
    /// The recording.
    pub recording: PathBuf,
    /// Who saw the recording while it was written.
    pub listener: Listener,
}

/// Writes a run while it goes on, in a thread of its own, so that the loop never waits for it.
pub struct Stream<'a> {
    progress: &'a dyn Progress,
    block: Block,
    /// Where blocks go; none where nothing is written.
    writer: Option<Writing>,
    second: f64,
}

/// The thread that writes.
struct Writing {
    to: Sender<Message>,
    thread: JoinHandle<Result<Files, EvaluationError>>,
    /// The log while it grows.
    growing: PathBuf,
    log: PathBuf,
    recording: PathBuf,
    name: String,
}

/// What is written into.
struct Files {
    log: LogWriter,
    recorder: Recorder,
}

enum Message {
    Rows(Block),
    Event(Event),
}

/// Consecutive ticks, signals row-major.
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
    fn push(&mut self, tick: &Tick) {
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
fn signals() -> Vec<Signal<'static>> {
    let signal = |quantity, name, role| Signal { quantity, name, role };
    vec![
        signal(Quantity::Position, "desired", Role::Desired),
        signal(Quantity::Position, "measured", Role::Actual),
        signal(Quantity::Velocity, "desired", Role::Desired),
        signal(Quantity::Velocity, "measured", Role::Actual),
        signal(Quantity::Torque, "applied", Role::Actual),
        signal(Quantity::Torque, "fed forward", Role::Predicted),
        signal(Quantity::Error, "desired - measured", Role::Error),
    ]
}

impl<'a> Stream<'a> {
    /// Opens the files of a run, if it has any.
    ///
    /// # Errors
    ///
    /// [`EvaluationError::Log`] and [`EvaluationError::Recording`].
    pub fn start(
        scenario: &TrackingScenario,
        kind: FeedforwardKind,
        outputs: Option<&Outputs>,
        progress: &'a dyn Progress,
    ) -> Result<Self, EvaluationError> {
        let writer = outputs.map(|outputs| Writing::start(scenario, kind, outputs)).transpose()?;
        Ok(Self { progress, block: Block::default(), writer, second: 0.0 })
    }

    /// Closes the files; the log is then one Parquet file.
    ///
    /// # Errors
    ///
    /// [`EvaluationError::Log`] and [`EvaluationError::Recording`], also for what could not be
    /// written on the way.
    pub fn finish(
        mut self,
        scenario: &TrackingScenario,
        run: &TrackedRun,
    ) -> Result<Option<Written>, EvaluationError> {
        self.hand_over();
        let Some(writing) = self.writer else { return Ok(None) };
        writing.finish(scenario, run).map(Some)
    }

    fn hand_over(&mut self) {
        let block = std::mem::take(&mut self.block);
        if let Some(writing) = self.writer.as_ref().filter(|_| !block.time_s.is_empty()) {
            // A thread that has ended has an error to tell at the end.
            let _ = writing.to.send(Message::Rows(block));
        }
    }
}

impl Watch for Stream<'_> {
    fn tick(&mut self, tick: &Tick) -> ControlFlow<()> {
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
    ) -> Result<Self, EvaluationError> {
        let robot = scenario.robot();
        let name = kind.name().to_owned();
        let title = format!("{}: {}, gains {}", robot.name(), kind.words(), scenario.gains_name());
        let scene = Scene {
            title: &title,
            robot,
            looks: &scenario.loaded().looks,
            arms: vec![
                Arm { name: "measured", role: Role::Actual },
                Arm { name: "desired", role: Role::Desired },
            ],
            signals: signals(),
        };
        let recording = file(&outputs.recordings, kind, "rrd");
        let growing = file(&outputs.logs, kind, "csv");
        let recorder = Recorder::create(&recording, &scene, outputs.live)?;
        let log = log_writer(scenario, &growing)?;
        let (to, from) = channel();
        let mut files = Files { log, recorder };
        let thread = std::thread::spawn(move || {
            files.write(&from)?;
            Ok(files)
        });
        let log = file(&outputs.logs, kind, "parquet");
        Ok(Self { to, thread, growing, log, recording, name })
    }

    fn finish(
        self,
        scenario: &TrackingScenario,
        run: &TrackedRun,
    ) -> Result<Written, EvaluationError> {
        drop(self.to);
        let files = self
            .thread
            .join()
            .map_err(|_| EvaluationError::WriterDied { path: self.recording.clone() })?;
        let Files { log, mut recorder } = files?;
        recorder.document(&crate::words::words(scenario, run))?;
        let errors: Vec<f64> = run.metrics.joints.iter().map(|j| 1e3 * j.rmse).collect();
        let feedback: Vec<f64> =
            run.metrics.joints.iter().map(|j| 100.0 * j.feedback_share).collect();
        recorder.bars("RMSE (mrad)", &[(self.name.as_str(), &errors)])?;
        recorder.bars("feedback (% of the torque)", &[(self.name.as_str(), &feedback)])?;
        let listener = recorder.finish()?.listener;
        let name = self.name;
        write_parquet(&self.log, &run.tracking.to_run(&name, scenario.robot())?)?;
        log.finish()?;
        // The Parquet file beside it holds all of it and more.
        let _ = std::fs::remove_file(&self.growing);
        Ok(Written { log: self.log, recording: self.recording, listener })
    }
}

impl Files {
    fn write(&mut self, from: &Receiver<Message>) -> Result<(), EvaluationError> {
        for message in from {
            match message {
                Message::Rows(block) => self.rows(&block)?,
                Message::Event(Event { time_s, level, words }) => {
                    let level = match level {
                        Level::Info => recording::Level::Info,
                        Level::Warning => recording::Level::Warning,
                        Level::Error => recording::Level::Error,
                    };
                    self.recorder.event(time_s, level, &words)?;
                }
            }
        }
        Ok(())
    }

    fn rows(&mut self, b: &Block) -> Result<(), EvaluationError> {
        let signals: [&[f64]; 7] =
            [&b.q_ref, &b.q, &b.qd_ref, &b.qd, &b.command, &b.feedforward, &b.error];
        let rows = Rows { time_s: &b.time_s, arms: &[&b.q, &b.q_ref], signals: &signals };
        self.recorder.rows(&rows)?;
        let (joints, mut row) = (b.q.len() / b.time_s.len().max(1), Vec::new());
        let signals: [&[f64]; 7] =
            [&b.q, &b.qd, &b.command, &b.q_ref, &b.qd_ref, &b.qdd_ref, &b.feedforward];
        for (k, time_s) in b.time_s.iter().enumerate() {
            row.clear();
            row.push(*time_s);
            signals.iter().for_each(|s| row.extend(&s[k * joints..(k + 1) * joints]));
            self.log.row(&row)?;
        }
        Ok(())
    }
}

/// A log that grows, with the columns of [`Files::rows`].
fn log_writer(scenario: &TrackingScenario, path: &Path) -> Result<LogWriter, EvaluationError> {
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
