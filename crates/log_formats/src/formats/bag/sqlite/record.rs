use crate::formats::bag::sqlite::pages::varint;

/// A value of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum SqliteValue<'r> {
    Null,
    Integer(i64),
    Text(&'r str),
    Blob(&'r [u8]),
    /// A floating-point number. No column that is read has one.
    Real,
}

/// The value of a column in a record, or in the beginning of a record; `None` where the value is missing.
///
/// ```text
/// record = bytes of the header, one type a column, one value a column
/// ```
pub(crate) fn value(record: &[u8], column: usize) -> Option<SqliteValue<'_>> {
    let (header, types) = varint(record)?;
    let header = usize::try_from(header).ok()?;
    let types = types.get(..header.checked_sub(record.len() - types.len())?)?;
    let mut values = record.get(header..)?;
    let mut rest = types;
    for _ in 0..column {
        let (kind, behind) = varint(rest)?;
        (values, rest) = (values.get(size(kind)?..)?, behind);
    }
    let (kind, _) = varint(rest)?;
    let bytes = values.get(..size(kind)?)?;
    Some(match kind {
        0 => SqliteValue::Null,
        1..=6 => SqliteValue::Integer(integer(bytes)),
        8 | 9 => SqliteValue::Integer(kind - 8),
        12.. if kind % 2 == 0 => SqliteValue::Blob(bytes),
        13.. => SqliteValue::Text(std::str::from_utf8(bytes).ok()?),
        _ => SqliteValue::Real,
    })
}

/// Size of a value of a type (bytes).
fn size(kind: i64) -> Option<usize> {
    match kind {
        0 | 8 | 9 => Some(0),
        1..=4 => usize::try_from(kind).ok(),
        5 => Some(6),
        6 | 7 => Some(8),
        12.. => usize::try_from((kind - 12) / 2).ok(),
        _ => None,
    }
}

/// A signed big-endian integer.
fn integer(bytes: &[u8]) -> i64 {
    let sign = bytes.first().map_or(0, |first| i64::from(*first as i8 >> 7));
    bytes.iter().fold(sign, |value, byte| (value << 8) | i64::from(*byte))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_told_by_the_types_in_the_header() {
        // NULL, 1, -2 in two bytes, "ab", x'ff', 3.5
        let mut record = vec![7, 0, 9, 2, 17, 14, 7, 0xff, 0xfe, b'a', b'b', 0xff];
        record.extend(3.5_f64.to_be_bytes());
        let expected = [
            SqliteValue::Null,
            SqliteValue::Integer(1),
            SqliteValue::Integer(-2),
            SqliteValue::Text("ab"),
            SqliteValue::Blob(&[0xff]),
            SqliteValue::Real,
        ];
        for (column, expected) in expected.into_iter().enumerate() {
            assert_eq!(value(&record, column), Some(expected));
        }
        assert_eq!(value(&record, 6), None);
        assert_eq!(value(&record[..8], 2), None, "cut off");
        assert_eq!(value(&[200, 1, 5], 0), None, "a header longer than the record");
    }
}
