use crate::LogError;

/// What becomes of a log that is damaged somewhere.
#[derive(Debug, Default)]
pub(crate) enum Damage {
    /// It is refused.
    #[default]
    Refused,
    /// It is read up to there; what was found there is kept.
    CutOff(Option<Box<LogError>>),
}

impl Damage {
    /// Takes what was found at the end of what is whole.
    ///
    /// # Errors
    ///
    /// What was found, of a log that is then refused. Only what is wrong at a place in the log can be
    /// taken, and only once.
    pub fn take(&mut self, error: LogError) -> Result<(), LogError> {
        let is_at_a_place = matches!(
            error,
            LogError::Broken { .. }
                | LogError::NotANumber { .. }
                | LogError::MissingValue { .. }
                | LogError::NotFinite { .. }
                | LogError::TimeNotIncreasing { .. }
                | LogError::WrongFieldCount { .. }
                | LogError::Unreadable { .. }
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
