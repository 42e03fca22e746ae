use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use benchmark::{Record, WorkProgress};
use cli::{Line, Watch, display_path};

use crate::commands::trial_pace::{TrialPace, words};
use crate::error::BenchError;

/// Shows how the work goes on; Ctrl-C lets the trials that are being made come to their end.
pub struct WorkLine {
    watch: Watch,
    jobs: usize,
    count: Mutex<Count>,
}

#[derive(Default)]
struct Count {
    /// Trials to be made when it began.
    all: usize,
    made: usize,
    failed: usize,
    /// Entries of the store that were made again, in sentences.
    remade: Vec<String>,
    pace: TrialPace,
}

impl WorkLine {
    /// Listens to Ctrl-C from now on, and shows on `line` what is done, if there is one.
    ///
    /// # Errors
    ///
    /// [`cli::CliError::Signal`].
    pub fn new(jobs: usize, line: Option<Line>) -> Result<Self, BenchError> {
        let watch = Watch::new(line)?;
        Ok(Self { watch, jobs, count: Mutex::default() })
    }

    /// Takes the line away.
    pub fn finish(&self) {
        self.watch.finish();
    }

    /// What was done, in a sentence, after those about the store.
    pub fn summary(&self, left: usize) -> String {
        let count = self.count();
        let failed = match count.failed {
            0 => String::new(),
            failed => format!(", {failed} of them failed"),
        };
        let mut lines = count.remade.clone();
        lines.sort();
        lines.push(format!("{} trials made{failed}; {left} left", count.made));
        lines.join("\n")
    }

    fn count(&self) -> MutexGuard<'_, Count> {
        self.count.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn say(&self, count: &Count) {
        let left = count.all.saturating_sub(count.made);
        let time = count.pace.time_left(left, self.jobs).map(words);
        let time = time.map_or(String::new(), |time| format!(", about {time} left"));
        self.watch.begin(&format!(
            "{} of {} trials made, {} failed{time}",
            count.made, count.all, count.failed
        ));
    }
}

impl WorkProgress for WorkLine {
    fn begin(&self, left: usize) {
        let mut count = self.count();
        count.all = left;
        self.say(&count);
    }

    fn finish_trial(&self, record: &Record, took: Duration) {
        let mut count = self.count();
        count.made += 1;
        count.failed += usize::from(record.score.is_err());
        count.pace.add(took);
        self.say(&count);
    }

    fn report_remade(&self, entry: &Path, reason: &str) {
        self.count().remade.push(format!("{}: it was made again, {reason}", display_path(entry)));
    }

    fn is_stopped(&self) -> bool {
        self.watch.is_stopped()
    }
}
