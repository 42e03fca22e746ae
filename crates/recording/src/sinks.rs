use std::path::Path;

use rerun::sink::{FileSink, FileSinkError, LogSink};
use rerun::{RecordingStream, RecordingStreamBuilder};

use crate::error::{refused, unwritable};
use crate::live::Viewer;
use crate::{Live, RecordingError};

/// The stream into the file, and into a viewer where one listens.
pub(crate) fn open(
    path: &Path,
    title: &str,
    live: Live,
) -> Result<(RecordingStream, Viewer), RecordingError> {
    let builder = RecordingStreamBuilder::new("plumbline").recording_name(title);
    let stream = builder.buffered().map_err(refused)?;
    if !stream.is_enabled() {
        let value = std::env::var("RERUN").unwrap_or_default();
        return Err(RecordingError::TurnedOff { path: path.to_owned(), value });
    }
    stream.set_log_time_enabled(false);
    let file = FileSink::new(path).map_err(|error| match error {
        FileSinkError::CreateFile { source, .. } => unwritable(path, source.to_string()),
        other => unwritable(path, other.to_string()),
    })?;
    let (viewer, queue) = Viewer::find(live);
    let mut sinks: Vec<Box<dyn LogSink>> = vec![Box::new(file)];
    sinks.extend(queue.map(|queue| -> Box<dyn LogSink> { Box::new(queue) }));
    stream.set_sinks(sinks);
    Ok((stream, viewer))
}
