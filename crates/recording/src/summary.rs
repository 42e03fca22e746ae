use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use rerun::external::re_log_encoding::{Decodable, DecoderApp, StreamFooter};
use rerun::external::re_log_types::{LogMsg, StoreKind};
use rerun::log::{Chunk, ChunkResult};

use crate::RecordingError;
use crate::recorder::TIMELINE;

/// What a recording holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// Paths of what is recorded, in alphabetical order.
    pub entities: Vec<String>,
    /// Rows of all entities together.
    pub rows: u64,
    /// First and last time (s); none where nothing has a time.
    pub time_s: Option<[f64; 2]>,
    /// Whether the file says what the screen shows.
    pub has_blueprint: bool,
    /// Whether the file was ended properly and all of it can be read; not so after a kill.
    pub is_whole: bool,
}

/// Reads a recording up to its end, or up to where it was cut.
///
/// # Errors
///
/// [`RecordingError::Unreadable`] where the file cannot be opened or holds no recording.
pub fn summary(path: &Path) -> Result<Summary, RecordingError> {
    let unreadable = |reason: String| RecordingError::Unreadable { path: path.to_owned(), reason };
    let mut file = File::open(path).map_err(|error| unreadable(error.to_string()))?;
    let ended = has_footer(&mut file).map_err(|error| unreadable(error.to_string()))?;
    let mut found = Found::default();
    let mut cut = None;
    for message in DecoderApp::decode_lazy(BufReader::new(file)) {
        if let Err(error) = message.map_err(|e| e.to_string()).and_then(|m| found.take(&m)) {
            cut = Some(error);
            break;
        }
    }
    if found.messages == 0 {
        return Err(unreadable(cut.unwrap_or_else(|| "it is empty".to_owned())));
    }
    Ok(Summary {
        entities: found.entities.into_iter().collect(),
        rows: found.rows,
        time_s: found.time_ns.map(|ends| ends.map(|ns| ns as f64 * 1e-9)),
        has_blueprint: found.has_blueprint,
        is_whole: ended && cut.is_none(),
    })
}

/// What the messages up to now hold.
#[derive(Debug, Default)]
struct Found {
    messages: u64,
    entities: BTreeSet<String>,
    rows: u64,
    time_ns: Option<[i64; 2]>,
    has_blueprint: bool,
}

impl Found {
    fn take(&mut self, message: &LogMsg) -> Result<(), String> {
        match message {
            LogMsg::ArrowMsg(id, rows) if id.kind() == StoreKind::Recording => {
                let chunk: ChunkResult<Chunk> = Chunk::from_arrow_msg(rows);
                self.rows(&chunk.map_err(|error| error.to_string())?);
            }
            LogMsg::BlueprintActivationCommand(_) => self.has_blueprint = true,
            LogMsg::ArrowMsg(..) | LogMsg::SetStoreInfo(_) => {}
        }
        self.messages += 1;
        Ok(())
    }

    fn rows(&mut self, chunk: &Chunk) {
        // The library's own notes about the file.
        if chunk.entity_path().is_reserved() {
            return;
        }
        self.entities.insert(chunk.entity_path().to_string());
        self.rows += chunk.num_rows() as u64;
        let clock = chunk.timelines().get(&rerun::TimelineName::from(TIMELINE));
        for &time_ns in clock.iter().flat_map(|column| column.times_raw()) {
            let [first, last] = self.time_ns.unwrap_or([time_ns; 2]);
            self.time_ns = Some([first.min(time_ns), last.max(time_ns)]);
        }
    }
}

/// Whether the file ends as one that was ended properly; leaves it at its start.
pub(crate) fn has_footer(file: &mut File) -> std::io::Result<bool> {
    let bytes = file.metadata()?.len();
    let start = bytes.saturating_sub(StreamFooter::ENCODED_SIZE_BYTES as u64);
    file.seek(SeekFrom::Start(start))?;
    let mut tail = vec![];
    file.read_to_end(&mut tail)?;
    file.rewind()?;
    Ok(StreamFooter::from_rrd_bytes(&tail).is_ok())
}
