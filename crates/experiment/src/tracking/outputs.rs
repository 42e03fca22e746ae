use std::path::{Path, PathBuf};

use crate::scenario::feedforward_kind::FeedforwardKind;

/// The folders of the files that are written during a run.
#[derive(Debug, Clone)]
pub struct Outputs {
    /// Folder of the logs, one log a feedforward.
    pub logs: PathBuf,
    /// Folder of the recordings, one recording a feedforward; `None` records nothing.
    pub recordings: Option<PathBuf>,
    /// Whether a running viewer receives the recordings too.
    pub live: recording::Live,
}

/// The file of a run in one of the output folders.
pub(crate) fn file(folder: &Path, kind: FeedforwardKind, extension: &str) -> PathBuf {
    folder.join(format!("{kind}.{extension}"))
}
