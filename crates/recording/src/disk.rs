use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use rerun::external::re_log_encoding::{Encoder, EncodingOptions};
use rerun::log::LogMsg;
use rerun::sink::{LogSink, SinkFlushError};

use crate::error::{RecordingError, unwritable};

/// The file of a recording, shared by the stream that writes it and the one who ends it.
///
/// The library's own sink waits forever when a disk error has stopped its thread, and hides the
/// error. This one keeps the first error, and drops all later messages.
#[derive(Clone)]
pub(crate) struct Disk {
    path: PathBuf,
    writing: Arc<Mutex<Writing>>,
}

struct Writing {
    encoder: Encoder<File>,
    file: File,
    refused: Option<String>,
}

impl Disk {
    /// Begins the file.
    pub fn create(path: &Path) -> Result<Self, RecordingError> {
        let cannot = |reason: String| unwritable(path, reason);
        let file = File::create(path).map_err(|error| cannot(error.to_string()))?;
        let own = file.try_clone().map_err(|error| cannot(error.to_string()))?;
        let (version, options) =
            (rerun::build_info().version, EncodingOptions::PROTOBUF_COMPRESSED);
        let encoder =
            Encoder::new_eager(version, options, own).map_err(|error| cannot(error.to_string()))?;
        let writing = Writing { encoder, file, refused: None };
        Ok(Self { path: path.to_owned(), writing: Arc::new(Mutex::new(writing)) })
    }

    /// Does something with the file unless it has refused, and keeps what it refuses.
    fn with(&self, act: impl FnOnce(&mut Writing) -> Result<(), String>) -> Result<(), String> {
        let mut writing = self.writing.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(refused) = &writing.refused {
            return Err(refused.clone());
        }
        act(&mut writing).inspect_err(|reason| writing.refused = Some(reason.clone()))
    }

    /// What the disk refused, where that is known.
    pub fn refusal(&self) -> Option<String> {
        self.writing.try_lock().ok()?.refused.clone()
    }

    /// Ends the file behind the last message, on the disk itself.
    ///
    /// # Errors
    ///
    /// [`RecordingError::Unwritable`], also for what was refused before.
    pub fn end(&self) -> Result<(), RecordingError> {
        let ended = self.with(|writing| {
            writing.encoder.finish().map_err(|error| error.to_string())?;
            writing.file.sync_all().map_err(|error| error.to_string())
        });
        ended.map_err(|reason| unwritable(&self.path, reason))
    }
}

impl LogSink for Disk {
    fn send(&self, message: LogMsg) {
        // The refusal is kept: who ends the file is told.
        let _ = self.with(|writing| match writing.encoder.append(&message) {
            Ok(_) => Ok(()),
            Err(error) => Err(error.to_string()),
        });
    }

    fn flush_blocking(&self, _: Duration) -> Result<(), SinkFlushError> {
        let flushed = |writing: &mut Writing| {
            writing.encoder.flush_blocking().map_err(|error| error.to_string())
        };
        self.with(flushed).map_err(SinkFlushError::failed)
    }
}
