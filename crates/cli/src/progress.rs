use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::escape::escape_line;
use crate::messages::tell;
use crate::quiet::Quiet;

/// Work that is done sooner is not worth a bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// A bar on the standard error that appears after a second of work; never where that is
/// not a terminal.
pub struct Bar {
    bar: ProgressBar,
    start: Instant,
}

impl Bar {
    /// A bar that has not appeared yet.
    pub fn new() -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        let style = ProgressStyle::with_template("{msg:36} {bar:40} {pos}/{len} {elapsed}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Self { bar, start: Instant::now() }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }

    fn appear_when_due(&self) {
        // indicatif draws nothing where the standard error is not a terminal.
        if self.bar.is_hidden() && self.start.elapsed() > PATIENCE {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
    }
}

/// Does some work under a bar, or without one where nothing is to be printed.
pub fn with_bar<T>(
    Quiet(quiet): Quiet,
    work: impl FnOnce(&dyn diagnosis::DiagnosisProgress) -> T,
) -> T {
    let bar = Bar::new();
    let done = work(if quiet { &diagnosis::Silent } else { &bar });
    bar.finish();
    done
}

impl diagnosis::DiagnosisProgress for Bar {
    fn stage(&self, name: &str, steps: usize) {
        self.appear_when_due();
        self.bar.set_length(steps as u64);
        self.bar.set_position(0);
        self.bar.set_message(escape_line(name));
    }

    fn step(&self) {
        self.appear_when_due();
        self.bar.inc(1);
    }
}

/// A line on the standard error that says what is being done, after a second of work; never
/// where that is not a terminal.
pub struct Line(Bar);

impl Default for Line {
    fn default() -> Self {
        Self::new()
    }
}

impl Line {
    /// A line that has not appeared yet.
    pub fn new() -> Self {
        let bar = Bar::new();
        let style = ProgressStyle::with_template("{elapsed:>4} {wide_msg}");
        bar.bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
        Self(bar)
    }

    /// Shows these words.
    pub fn say(&self, words: &str) {
        self.0.appear_when_due();
        self.0.bar.set_message(escape_line(words));
    }

    /// Leaves words on the standard error, terminal or not, above the line.
    pub fn leave(&self, words: &str) {
        self.0.bar.suspend(|| tell(&words));
    }

    /// Takes the line away.
    pub fn finish(&self) {
        self.0.finish();
    }
}
