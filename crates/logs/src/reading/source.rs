use std::collections::BTreeMap;

use crate::naming::map_entry::MappedColumn;

/// Where one signal comes from.
pub(crate) struct Source<'a> {
    pub column: String,
    pub mapped: Option<&'a MappedColumn>,
}

impl Source<'_> {
    pub(crate) fn take(&self, columns: &BTreeMap<String, Vec<f64>>) -> Vec<f64> {
        let raw = columns.get(&self.column).map(Vec::as_slice).unwrap_or_default();
        match self.mapped {
            Some(mapped) => raw.iter().map(|&x| mapped.convert(x)).collect(),
            None => raw.to_vec(),
        }
    }
}
