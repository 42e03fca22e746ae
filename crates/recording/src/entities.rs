use rerun::{EntityPathPart, TimeColumn};

/// The one timeline, in seconds.
pub(crate) const TIMELINE: &str = "t";
/// The entity of the text beside the plots.
pub(crate) const DOCUMENT: &str = "verdict";
/// The entity of what happened during a run.
pub(crate) const EVENTS: &str = "events";

/// Times of rows (s) on the timeline.
pub(crate) fn time_column(time_s: &[f64]) -> TimeColumn {
    TimeColumn::new_duration_secs(TIMELINE, time_s.iter().copied())
}

/// A name as one part of a path, whatever characters it has.
pub(crate) fn part(name: &str) -> EntityPathPart {
    EntityPathPart::new(if name.is_empty() { "unnamed" } else { name })
}
