use crate::common::{
    dates::{Dates, date_ns},
    table::TableCell,
};

/// Dialect of a table in text: the separator of the fields, and the start of the rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Dialect {
    /// The character between two fields. Several blanks count as one.
    pub separator: u8,
    /// Offset of the line of names, or else of the first row (bytes).
    pub start: usize,
    /// Whether a line of names stands above the rows.
    pub header: Header,
}

/// The content of the first line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Header {
    Names,
    /// Numbers, as in all other lines.
    Numbers,
}

/// Possible separators. Of two that fit equally well the first is taken.
const SEPARATORS: [u8; 4] = [b'\t', b';', b',', b' '];
/// Number of lines that are examined.
const LINES: usize = 20;
/// First characters of comment lines.
const COMMENTS: [u8; 2] = [b'#', b'%'];

impl Dialect {
    /// The dialect, determined from the first lines of a text.
    ///
    /// Comment lines begin with `#` or `%` and stand above the rows. The last of them holds the names if
    /// the line below it has the same number of fields, most of those that are filled are numbers, and it has none itself.
    pub(crate) fn of(text: &[u8]) -> Self {
        let bom = if text.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        let (mut start, mut comment) = (bom, None);
        while text.get(start).is_some_and(|first| COMMENTS.contains(first)) {
            comment = Some(start);
            let line = text[start..].iter().position(|&byte| byte == b'\n');
            start = line.map_or(text.len(), |length| start + length + 1);
        }
        let separator = separator(&text[start..]);
        let first = fields(&text[start..], separator).into_iter().next().unwrap_or_default();
        let numbers = first.iter().filter(|field| is_number(field, separator)).count();
        let filled = first.iter().filter(|field| !field.is_empty()).count();
        let above = comment.map(|at| at + 1).filter(|&at| {
            let names = fields(&text[at..start], separator).into_iter().next().unwrap_or_default();
            let has_number = names.iter().any(|field| is_number(field, separator));
            names.len() == first.len() && (numbers == filled || !has_number)
        });
        match above {
            Some(start) if 2 * numbers > filled => Self { separator, start, header: Header::Names },
            _ if numbers > 0 && numbers == first.len() => {
                Self { separator, start, header: Header::Numbers }
            }
            _ => Self { separator, start, header: Header::Names },
        }
    }

    /// Whether a text has lines below its first, and none of those examined is a row. A row has a number in it,
    /// and either as many fields as the first line or several fields, most of them numbers. A setting is not a row.
    pub(crate) fn has_no_row_in(self, text: &[u8]) -> bool {
        let lines = fields(&text[self.start..], self.separator);
        let is_row = |first: &Vec<Vec<u8>>, line: &Vec<Vec<u8>>| {
            let filled = line.iter().filter(|field| !field.is_empty()).count();
            let numbers = line.iter().filter(|field| is_number(field, self.separator)).count();
            let is_mostly_numbers = filled > 1 && 2 * numbers > filled;
            numbers > 0 && (line.len() == first.len() || is_mostly_numbers) && !is_setting(line)
        };
        lines.split_first().is_some_and(|(first, below)| {
            !below.is_empty() && !below.iter().any(|line| is_row(first, line))
        })
    }

    /// A reader of the records of a text that starts at `start`.
    pub(crate) fn records<R: std::io::Read>(self, text: R) -> csv::Reader<R> {
        reader(text, self.separator)
    }

    /// The fields of a record.
    pub(crate) fn fields(self, record: &csv::ByteRecord) -> impl Iterator<Item = &[u8]> {
        of_record(record, self.separator)
    }
}

/// Whether a line is a setting, such as `rate = 3` or `rate: 3`.
fn is_setting(line: &[Vec<u8>]) -> bool {
    line.first().is_some_and(|field| field.ends_with(b":"))
        || line.get(1).is_some_and(|field| field == b"=")
}

fn reader<R: std::io::Read>(text: R, separator: u8) -> csv::Reader<R> {
    // Rows of another length are let through here and refused with their number.
    let mut builder = csv::ReaderBuilder::new();
    builder.flexible(true).has_headers(false).trim(csv::Trim::All).delimiter(separator);
    builder.from_reader(text)
}

/// The fields of a record. Several blanks between two fields count as one.
fn of_record(record: &csv::ByteRecord, separator: u8) -> impl Iterator<Item = &[u8]> {
    record.iter().filter(move |field| separator != b' ' || !field.is_empty())
}

/// The fields of the first lines.
fn fields(text: &[u8], separator: u8) -> Vec<Vec<Vec<u8>>> {
    let records = reader(text, separator).into_byte_records().take(LINES).map_while(Result::ok);
    records.map(|r| of_record(&r, separator).map(<[u8]>::to_vec).collect()).collect()
}

/// The separator of the fields. It occurs in the first line, and gives the largest share of numbers among the fields of
/// the other lines. A line with another number of fields than the first counts as one without numbers.
fn separator(text: &[u8]) -> u8 {
    let share = |separator: u8| -> Option<f64> {
        let lines = fields(text, separator);
        let (first, rows) = lines.split_first().filter(|(first, _)| first.len() > 1)?;
        let fits = |row: &&Vec<Vec<u8>>| row.len() == first.len();
        let cells = || rows.iter().filter(fits).flatten();
        let numbers = cells().filter(|field| is_number(field, separator)).count();
        let all = cells().count() + first.len() * rows.iter().filter(|row| !fits(row)).count();
        Some(numbers as f64 / all.max(1) as f64)
    };
    let mut best = (b',', -1.0);
    // A reader of one that is nowhere would find one field a line.
    for separator in SEPARATORS.into_iter().filter(|separator| text.contains(separator)) {
        if let Some(share) = share(separator).filter(|&share| share > best.1) {
            best = (separator, share);
        }
    }
    best.0
}

fn is_number(field: &[u8], separator: u8) -> bool {
    matches!(Numerals::between(separator).cell(field), TableCell::Number(_))
}

/// Notation of the numbers in a column. A column of dates holds seconds from its first one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Numerals {
    dates: Dates,
    /// Whether the column has a number.
    has_number: bool,
    /// The decimal mark; `None` before a number with a fraction was read.
    mark: Option<u8>,
    /// Whether the decimal mark may be a comma.
    commas: bool,
}

impl Numerals {
    /// The notation of fields between separators of this kind.
    pub(crate) fn between(separator: u8) -> Self {
        let (dates, has_number, mark) = (Dates::default(), false, None);
        Self { dates, has_number, mark, commas: separator != b',' }
    }

    /// The content of a field. A comma is a decimal mark, never a thousands separator. A column
    /// with decimal points has no decimal commas, a column of dates no numbers.
    pub(crate) fn cell(&mut self, field: &[u8]) -> TableCell {
        if field.is_empty() {
            return TableCell::Empty;
        }
        let Ok(text) = std::str::from_utf8(field) else { return TableCell::Text };
        let (has_comma, has_point) = (text.contains(','), text.contains('.'));
        let number: Option<f64> = match (has_comma, has_point) {
            (false, _) => text.parse().ok(),
            (true, false) if self.commas => text.replacen(',', ".", 1).parse().ok(),
            (true, _) => None,
        };
        let mark = if has_comma { Some(b',') } else { has_point.then_some(b'.') };
        match number {
            Some(_) if mark.is_some() && self.mark.is_some() && mark != self.mark => {
                TableCell::Text
            }
            Some(_) if self.dates.has_begun() => TableCell::Text,
            Some(number) => {
                (self.has_number, self.mark) = (true, self.mark.or(mark));
                TableCell::Number(number)
            }
            None => match date_ns(text).filter(|_| !self.has_number) {
                Some(date_ns) => TableCell::Number(self.dates.seconds(date_ns)),
                None => TableCell::Text,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_separator_is_what_leaves_numbers() {
        for (text, expected) in [
            ("time,q\n0,1\n", b','),
            ("time;q\n0,0;1,5\n", b';'),
            ("0,0;1,5\n0,1;1,6\n", b';'),
            ("time\tq of joint\n0\t1\n", b'\t'),
            ("time q\n0,1 0,2\n", b' '),
            ("0.1   0.2  0.3\n0.2 0.3 0.4\n", b' '),
            ("time, q one, r\n0, 1, 2\n", b','),
            ("time,\"a;b;c\"\n0,1\n", b','),
            ("time,note\n0,a b\n", b','),
            ("time\n0\n", b','),
            ("", b','),
        ] {
            let found = Dialect::of(text.as_bytes()).separator;
            assert_eq!(found as char, expected as char, "{text}");
        }
    }

    #[test]
    fn names_stand_above_the_rows_or_nowhere() {
        for (text, start, header) in [
            ("\u{feff}time,q\n0,1\n", 3, Header::Names),
            ("0,1\n1,2\n", 0, Header::Numbers),
            ("# time q\n0 1\n1 2\n", 1, Header::Names),
            ("# arm 3\n# at noon\n0 1\n1 2\n", 9, Header::Names),
            ("# arm 3\n# at noon today\n0 1\n1 2\n", 24, Header::Numbers),
            ("% of june\ntime,q\n1,2\n", 10, Header::Names),
            ("%time,name0,q0\n1,elbow,2\n2,elbow,3\n", 1, Header::Names),
            ("# of,june\ntime,q\n1,2\n", 10, Header::Names),
            ("# 7,june,arm\ntime,1,2\n1,2,3\n", 13, Header::Names),
            ("#", 1, Header::Names),
        ] {
            let found = Dialect::of(text.as_bytes());
            assert_eq!((found.start, found.header), (start, header), "{text}");
        }
    }

    #[test]
    fn a_comma_stands_before_the_fraction_where_it_parts_no_fields() {
        let mut column = Numerals::between(b';');
        assert_eq!(column.cell(b"3"), TableCell::Number(3.0));
        assert_eq!(column.cell(b"-0,5e-1"), TableCell::Number(-0.05));
        assert_eq!(column.cell(b"0.5"), TableCell::Text, "points beside commas");
        assert_eq!(column.cell(b"1.234,5"), TableCell::Text);
        assert_eq!(column.cell(b"1,234,5"), TableCell::Text);
        assert_eq!(column.cell(b""), TableCell::Empty);
        assert_eq!(Numerals::between(b',').cell(b"0,5"), TableCell::Text);
    }

    #[test]
    fn a_column_holds_dates_or_numbers() {
        let mut dates = Numerals::between(b',');
        assert_eq!(dates.cell(b"2026-11-28 23:59:59.999"), TableCell::Number(0.0));
        assert_eq!(dates.cell(b"2026-11-29 00:00:00.001"), TableCell::Number(0.002));
        assert_eq!(dates.cell(b"0.004"), TableCell::Text);
        let mut numbers = Numerals::between(b',');
        assert_eq!(numbers.cell(b"0.004"), TableCell::Number(0.004));
        assert_eq!(numbers.cell(b"2026-11-29 00:00:00.001"), TableCell::Text);
    }
}
