use std::collections::BTreeMap;

use crate::{
    common::{
        bounds::MOST_COLUMNS,
        table::{Needed, RowRefusal, Rows, Table, TableCell},
    },
    formats::bag::joint_message::JointMessage,
};

/// The joint states of a topic, in recorded order. Messages may be of different joints.
#[derive(Debug)]
pub(crate) struct JointStates {
    /// Names of the columns, `time` first.
    names: Vec<String>,
    columns: BTreeMap<String, usize>,
    /// Index of each layout in `filled`, by the joints and the channels of a message.
    layouts: BTreeMap<(Vec<String>, Vec<&'static str>), usize>,
    filled: Vec<Vec<usize>>,
    /// Number of names in all layouts.
    named: usize,
    /// Stamp (ns) and layout of every message.
    messages: Vec<(i64, usize)>,
    /// The values of all messages, one after the other.
    values: Vec<f64>,
}

/// Most names in all layouts.
const MOST_NAMES: usize = 1_000_000;

impl JointStates {
    pub(crate) fn new() -> Self {
        Self {
            names: vec!["time".to_owned()],
            columns: BTreeMap::new(),
            layouts: BTreeMap::new(),
            filled: Vec::new(),
            named: 0,
            messages: Vec::new(),
            values: Vec::new(),
        }
    }

    /// Names of the columns.
    pub(crate) fn names(&self) -> &[String] {
        &self.names
    }

    /// Number of messages so far.
    pub(crate) fn count(&self) -> usize {
        self.messages.len()
    }

    /// Adds a message, or gives the reason why it does not fit.
    pub(crate) fn push(&mut self, message: JointMessage) -> Result<(), String> {
        let JointMessage { stamp_ns, joints, channels } = message;
        let names = channels.iter().map(|(name, _)| *name).collect::<Vec<_>>();
        let joints = if names.is_empty() { Vec::new() } else { joints };
        self.values.extend(channels.into_iter().flat_map(|(_, values)| values));
        let key = (joints, names);
        let layout = match self.layouts.get(&key) {
            Some(&layout) => layout,
            None => {
                let filled = self.fill_by(&key.0, &key.1)?;
                self.named += key.0.len();
                if self.named > MOST_NAMES {
                    return Err("its joints are in ever another order".to_owned());
                }
                self.filled.push(filled);
                self.layouts.insert(key, self.filled.len() - 1);
                self.filled.len() - 1
            }
        };
        self.messages.push((stamp_ns, layout));
        Ok(())
    }

    /// The columns of a message with these joints, in the order of its values.
    fn fill_by(&mut self, joints: &[String], channels: &[&str]) -> Result<Vec<usize>, String> {
        let mut filled = Vec::new();
        for channel in channels {
            for joint in joints {
                let joint = joint.replace(char::is_control, "?");
                let name = format!("{joint}.{channel}");
                let next = self.names.len();
                let column = *self.columns.entry(name.clone()).or_insert(next);
                if column == next {
                    self.names.push(name);
                }
                filled.push(column);
            }
        }
        let mut once = filled.clone();
        once.sort_unstable();
        once.dedup();
        if once.len() < filled.len() {
            return Err("it has two joints of one name".to_owned());
        }
        if self.names.len() > MOST_COLUMNS {
            return Err(format!("it is about more than the {MOST_COLUMNS} columns that are read"));
        }
        Ok(filled)
    }

    /// Columns by name. Time (s) is counted from the first message, which keeps nanoseconds exact.
    pub(crate) fn load(&self, needed: &Needed) -> Result<Table, (usize, RowRefusal)> {
        let mut rows = Rows::new(&self.names, needed);
        let start_ns = self.messages.first().map_or(0, |(stamp_ns, _)| *stamp_ns);
        let mut cells = vec![TableCell::Empty; self.names.len()];
        let mut values = self.values.iter();
        for (index, (stamp_ns, layout)) in self.messages.iter().enumerate() {
            cells.fill(TableCell::Empty);
            cells[0] = TableCell::Number((stamp_ns - start_ns) as f64 / 1e9);
            for (&column, &value) in self.filled[*layout].iter().zip(&mut values) {
                cells[column] = TableCell::Number(value);
            }
            rows.push(index + 1, &cells).map_err(|refusal| (index + 1, refusal))?;
        }
        Ok(rows.finish())
    }
}
