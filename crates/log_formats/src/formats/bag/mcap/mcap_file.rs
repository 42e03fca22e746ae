use std::{
    borrow::Cow,
    collections::BTreeMap,
    fs::File,
    io::{Read, Seek},
    path::Path,
};

use mcap::sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions};

use crate::{
    common::{allowance::Allowance, damage::Damage, error::FormatError, guard::guard},
    formats::bag::{
        mcap::record::{Chunk, McapRecord},
        topic::{Message, MessageSink, Topic},
    },
};

/// Name of the format in errors.
pub(crate) const NAME: &str = "MCAP";
/// Longest record (bytes). Messages are recorded in chunks of a few MB.
const LONGEST_RECORD: usize = 1 << 27;
/// Number of bytes read at once.
const PIECE: usize = 1 << 16;

/// Reads an MCAP file from start to end, or up to its first damage.
pub(crate) fn read(
    path: &Path,
    file: &File,
    sink: &mut dyn MessageSink,
    damage: &mut Damage,
) -> Result<(), FormatError> {
    let read = guard(path, NAME, || {
        let length = file.metadata().map_err(|e| FormatError::unreadable(path, &e))?.len();
        let (schemas, topics) = (BTreeMap::new(), BTreeMap::new());
        let allowance = Allowance::of(length);
        Reader { path, allowance, schemas, topics, sink }.read(file)
    });
    read.or_else(|error| damage.take(error))
}

struct Reader<'a> {
    path: &'a Path,
    allowance: Allowance,
    /// Message types by the number of their schema.
    schemas: BTreeMap<u16, String>,
    /// Topics by the number of their channel.
    topics: BTreeMap<u16, Topic>,
    sink: &'a mut dyn MessageSink,
}

impl Reader<'_> {
    fn read(mut self, mut file: &File) -> Result<(), FormatError> {
        file.rewind().map_err(|e| FormatError::unreadable(self.path, &e))?;
        // Chunks are unpacked here: the crate's own lz4 never ends where one is cut off.
        let options = LinearReaderOptions::default()
            .with_emit_chunks(true)
            .with_validate_data_section_crc(true)
            .with_record_length_limit(LONGEST_RECORD);
        let mut reader = LinearReader::new_with_options(options);
        while let Some(event) = reader.next_event() {
            match event.map_err(|e| self.broken(&e))? {
                // No more room than for what was read, whatever length a record claims.
                LinearReadEvent::ReadRequest(count) => {
                    let piece = reader.insert(count.min(PIECE));
                    let read = files::read_some(&mut file, piece)
                        .map_err(|e| FormatError::unreadable(self.path, &e))?;
                    reader.notify_read(read);
                }
                LinearReadEvent::Record { opcode, data } => match self.parse(opcode, data)? {
                    McapRecord::Chunk(chunk) => self.chunk(&chunk)?,
                    record => self.record(&record)?,
                },
            }
        }
        Ok(())
    }

    fn parse<'d>(&self, opcode: u8, data: &'d [u8]) -> Result<McapRecord<'d>, FormatError> {
        McapRecord::parse(opcode, data).ok_or_else(|| self.broken(&"a record is cut off"))
    }

    fn record(&mut self, record: &McapRecord) -> Result<(), FormatError> {
        match *record {
            McapRecord::Schema { id, name } => {
                self.schemas.insert(id, name.to_owned());
            }
            McapRecord::Channel { id, schema, topic, encoding } => {
                let kind = self.schemas.get(&schema).cloned().unwrap_or_default();
                let (name, encoding) = (topic.to_owned(), encoding.to_owned());
                let topic = Topic { name, kind, encoding };
                self.sink.add_topic(&topic)?;
                self.topics.insert(id, topic);
            }
            McapRecord::Message { channel, recorded_ns, data } => match self.topics.get(&channel) {
                Some(topic) if !self.sink.wants(topic) => {}
                Some(topic) => {
                    let recorded_ns = i64::try_from(recorded_ns).ok();
                    self.sink.add_message(topic, &Message { data, recorded_ns })?;
                }
                None => return Err(self.broken(&"a message is of no channel")),
            },
            McapRecord::Chunk(_) | McapRecord::Other => {}
        }
        Ok(())
    }

    fn chunk(&mut self, chunk: &Chunk) -> Result<(), FormatError> {
        let records = self.unpack_chunk(chunk)?;
        let mut rest = records.as_ref();
        while !rest.is_empty() {
            let cut = || self.broken(&"a chunk ends within a record");
            let ([opcode, length @ ..], after) = rest.split_first_chunk::<9>().ok_or_else(cut)?;
            let length = usize::try_from(u64::from_le_bytes(*length)).unwrap_or(usize::MAX);
            let (data, next) = after.split_at_checked(length).ok_or_else(cut)?;
            self.record(&self.parse(*opcode, data)?)?;
            rest = next;
        }
        Ok(())
    }

    /// Unpacks the records of a chunk.
    fn unpack_chunk<'d>(&mut self, chunk: &Chunk<'d>) -> Result<Cow<'d, [u8]>, FormatError> {
        let Chunk { length, crc, packing, data } = *chunk;
        if length > LONGEST_RECORD as u64 {
            return Err(self.broken(&"a chunk is too large"));
        }
        self.allowance.take(length).map_err(|e| FormatError::too_large(self.path, e))?;
        let unpack = |packed: &mut dyn Read| {
            let mut records = Vec::new();
            packed.take(length + 1).read_to_end(&mut records).map(|_| Cow::Owned(records))
        };
        let records = match packing {
            "" => Ok(Cow::Borrowed(data)),
            "zstd" => zstd::Decoder::with_buffer(data).and_then(|mut packed| unpack(&mut packed)),
            "lz4" => unpack(&mut lz4_flex::frame::FrameDecoder::new(data)),
            _ => return Err(self.broken(&"a chunk is packed in an unknown way")),
        };
        let records = records.map_err(|e| self.broken(&e))?;
        if records.len() as u64 != length {
            return Err(self.broken(&"a chunk is not as long as it says"));
        }
        if ![0, crc32fast::hash(&records)].contains(&crc) {
            return Err(self.broken(&"a chunk does not have its checksum"));
        }
        Ok(records)
    }

    fn broken(&self, error: &dyn std::fmt::Display) -> FormatError {
        FormatError::broken(self.path, NAME, error)
    }
}
