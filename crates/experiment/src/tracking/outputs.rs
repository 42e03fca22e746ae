use std::path::{Path, PathBuf};

use crate::scenario::feedforward_kind::FeedforwardKind;

/// Where runs are written while they go on.
#[derive(Debug, Clone)]
pub struct Outputs {
    /// Folder of the logs, one a feedforward.
    pub logs: PathBuf,
    /// Folder of the recordings, one a feedforward; nothing is recorded without.
    pub recordings: Option<PathBuf>,
    /// Whether a running viewer sees them too.
    pub live: recording::Live,
}

/// The file of a run in one of the output folders.
pub(crate) fn file(folder: &Path, kind: FeedforwardKind, extension: &str) -> PathBuf {
    folder.join(format!("{kind}.{extension}"))
}
