use crate::common::error::FormatError;

/// What becomes of a log that is damaged somewhere.
#[derive(Debug, Default)]
pub enum Damage {
    /// It is refused.
    #[default]
    Refused,
    /// It is read up to there; what was found there is kept.
    CutOff(Option<Box<FormatError>>),
}

impl Damage {
    /// Takes what was found at the end of what is whole.
    ///
    /// # Errors
    ///
    /// What was found, of a log that is then refused. Only what is wrong at a place in the log can be
    /// taken, and only once.
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
