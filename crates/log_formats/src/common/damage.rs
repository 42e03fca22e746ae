use crate::common::error::FormatError;

/// How a damaged log is treated.
#[derive(Debug, Default)]
pub enum Damage {
    /// The log is refused.
    #[default]
    Refused,
    /// The log is read up to the damage. The error found there is kept.
    CutOff(Option<Box<FormatError>>),
}

impl Damage {
    /// Keeps an error that ends the log. Of several errors the first is kept.
    ///
    /// # Errors
    ///
    /// The error itself, where the log is to be refused or the error has no place in the log.
    pub fn take(&mut self, error: FormatError) -> Result<(), FormatError> {
        let is_at_a_place = matches!(
            error,
            FormatError::Broken { .. }
                | FormatError::NotANumber { .. }
                | FormatError::MissingValue { .. }
                | FormatError::NotFinite { .. }
                | FormatError::TimeNotIncreasing { .. }
                | FormatError::WrongFieldCount { .. }
                | FormatError::Unreadable { .. }
        );
        match self {
            Self::CutOff(found) if is_at_a_place => {
                found.get_or_insert_with(|| Box::new(error));
                Ok(())
            }
            _ => Err(error),
        }
    }
}
