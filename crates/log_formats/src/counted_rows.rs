use crate::{
    common::{
        damage::Damage,
        dates::TIME,
        error::FormatError,
        table::{Needed, Table},
    },
    file_format::Opened,
};

/// A log without time, whose rows are evenly spaced: sample `k`, counted from 0, has `time = k / rate_hz` (s).
pub struct CountedRows {
    /// The log.
    pub log: Box<dyn Opened>,
    /// Number of rows a second.
    pub rate_hz: f64,
}

impl Opened for CountedRows {
    /// The names of the log, and `time`.
    fn names(&self) -> Result<Vec<String>, FormatError> {
        let mut names = self.log.names()?;
        if !names.iter().any(|name| name == TIME) {
            names.insert(0, TIME.to_owned());
        }
        Ok(names)
    }

    fn load(&self, needed: &Needed, damage: &mut Damage) -> Result<Table, FormatError> {
        // Arrays are as long as the first signal.
        let first = needed.signals.first().copied().unwrap_or_default();
        let of_log = Needed { time: first, signals: needed.signals.clone(), excerpt: None };
        let mut table = self.log.load(&of_log, damage)?;
        let samples = table.columns.values().map(Vec::len).max().unwrap_or(0);
        let time = (0..samples).map(|k| k as f64 / self.rate_hz).collect();
        table.columns.insert(TIME.to_owned(), time);
        Ok(table.excerpt(needed))
    }

    fn sha256(&self) -> Result<String, FormatError> {
        self.log.sha256()
    }

    fn is_unnamed(&self) -> bool {
        self.log.is_unnamed()
    }

    fn is_torn(&self) -> bool {
        self.log.is_torn()
    }
}
