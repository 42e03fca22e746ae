use serde::Serialize;

use crate::panel::judgement::Judgement;
use crate::statistics::share::Share;

/// Clean logs that have some properties in common, and the alarms among them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AlarmRow {
    /// The properties in words; `all` for all clean logs.
    pub logs: String,
    /// Trials in which something false is named or structure is left open.
    pub alarms: Share,
    /// Trials in which something false is named.
    pub named: Share,
    /// Trials in which structure is left open: unexplained, wholly or in part.
    pub unexplained: Share,
    /// Trials whose logs are refused: no alarm, but no answer either.
    pub refused: Share,
}

impl AlarmRow {
    pub(super) fn new(logs: String, clean: &[&Judgement]) -> Self {
        Self {
            logs,
            alarms: Share::of(clean, |one| one.false_alarm() == Some(true)),
            named: Share::of(clean, |one| one.names_falsely()),
            unexplained: Share::of(clean, |one| one.is_open()),
            refused: Share::of(clean, |one| one.refused.is_some()),
        }
    }
}
