use std::path::{Path, PathBuf};
use std::time::Duration;

use rerun::sink::SinkFlushError;
use rerun::{
    BarChart, EntityPath, RecordingStream, RecordingStreamResult, TextDocument, TextLog,
    ViewCoordinates,
};

use crate::arms::ArmTrack;
use crate::bounding_box::BoundingBox;
use crate::colour;
use crate::disk::Disk;
use crate::entities::{DOCUMENT, EVENTS, part, time_column};
use crate::error::{RecordingError, refusal, unwritable};
use crate::live::Viewer;
use crate::plots::Plots;
use crate::row_pace::RowPace;
use crate::rows::{BarSeries, FinishedRecording, RowBlock};
use crate::scene::{EventLevel, Live, Scene, SceneSignal};
use crate::screen_layout::{Bars, ScreenLayout};
use crate::signals::Signals;
use crate::sinks::open;
use crate::skeleton::Skeleton;

/// Rows wait up to this long, in their own time (s): every write costs some kilobytes.
const WAIT_S: f64 = 1.9;
/// Poses in the picture (s); signals are written at full rate.
const POSE_PERIOD_S: f64 = 0.02;
/// Latest time that is shown (s): the file counts nanoseconds.
const LAST_S: f64 = 9e9;
/// Longest wait for the disk while the file does not grow.
const DISK: Duration = Duration::from_secs(20);
/// Width of the bars of a joint together.
const BARS: f64 = 0.8;

/// A recording that is being written.
///
/// A recorder that is dropped before [`Recorder::finish`] closes the file without the rows that
/// wait, and reports no errors.
pub struct Recorder {
    stream: RecordingStream,
    path: PathBuf,
    disk: Disk,
    viewer: Viewer,
    layout: ScreenLayout,
    skeleton: Skeleton,
    arms: Vec<(String, ArmTrack)>,
    signal_names: Vec<String>,
    signals: Signals,
    pace: RowPace,
    last_s: f64,
    rows: u64,
}

impl Recorder {
    /// Opens the file, draws the arms and lays out the screen.
    ///
    /// # Errors
    ///
    /// [`RecordingError::Unwritable`], [`RecordingError::TurnedOff`],
    /// [`RecordingError::NameTwice`] and [`RecordingError::Refused`].
    pub fn create(path: &Path, scene: &Scene<'_>, live: Live) -> Result<Self, RecordingError> {
        refuse_repeated_names(scene)?;
        let (stream, disk, viewer) = open(path, scene.title, live)?;
        let skeleton = Skeleton::new(scene.robot, scene.looks);
        let arms = draw(&stream, scene, &skeleton).map_err(refusal)?;
        let joints = scene.robot.links().iter().map(|l| (l.joint.name.clone(), l.joint.kind));
        let layout = ScreenLayout {
            title: scene.title.to_owned(),
            reach_m: skeleton.reach_m,
            seen: BoundingBox::default(),
            plots: Plots::new(joints.collect(), &scene.signals),
            bars: vec![],
            opened: None,
        };
        let joint_paths = layout.plots.joint_paths().collect();
        layout.send(&stream)?;
        flush_while_it_grows(&stream, path).map_err(|error| unwritable(path, error.to_string()))?;
        Ok(Self {
            stream,
            path: path.to_owned(),
            disk,
            viewer,
            layout,
            skeleton,
            arms,
            signal_names: scene.signals.iter().map(|s| s.name.to_owned()).collect(),
            signals: Signals::new(joint_paths, &scene.signals),
            pace: RowPace::new(POSE_PERIOD_S),
            last_s: f64::NEG_INFINITY,
            rows: 0,
        })
    }

    /// Takes a block of rows; they are written when they make up two seconds.
    ///
    /// It never waits for the disk or for a viewer; [`Recorder::finish`] returns their errors.
    ///
    /// # Errors
    ///
    /// [`RecordingError::WrongLength`] and [`RecordingError::TimeNotIncreasing`], both before
    /// anything of the block is taken; [`RecordingError::Refused`].
    pub fn rows(&mut self, rows: &RowBlock<'_>) -> Result<(), RecordingError> {
        self.check(rows)?;
        let joints = self.skeleton.joints.len();
        for (row, &time_s) in rows.time_s.iter().enumerate() {
            if !self.pace.takes(time_s) {
                continue;
            }
            for ((_, arm), q) in self.arms.iter_mut().zip(rows.arms) {
                let q = &q[row * joints..][..joints];
                arm.push(&self.stream, time_s, q, &self.skeleton).map_err(refusal)?;
                let poses = self.skeleton.parent_from_child(q);
                self.layout.seen.push(&self.skeleton.points_in_world(&poses));
            }
        }
        self.signals.push(rows.time_s, rows.signals);
        self.layout.plots.see(0, rows.signals);
        self.last_s = rows.time_s.last().copied().unwrap_or(self.last_s);
        self.rows += rows.time_s.len() as u64;
        if self.signals.span_s() >= WAIT_S { self.write().map_err(refusal) } else { Ok(()) }
    }

    /// Shows further signals in the plots of the joints, at times of their own (s), such as what
    /// models predict a few times a second; per signal row-major numbers of all joints, a NaN
    /// leaves a gap.
    ///
    /// Every call shows signals of its own. The layout shows them from [`Recorder::finish`] on.
    ///
    /// # Errors
    ///
    /// [`RecordingError::WrongLength`] and [`RecordingError::TimeNotIncreasing`], both before
    /// anything is taken; [`RecordingError::Refused`].
    pub fn further(
        &mut self,
        time_s: &[f64],
        signals: &[(SceneSignal<'_>, &[f64])],
    ) -> Result<(), RecordingError> {
        let expected = time_s.len() * self.skeleton.joints.len();
        if let Some((signal, values)) = signals.iter().find(|(_, v)| v.len() != expected) {
            let thing = format!("signal {}", signal.name);
            return Err(length(thing, "numbers", values.len(), expected));
        }
        increasing(time_s, f64::NEG_INFINITY)?;
        let (signals, values): (Vec<SceneSignal<'_>>, Vec<&[f64]>) =
            signals.iter().copied().unzip();
        let paths = self.layout.plots.add(&signals);
        self.layout.plots.see(self.layout.plots.last_set(), &values);
        let mut written = Signals::new(paths, &signals);
        written.push(time_s, &values);
        written.flush(&self.stream).map_err(refusal)
    }

    /// Notes that something happened at a time (s).
    ///
    /// # Errors
    ///
    /// [`RecordingError::EventTime`] and [`RecordingError::Refused`].
    pub fn event(
        &mut self,
        time_s: f64,
        level: EventLevel,
        text: &str,
    ) -> Result<(), RecordingError> {
        if time_s.is_nan() || time_s.abs() > LAST_S {
            return Err(RecordingError::EventTime { text: text.to_owned(), time_s });
        }
        let columns = TextLog::update_fields()
            .with_many_text([text])
            .with_many_level([level.label()])
            .columns_of_unit_batches();
        let sent = columns.map_err(refusal)?;
        self.stream.send_columns(EVENTS, [time_column(&[time_s])], sent).map_err(refusal)
    }

    /// Shows a text in Markdown beside the plots, instead of the one before.
    ///
    /// # Errors
    ///
    /// [`RecordingError::Refused`].
    pub fn document(&mut self, markdown: &str) -> Result<(), RecordingError> {
        let text = TextDocument::from_markdown(markdown);
        self.stream.log_static(DOCUMENT, &text).map_err(refusal)
    }

    /// Shows a bar a joint for every series, side by side; the first joint stands at 1.
    ///
    /// # Errors
    ///
    /// [`RecordingError::WrongLength`] where a series does not have a number a joint, and
    /// [`RecordingError::Refused`].
    pub fn bars(&mut self, title: &str, series: &[BarSeries<'_>]) -> Result<(), RecordingError> {
        let joints = self.skeleton.joints.len();
        let wrong = series.iter().find(|bar| bar.values.len() != joints);
        if let Some(BarSeries { name, values, .. }) = wrong {
            return Err(length(format!("bars {title}, {name}"), "numbers", values.len(), joints));
        }
        let path = EntityPath::new(vec![part("metrics"), part(&plain(title))]);
        let width = BARS / series.len().max(1) as f64;
        for (i, BarSeries { name, role, values }) in series.iter().enumerate() {
            let shift = (i as f64 + 0.5) * width - 0.5 * BARS;
            let at: Vec<f64> = (1..=joints).map(|joint| joint as f64 + shift).collect();
            let values: Vec<f64> =
                values.iter().map(|v| if v.is_finite() { *v } else { 0.0 }).collect();
            let chart = BarChart::new(values)
                .with_abscissa(at)
                .with_widths(vec![width as f32; joints])
                .with_color(colour::solid(colour::rgb(*role)));
            let path = path.join(&EntityPath::new(vec![part(&plain(name))]));
            self.stream.log_static(path, &chart).map_err(refusal)?;
        }
        let names = series.iter().map(|bar| bar.name.to_owned()).collect();
        self.layout.bars.retain(|bars| bars.path != path);
        self.layout.bars.push(Bars { title: title.to_owned(), path, names });
        Ok(())
    }

    /// Opens the tab of a joint, by its index, instead of that of the first; the layout shows it from
    /// [`Recorder::finish`] on.
    pub fn open(&mut self, joint: usize) {
        self.layout.opened = Some(joint);
    }

    /// Writes what waits and ends the file.
    ///
    /// # Errors
    ///
    /// [`RecordingError::Unwritable`], also for what the disk refused before, and
    /// [`RecordingError::Refused`].
    pub fn finish(mut self) -> Result<FinishedRecording, RecordingError> {
        self.write().map_err(refusal)?;
        let ScreenLayout { bars, plots, opened, .. } = &self.layout;
        if self.rows > 0 || !bars.is_empty() || plots.has_further() || opened.is_some() {
            self.layout.send(&self.stream)?;
        }
        let cannot = |reason: String| unwritable(&self.path, reason);
        if let Err(error) = flush_while_it_grows(&self.stream, &self.path) {
            let refusal = self.disk.refusal();
            if refusal.is_none() {
                // A disk that does not answer would be waited for.
                std::mem::forget(self.stream);
            }
            return Err(cannot(refusal.unwrap_or_else(|| error.to_string())));
        }
        drop(self.stream);
        self.disk.end()?;
        let bytes = std::fs::metadata(&self.path).map_err(|error| cannot(error.to_string()))?.len();
        let listener = self.viewer.close();
        Ok(FinishedRecording { path: self.path, rows: self.rows, bytes, listener })
    }

    fn write(&mut self) -> RecordingStreamResult<()> {
        for (_, arm) in &mut self.arms {
            arm.flush(&self.stream)?;
        }
        self.signals.flush(&self.stream)
    }

    fn check(&self, rows: &RowBlock<'_>) -> Result<(), RecordingError> {
        let lists = [("arms", rows.arms.len(), self.arms.len())];
        let signals = [("signals", rows.signals.len(), self.signal_names.len())];
        for (items, found, expected) in lists.into_iter().chain(signals) {
            if found != expected {
                return Err(length("a block of rows".to_owned(), items, found, expected));
            }
        }
        let expected = rows.time_s.len() * self.skeleton.joints.len();
        let arms = self.arms.iter().map(|(name, _)| format!("arm {name}")).zip(rows.arms);
        let signals = self.signal_names.iter().map(|n| format!("signal {n}")).zip(rows.signals);
        for (thing, values) in arms.chain(signals) {
            if values.len() != expected {
                return Err(length(thing, "numbers", values.len(), expected));
            }
        }
        increasing(rows.time_s, self.last_s)
    }
}

/// Every time can be shown and is later than the one before.
fn increasing(time_s: &[f64], mut previous_s: f64) -> Result<(), RecordingError> {
    for (row, &time_s) in time_s.iter().enumerate() {
        if !(time_s > previous_s && time_s.abs() <= LAST_S) {
            return Err(RecordingError::TimeNotIncreasing { row, time_s, previous_s });
        }
        previous_s = time_s;
    }
    Ok(())
}

/// A name that the legend of a bar chart, which shows paths, can show without escapes.
fn plain(name: &str) -> String {
    let words = name.split(|c: char| !c.is_alphanumeric() && !matches!(c, '-' | '.'));
    words.filter(|word| !word.is_empty()).collect::<Vec<_>>().join("_")
}

fn length(thing: String, items: &'static str, found: usize, expected: usize) -> RecordingError {
    RecordingError::WrongLength { thing, items, found, expected }
}

/// Two arms of one name would be drawn over one another.
fn refuse_repeated_names(scene: &Scene<'_>) -> Result<(), RecordingError> {
    for (i, arm) in scene.arms.iter().enumerate() {
        if scene.arms[..i].iter().any(|other| other.name == arm.name) {
            return Err(RecordingError::NameTwice { name: arm.name.to_owned() });
        }
    }
    Ok(())
}

fn draw(
    stream: &RecordingStream,
    scene: &Scene<'_>,
    skeleton: &Skeleton,
) -> RecordingStreamResult<Vec<(String, ArmTrack)>> {
    stream.log_static("world", &ViewCoordinates::RIGHT_HAND_Z_UP())?;
    let mut arms = vec![];
    for arm in &scene.arms {
        arms.push((arm.name.to_owned(), ArmTrack::new(stream, arm, skeleton, scene.looks)?));
    }
    Ok(arms)
}
/// Brings all messages into the file. A busy processor takes its time; a disk that takes no byte for [`DISK`] is given up.
fn flush_while_it_grows(stream: &RecordingStream, path: &Path) -> Result<(), SinkFlushError> {
    let size = || std::fs::metadata(path).map_or(0, |data| data.len());
    let mut before = size();
    loop {
        match stream.flush_with_timeout(DISK) {
            Err(SinkFlushError::Timeout) if size() > before => before = size(),
            ended => return ended,
        }
    }
}
