use std::collections::BTreeMap;

use sha2::{Digest, Sha256};

use crate::{
    common::{
        damage::Damage,
        error::FormatError,
        sha256::hexadecimal,
        table::{Needed, Table},
    },
    file_format::Opened,
};

/// Columns in memory, by name and all of one length, for a log that is not a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns(pub BTreeMap<String, Vec<f64>>);

impl Opened for Columns {
    fn names(&self) -> Result<Vec<String>, FormatError> {
        Ok(self.0.keys().cloned().collect())
    }

    fn load(&self, needed: &Needed, _: &mut Damage) -> Result<Table, FormatError> {
        Ok(Table { columns: self.0.clone(), ..Table::default() }.excerpt(needed))
    }

    /// SHA-256 of the names and the numbers.
    fn sha256(&self) -> Result<String, FormatError> {
        let mut hasher = Sha256::new();
        for (name, samples) in &self.0 {
            hasher.update(format!("{name} {}\n", samples.len()));
            samples.iter().for_each(|x| hasher.update(x.to_le_bytes()));
        }
        Ok(hexadecimal(hasher))
    }
}
