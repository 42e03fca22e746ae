//! Kinds of file that are not supported, each with a description and advice.

/// A kind of file that is not supported.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct UnreadKind {
    /// Description of the file, as the end of `this is ...`.
    pub found: &'static str,
    /// What to do with such a file.
    pub advice: &'static str,
}

/// The unsupported kind of a file with these first bytes; `None` for any other file.
pub(crate) fn unread_kind(first: &[u8]) -> Option<UnreadKind> {
    let holds =
        |at: usize, magic: &[u8]| first.get(at..).is_some_and(|rest| rest.starts_with(magic));
    let found = UNREAD_KINDS.iter().find(|(at, magic, ..)| holds(*at, magic))?;
    Some(UnreadKind { found: found.2, advice: found.3 })
}

/// A binary file of an unknown kind.
pub(crate) const UNKNOWN: UnreadKind = UnreadKind {
    found: "a binary file of no kind that is known here",
    advice: "write the log as CSV or Parquet",
};

const BAG: &str = "a bag of ROS 2 was expected, with the tables topics and messages";
const BAG_FILE: &str = "one of .mcap or .db3 was expected beside metadata.yaml";
const CLOSE: &str = "sqlite3 FILE 'pragma wal_checkpoint(truncate)' puts it in";
const ARRAYS: &str = "write its arrays with numpy.savez, or as CSV or Parquet";
const PACKED: &str = "unpack it first";
const TABLE: &str = "write its first sheet as CSV";
const ARROW: &str = "write the table as Parquet";
const TEXT: &str = "save it as UTF-8";
const NOT_A_TABLE: &str = "a log has a line of names, then one of numbers for every moment";

/// Unsupported kinds that their bytes identify: place of the bytes, bytes, description, advice.
#[rustfmt::skip]
const UNREAD_KINDS: [(usize, &[u8], &str, &str); 21] = [
    (0, b"rosbag2_bagfile_information", "the description of a rosbag2", "give the folder that it stands in"),
    (0, b"#ROSBAG V", "a bag of ROS 1", "rosbags-convert --src FILE.bag --dst FOLDER --dst-storage mcap writes it as a bag of ROS 2"),
    (0, b"PK\x05\x06", "an empty zip archive", "a log was expected"),
    (0, b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "an Excel workbook", TABLE),
    (0, b"BZh", "packed with bzip2", PACKED),
    (0, b"\xfd7zXZ\0", "packed with xz", PACKED),
    (0, b"\x04\x22\x4d\x18", "packed with lz4", PACKED),
    (0, b"7z\xbc\xaf\x27\x1c", "a 7z archive", PACKED),
    (257, b"ustar", "a tar archive", PACKED),
    (0, b"ARROW1", "an Arrow or Feather file", ARROW),
    (0, b"ORC", "an ORC file", ARROW),
    (0, b"ULog\x01\x12\x35", "a ULog of PX4", "ulog2csv writes it as CSV"),
    (0, b"RRF2", "a recording of rerun", "give the log that it shows"),
    (0, b"\x80\x04\x95", "a Python pickle, which can run a program when it is opened", ARRAYS),
    (0, b"\x80\x05\x95", "a Python pickle, which can run a program when it is opened", ARRAYS),
    (0, b"\xff\xfe", "text in UTF-16", TEXT),
    (0, b"\xfe\xff", "text in UTF-16", TEXT),
    (0, b"version https://git-lfs", "a pointer of Git LFS, not the file itself", "git lfs pull brings it"),
    (0, b"<", "XML or HTML, as a robot's description or a web page is", NOT_A_TABLE),
    (0, b"{", "JSON", NOT_A_TABLE),
    (0, b"%PDF-", "a PDF document", NOT_A_TABLE),
];

/// A text without a table.
pub(crate) const PROSE: UnreadKind =
    UnreadKind { found: "text without a row of numbers in its first lines", advice: NOT_A_TABLE };

/// A packed file inside a packed file.
pub(crate) const TWICE: UnreadKind = UnreadKind { found: "packed twice", advice: PACKED };

/// A bag without messages.
pub(crate) const NO_BAG_FILE: UnreadKind =
    UnreadKind { found: "a bag without a file of messages", advice: BAG_FILE };

/// A database that is not a bag.
pub(crate) const NO_BAG: UnreadKind = UnreadKind { found: "a SQLite database", advice: BAG };

/// A database whose last messages are in a separate file.
pub(crate) const UNFINISHED: UnreadKind = UnreadKind {
    found: "a SQLite database whose last messages are in a file beside it (-wal or -journal)",
    advice: CLOSE,
};

/// Another kind of file, in a bag under the name of one of its files.
pub(crate) const NOT_A_BAG: UnreadKind = UnreadKind {
    found: "CSV or another kind of log",
    advice: "in a bag MCAP or SQLite was expected",
};

/// Another kind of file, in a LeRobot dataset under the name of a Parquet file.
pub(crate) const NOT_PARQUET: UnreadKind = UnreadKind {
    found: "CSV or another kind of log",
    advice: "in a dataset of LeRobot Parquet was expected",
};

/// The kind of a zip archive without NumPy arrays, by the names of its entries.
pub(crate) fn of_archive(names: &[String]) -> UnreadKind {
    let known = |(ends, ..): &&(&str, &str, &str)| names.iter().any(|name| name.ends_with(ends));
    let (found, advice) = match ARCHIVES.iter().find(known) {
        Some(&(_, found, advice)) => (found, advice),
        None => ("a zip archive without an array of NumPy in it", PACKED),
    };
    UnreadKind { found, advice }
}

/// Kinds of zip archive by one of their entries: end of its name, description, advice.
#[rustfmt::skip]
const ARCHIVES: [(&str, &str, &str); 4] = [
    ("xl/workbook.xml", "an Excel workbook", TABLE),
    ("xl/workbook.bin", "an Excel workbook", TABLE),
    ("content.xml", "an OpenDocument file", TABLE),
    ("data.pkl", "a file of PyTorch, which can run a program when it is opened", ARRAYS),
];

/// A NumPy array that is not a table.
pub(crate) const NO_TABLE: UnreadKind = UnreadKind {
    found: "an array of NumPy that is no table of numbers",
    advice: "an array of samples x columns was expected",
};

/// Whether the bytes have no control characters other than those of text.
pub(crate) fn is_text(bytes: &[u8]) -> bool {
    bytes.iter().all(|byte| !matches!(byte, 0..=8 | 11 | 14..=26 | 28..=31 | 127))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kind_that_is_not_read_is_known_by_its_bytes() {
        let found = |bytes: &[u8]| unread_kind(bytes).unwrap().found;
        assert_eq!(unread_kind(b"\x00\x01\x02"), None);
        let of = |name: &str| of_archive(&["mimetype".to_owned(), name.to_owned()]).found;
        assert_eq!(of("xl/workbook.xml"), "an Excel workbook");
        assert_eq!(of("run.csv"), "a zip archive without an array of NumPy in it");
        assert_eq!(found(&[&[b'a'; 257][..], b"ustar\x0000"].concat()), "a tar archive");
        assert_eq!(found(b"<?xml version=\"1.0\"?><robot"), UNREAD_KINDS[18].2);
    }

    #[test]
    fn text_has_no_control_characters() {
        assert!(is_text(b"time,j1.position\n0,1\n"));
        assert!(is_text("\u{feff}zeit;gr\u{f6}\u{df}e\n".as_bytes()));
        assert!(is_text(b"time;gr\xf6\xdfe\n"), "Latin-1");
        assert!(!is_text(b"\x00\x01\x02"));
    }

    #[test]
    fn every_unread_kind_is_found_behind_its_bytes_and_described_in_one_sentence() {
        for (at, magic, found, advice) in UNREAD_KINDS {
            let bytes = [&vec![b'x'; at][..], magic].concat();
            assert_eq!(unread_kind(&bytes), Some(UnreadKind { found, advice }));
            assert!(!found.contains(". ") && !advice.ends_with('.'), "{found}: {advice}");
        }
    }
}
