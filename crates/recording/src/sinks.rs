use std::path::Path;

use rerun::sink::LogSink;
use rerun::{RecordingStream, RecordingStreamBuilder};

use crate::disk::Disk;
use crate::error::{RecordingError, refusal};
use crate::live::Viewer;
use crate::scene::Live;

/// The stream into the file, and into a viewer where one listens.
pub(crate) fn open(
    path: &Path,
    title: &str,
    live: Live,
) -> Result<(RecordingStream, Disk, Viewer), RecordingError> {
    let builder = RecordingStreamBuilder::new("plumbline").recording_name(title);
    let stream = builder.buffered().map_err(refusal)?;
    if !stream.is_enabled() {
        let value = std::env::var("RERUN").unwrap_or_default();
        return Err(RecordingError::TurnedOff { path: path.to_owned(), value });
    }
    stream.set_log_time_enabled(false);
    let disk = Disk::create(path)?;
    let (viewer, queue) = Viewer::find(live);
    let mut sinks: Vec<Box<dyn LogSink>> = vec![Box::new(disk.clone())];
    sinks.extend(queue.map(|queue| -> Box<dyn LogSink> { Box::new(queue) }));
    stream.set_sinks(sinks);
    Ok((stream, disk, viewer))
}
