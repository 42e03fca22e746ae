//! ROS 2 bags in a SQLite database, as written by rosbag2 with the storage `sqlite3`.

use std::{collections::BTreeMap, fs::File, path::Path};

use crate::{
    common::{
        bounds::MOST_ENTRIES,
        damage::Damage,
        error::FormatError,
        guard::guard,
        unread_kinds::{NO_BAG, UNFINISHED},
    },
    formats::bag::{
        sqlite::{
            columns::columns,
            pages::Pages,
            record::{SqliteValue, value},
            table::{Row, rows},
        },
        topic::{Message, MessageSink, Topic},
    },
};

/// Name of the format in errors.
pub(crate) const NAME: &str = "SQLite";
/// The page of the schema table, which lists all tables.
const TABLES: u32 = 1;

/// Reads the messages of a bag in recorded order, up to its end or its first damage.
pub(crate) fn read(
    path: &Path,
    file: &File,
    sink: &mut dyn MessageSink,
    damage: &mut Damage,
) -> Result<(), FormatError> {
    if is_unfinished(path) {
        return Err(FormatError::other_kind(path, UNFINISHED));
    }
    let read = guard(path, NAME, || {
        let told = |reason: String| FormatError::broken(path, NAME, &reason);
        Bag { path, pages: Pages::new(file).map_err(told)?, sink }.read()
    });
    read.or_else(|error| damage.take(error))
}

/// Whether a file beside the database holds the last messages.
fn is_unfinished(path: &Path) -> bool {
    ["-wal", "-journal"].iter().any(|end| {
        let mut beside = path.as_os_str().to_owned();
        beside.push(end);
        std::fs::metadata(beside).is_ok_and(|data| data.is_file() && data.len() > 0)
    })
}

/// A table: the page at which it begins, and the names of its columns.
struct Table {
    root: u32,
    columns: Vec<String>,
}

struct Bag<'a> {
    path: &'a Path,
    pages: Pages<'a>,
    sink: &'a mut dyn MessageSink,
}

/// The reason why a row is not read.
enum Trouble {
    Damaged(String),
    Refused(FormatError),
}

impl From<String> for Trouble {
    fn from(reason: String) -> Self {
        Self::Damaged(reason)
    }
}

impl Bag<'_> {
    fn read(mut self) -> Result<(), FormatError> {
        let path = self.path;
        self.read_tables().map_err(|trouble| match trouble {
            Trouble::Damaged(reason) => FormatError::broken(path, NAME, &reason),
            Trouble::Refused(error) => error,
        })
    }

    fn read_tables(&mut self) -> Result<(), Trouble> {
        let mut tables = self.tables()?;
        let (Some(topics), Some(messages)) = (tables.remove("topics"), tables.remove("messages"))
        else {
            return Err(Trouble::Refused(FormatError::other_kind(self.path, NO_BAG)));
        };
        let topics = self.topics(&topics)?;
        self.messages(&messages, &topics)
    }

    /// The tables of the database by which a bag is recognised.
    fn tables(&mut self) -> Result<BTreeMap<String, Table>, Trouble> {
        let mut tables = BTreeMap::new();
        rows(&mut self.pages, TABLES, |pages, row| -> Result<(), Trouble> {
            let record = row.record(pages)?;
            let text = |column| match value(&record, column) {
                Some(SqliteValue::Text(text)) => Some(text),
                _ => None,
            };
            let (Some("table"), Some(name)) = (text(0), text(1)) else { return Ok(()) };
            if let (Some(SqliteValue::Integer(root)), Some(sql), "topics" | "messages") =
                (value(&record, 3), text(4), name)
            {
                let root = u32::try_from(root).map_err(|_| format!("there is no page {root}"))?;
                tables.insert(name.to_owned(), Table { root, columns: columns(sql) });
            }
            Ok(())
        })?;
        Ok(tables)
    }

    /// The topics by their number.
    fn topics(&mut self, table: &Table) -> Result<BTreeMap<i64, Topic>, Trouble> {
        let places = ["name", "type", "serialization_format"].map(|name| table.place(name));
        let [name, kind, encoding] = places;
        let (name, kind, encoding) = (name?, kind?, encoding?);
        let mut topics = BTreeMap::new();
        rows(&mut self.pages, table.root, |pages, row| -> Result<(), Trouble> {
            let record = row.record(pages)?;
            let text = |column| match value(&record, column) {
                Some(SqliteValue::Text(text)) => Ok(text.to_owned()),
                _ => Err(format!("topic {} has no text in column {}", row.id, column + 1)),
            };
            let topic = Topic { name: text(name)?, kind: text(kind)?, encoding: text(encoding)? };
            topics.insert(row.id, topic);
            if topics.len() > MOST_ENTRIES {
                return Err(format!("it has more than {MOST_ENTRIES} topics").into());
            }
            Ok(())
        })?;
        topics
            .values()
            .try_for_each(|topic| self.sink.add_topic(topic))
            .map_err(Trouble::Refused)?;
        Ok(topics)
    }

    fn messages(&mut self, table: &Table, topics: &BTreeMap<i64, Topic>) -> Result<(), Trouble> {
        let (of_topic, of_data) = (table.place("topic_id")?, table.place("data")?);
        let Self { pages, sink, .. } = self;
        rows(pages, table.root, |pages, row: &Row| -> Result<(), Trouble> {
            let number = match value(row.beginning(), of_topic) {
                Some(SqliteValue::Integer(number)) => number,
                _ => return Err(format!("message {} has no topic", row.id).into()),
            };
            let topic = topics
                .get(&number)
                .ok_or_else(|| format!("message {} is of topic {number}, of none", row.id))?;
            if !sink.wants(topic) {
                return Ok(());
            }
            match value(&row.record(pages)?, of_data) {
                Some(SqliteValue::Blob(data)) => {
                    let message = Message { data, recorded_ns: None };
                    sink.add_message(topic, &message).map_err(Trouble::Refused)
                }
                _ => Err(format!("message {} has no data", row.id).into()),
            }
        })
    }
}

impl Table {
    /// Index of a column.
    fn place(&self, name: &str) -> Result<usize, String> {
        let found = self.columns.iter().position(|column| column == name);
        found.ok_or_else(|| format!("a table has no column {name}"))
    }
}
