use mcap::records::op;

/// The content of an MCAP record, as far as it is used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum McapRecord<'a> {
    /// A message type, by the number of its schema.
    Schema {
        id: u16,
        name: &'a str,
    },
    /// A topic, by the number of its channel.
    Channel {
        id: u16,
        schema: u16,
        topic: &'a str,
        encoding: &'a str,
    },
    Message {
        channel: u16,
        /// Time at which it was recorded (ns).
        recorded_ns: u64,
        data: &'a [u8],
    },
    Chunk(Chunk<'a>),
    /// A record that is not used.
    Other,
}

/// Records that are compressed together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Chunk<'a> {
    /// Size of the uncompressed records (bytes).
    pub length: u64,
    /// CRC-32 of the uncompressed records; 0 where it was not computed.
    pub crc: u32,
    /// Name of the compression; empty for none.
    pub packing: &'a str,
    pub data: &'a [u8],
}

impl<'a> McapRecord<'a> {
    /// Parses a record of this opcode; `None` where its content is cut off. No memory is reserved for a length before
    /// that many bytes are present.
    pub(crate) fn parse(opcode: u8, content: &'a [u8]) -> Option<Self> {
        let mut fields = Fields { rest: content };
        Some(match opcode {
            op::SCHEMA => Self::Schema { id: fields.u16()?, name: fields.text()? },
            op::CHANNEL => Self::Channel {
                id: fields.u16()?,
                schema: fields.u16()?,
                topic: fields.text()?,
                encoding: fields.text()?,
            },
            op::MESSAGE => {
                let channel = fields.u16()?;
                // Its number.
                fields.take::<4>()?;
                let recorded_ns = fields.u64()?;
                // The time of publishing.
                fields.take::<8>()?;
                Self::Message { channel, recorded_ns, data: fields.rest }
            }
            op::CHUNK => {
                // The times of its first and its last message.
                fields.take::<{ 8 + 8 }>()?;
                let (length, crc, packing) = (fields.u64()?, fields.u32()?, fields.text()?);
                let bytes = usize::try_from(fields.u64()?).ok()?;
                Self::Chunk(Chunk { length, crc, packing, data: fields.rest.get(..bytes)? })
            }
            _ => Self::Other,
        })
    }
}

/// A reader of little-endian fields in sequence.
struct Fields<'a> {
    rest: &'a [u8],
}

impl<'a> Fields<'a> {
    fn take<const SIZE: usize>(&mut self) -> Option<[u8; SIZE]> {
        let (field, rest) = self.rest.split_first_chunk()?;
        self.rest = rest;
        Some(*field)
    }

    fn u16(&mut self) -> Option<u16> {
        self.take().map(u16::from_le_bytes)
    }

    fn u32(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    fn u64(&mut self) -> Option<u64> {
        self.take().map(u64::from_le_bytes)
    }

    fn text(&mut self) -> Option<&'a str> {
        let length = self.u32()? as usize;
        let (text, rest) = self.rest.split_at_checked(length)?;
        self.rest = rest;
        std::str::from_utf8(text).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_that_is_cut_off_is_none() {
        let channel = b"\x07\0\x02\0\x02\0\0\0/a\x03\0\0\0cdr";
        let whole = McapRecord::Channel { id: 7, schema: 2, topic: "/a", encoding: "cdr" };
        assert_eq!(McapRecord::parse(4, channel), Some(whole));
        for cut in 0..channel.len() {
            assert_eq!(McapRecord::parse(4, &channel[..cut]), None);
        }
        let claims = b"\x07\0\xff\xff\xff\xffabc";
        assert_eq!(McapRecord::parse(3, claims), None);
        assert_eq!(McapRecord::parse(3, b"\x07\0\x01\0\0\0\xff"), None, "not UTF-8");
        assert_eq!(McapRecord::parse(1, b""), Some(McapRecord::Other));
    }
}
