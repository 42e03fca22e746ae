use std::path::Path;

use crate::error::RecordingError;
use crate::rows::{BarSeries, FinishedRecording, RowBlock};
use crate::scene::{EventLevel, Live, Scene, SceneSignal};

/// A recording that is being written: there is none, as the crate is built without its feature `rerun`.
pub enum Recorder {}

impl Recorder {
    /// Opens no file.
    ///
    /// # Errors
    ///
    /// [`RecordingError::LeftOut`].
    pub fn create(path: &Path, _: &Scene<'_>, _: Live) -> Result<Self, RecordingError> {
        Err(RecordingError::LeftOut { path: path.to_owned() })
    }

    /// Takes a block of rows.
    pub fn rows(&mut self, _: &RowBlock<'_>) -> Result<(), RecordingError> {
        match *self {}
    }

    /// Adds lines of further signals.
    pub fn further(
        &mut self,
        _: &[f64],
        _: &[(SceneSignal<'_>, &[f64])],
    ) -> Result<(), RecordingError> {
        match *self {}
    }

    /// Notes what happens at a time (s).
    pub fn event(&mut self, _: f64, _: EventLevel, _: &str) -> Result<(), RecordingError> {
        match *self {}
    }

    /// Shows a text.
    pub fn document(&mut self, _: &str) -> Result<(), RecordingError> {
        match *self {}
    }

    /// Shows bars.
    pub fn bars(&mut self, _: &str, _: &[BarSeries<'_>]) -> Result<(), RecordingError> {
        match *self {}
    }

    /// Opens the plots of a joint.
    pub fn open(&mut self, _: usize) {
        match *self {}
    }

    /// Ends the file.
    pub fn finish(self) -> Result<FinishedRecording, RecordingError> {
        match self {}
    }
}
