use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use rerun::TimelineName;
use rerun::external::arrow::array::{Array, Float64Array};
use rerun::external::re_log_encoding::{Decodable, DecoderApp, StreamFooter};
use rerun::external::re_log_types::{LogMsg, StoreKind};
use rerun::log::Chunk;

use crate::entities::TIMELINE;
use crate::error::RecordingError;

/// The contents of a recording that was read back: its numbers, and the counts of everything else.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Contents {
    /// By path, such as `/joints/elbow` or `/world/arms/measured/upper`; without the library's
    /// own notes about the file.
    pub entities: BTreeMap<String, Entity>,
    /// Messages that describe the layout of the screen.
    pub layout_messages: usize,
    /// Times that a layout was put on the screen.
    pub layouts: usize,
    /// Whether the file was closed properly and can be read to its end. A killed run leaves it
    /// open.
    pub is_whole: bool,
}

/// The rows of one entity, in the order of the file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Entity {
    /// Rows, with those that hold at all times.
    pub rows: usize,
    /// Times of the rows that have one (ns).
    pub times_ns: Vec<i64>,
    /// Rows of numbers by column, such as `position`: one number a signal of that quantity.
    pub columns: BTreeMap<String, Vec<Vec<f64>>>,
}

impl Contents {
    /// Reads a recording up to its end, or up to where it was cut.
    ///
    /// # Errors
    ///
    /// [`RecordingError::Unreadable`] where the file cannot be opened or holds no recording.
    pub fn read(path: &Path) -> Result<Self, RecordingError> {
        let unreadable =
            |reason: String| RecordingError::Unreadable { path: path.to_owned(), reason };
        let mut file = files::open(path).map_err(|error| unreadable(error.to_string()))?;
        let is_ended = has_footer(&mut file).map_err(|error| unreadable(error.to_string()))?;
        let (mut contents, mut messages, mut cut) = (Self::default(), 0_usize, None);
        for message in DecoderApp::decode_lazy(BufReader::new(file)) {
            let taken = message.map_err(|error| error.to_string());
            if let Err(error) = taken.and_then(|message| contents.take(&message)) {
                cut = Some(error);
                break;
            }
            messages += 1;
        }
        if messages == 0 {
            return Err(unreadable(cut.unwrap_or_else(|| "it is empty".to_owned())));
        }
        contents.is_whole = is_ended && cut.is_none();
        Ok(contents)
    }

    fn take(&mut self, message: &LogMsg) -> Result<(), String> {
        match message {
            LogMsg::ArrowMsg(id, _) if id.kind() == StoreKind::Blueprint => {
                self.layout_messages += 1;
            }
            LogMsg::ArrowMsg(_, rows) => {
                let chunk = Chunk::from_arrow_msg(rows).map_err(|error| error.to_string())?;
                if !chunk.entity_path().is_reserved() {
                    let path = chunk.entity_path().to_string();
                    self.entities.entry(path).or_default().take(&chunk);
                }
            }
            LogMsg::BlueprintActivationCommand(_) => self.layouts += 1,
            LogMsg::SetStoreInfo(_) => {}
        }
        Ok(())
    }

    /// Rows of all entities together.
    pub fn rows(&self) -> usize {
        self.entities.values().map(|entity| entity.rows).sum()
    }

    /// First and last time (s); none where nothing has a time.
    pub fn time_s(&self) -> Option<[f64; 2]> {
        let times = || self.entities.values().flat_map(|entity| &entity.times_ns);
        let seconds = |ns: &i64| *ns as f64 * 1e-9;
        Some([times().min().map(seconds)?, times().max().map(seconds)?])
    }
}

impl Entity {
    fn take(&mut self, chunk: &Chunk) {
        self.rows += chunk.num_rows();
        let clock = chunk.timelines().get(&TimelineName::from(TIMELINE));
        self.times_ns.extend(clock.iter().flat_map(|column| column.times_raw()));
        let columns: BTreeMap<_, _> = chunk.components().iter().collect();
        for (name, column) in columns {
            let rows = (0..column.list_array.len()).map(|row| column.list_array.value(row));
            let numbers = rows.filter_map(|row| {
                row.as_any().downcast_ref::<Float64Array>().map(|n| n.values().to_vec())
            });
            self.columns.entry(name.to_string()).or_default().extend(numbers);
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
