/// A reader of values in the CDR encoding of ROS 2. Each value is aligned to a multiple of its size,
/// counted from the first value.
#[derive(Debug, Clone)]
pub(crate) struct Cdr<'a> {
    /// The bytes after the four that give the byte order.
    values: &'a [u8],
    at: usize,
    order: ByteOrder,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ByteOrder {
    Little,
    Big,
}

impl<'a> Cdr<'a> {
    /// A reader of a message; `None` where the encoding is not CDR.
    pub(crate) fn new(message: &'a [u8]) -> Option<Self> {
        let (start, values) = message.split_first_chunk::<4>()?;
        let order = match start {
            [0, 0, ..] => ByteOrder::Big,
            [0, 1, ..] => ByteOrder::Little,
            _ => return None,
        };
        Some(Self { values, at: 0, order })
    }

    pub(crate) fn u32(&mut self) -> Option<u32> {
        let bytes = self.take::<4>()?;
        Some(match self.order {
            ByteOrder::Little => u32::from_le_bytes(bytes),
            ByteOrder::Big => u32::from_be_bytes(bytes),
        })
    }

    pub(crate) fn i32(&mut self) -> Option<i32> {
        self.u32().map(u32::cast_signed)
    }

    pub(crate) fn f64(&mut self) -> Option<f64> {
        let bytes = self.take::<8>()?;
        Some(match self.order {
            ByteOrder::Little => f64::from_le_bytes(bytes),
            ByteOrder::Big => f64::from_be_bytes(bytes),
        })
    }

    /// A text. Its terminating zero is included in its length.
    pub(crate) fn text(&mut self) -> Option<&'a str> {
        let length = self.u32()? as usize;
        let end = self.at.checked_add(length)?;
        let bytes = self.values.get(self.at..end)?;
        self.at = end;
        std::str::from_utf8(bytes.strip_suffix(&[0]).unwrap_or(bytes)).ok()
    }

    /// A count, followed by that many values. Each value takes at least one byte, so the message bounds a false count.
    pub(crate) fn sequence<T>(
        &mut self,
        mut value: impl FnMut(&mut Self) -> Option<T>,
    ) -> Option<Vec<T>> {
        let count = self.u32()?;
        // Room is made as values come, not as many as the message says.
        let mut values = Vec::new();
        for _ in 0..count {
            values.push(value(self)?);
        }
        Some(values)
    }

    /// The header and the names of a message about joints: time of the stamp (ns), names.
    pub(crate) fn stamped_names(&mut self) -> Option<(i64, Vec<String>)> {
        let (seconds, nanoseconds) = (self.i32()?, self.u32()?);
        self.text()?;
        let names = self.sequence(|cdr| cdr.text().map(str::to_owned))?;
        Some((i64::from(seconds) * 1_000_000_000 + i64::from(nanoseconds), names))
    }

    fn take<const SIZE: usize>(&mut self) -> Option<[u8; SIZE]> {
        let start = self.at.checked_next_multiple_of(SIZE)?;
        let bytes = *self.values.get(start..)?.first_chunk::<SIZE>()?;
        self.at = start + SIZE;
        Some(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_begin_at_multiples_of_their_size_in_either_order() {
        let little = [
            &[0, 1, 0, 0][..],
            &[3, 0, 0, 0, b'j', b'1', 0, 0xee],
            &[1, 0, 0, 0, 0xee, 0xee, 0xee, 0xee],
            &1.5_f64.to_le_bytes(),
            &[0xff; 4],
        ]
        .concat();
        let big = [
            &[0, 0, 0, 0][..],
            &[0, 0, 0, 3, b'j', b'1', 0, 0xee],
            &[0, 0, 0, 1, 0xee, 0xee, 0xee, 0xee],
            &1.5_f64.to_be_bytes(),
            &[0xff; 4],
        ]
        .concat();
        for message in [little, big] {
            let mut cdr = Cdr::new(&message).unwrap();
            assert_eq!(cdr.text(), Some("j1"));
            assert_eq!(cdr.sequence(Cdr::f64), Some(vec![1.5]));
            assert_eq!(cdr.clone().sequence(Cdr::u32), None, "4 294 967 295 values");
            assert_eq!(cdr.i32(), Some(-1));
            assert_eq!(cdr.u32(), None);
        }
        assert!(Cdr::new(&[0, 3, 0, 0]).is_none() && Cdr::new(&[0, 1]).is_none());
    }
}
