use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use learner::Progress;

use crate::error::CliError;
use crate::progress::Line;

/// Exit code of a program that Ctrl-C has ended.
const INTERRUPTED: i32 = 130;

/// Shows what a training does, and ends its searches at Ctrl-C; a second one ends the program.
pub struct Watch {
    line: Option<Line>,
    /// Name of the model and what is done for it.
    stage: Mutex<[String; 2]>,
    stop: Arc<AtomicBool>,
    /// Whether a search was ended since it was last asked.
    ended: AtomicBool,
}

impl Watch {
    /// Listens to Ctrl-C from now on, and shows on `line` what is done, if there is one.
    ///
    /// # Errors
    ///
    /// [`CliError::Signal`].
    pub fn new(line: Option<Line>) -> Result<Self, CliError> {
        let stop = Arc::new(AtomicBool::new(false));
        let pressed = Arc::clone(&stop);
        ctrlc::set_handler(move || {
            if pressed.swap(true, Ordering::Relaxed) {
                std::process::exit(INTERRUPTED);
            }
        })
        .map_err(|error| CliError::Signal { reason: error.to_string() })?;
        Ok(Self { line, stage: Mutex::default(), stop, ended: AtomicBool::new(false) })
    }

    /// Something is done that has no stages of its own.
    pub fn begin(&self, what: &str) {
        *self.stage.lock().unwrap_or_else(PoisonError::into_inner) =
            [what.to_owned(), String::new()];
        self.say("");
    }

    /// Whether Ctrl-C was pressed.
    pub fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Whether a search was ended since the last time that this was asked.
    pub fn took_an_end(&self) -> bool {
        self.ended.swap(false, Ordering::Relaxed)
    }

    /// Takes the line away.
    pub fn finish(&self) {
        self.line.iter().for_each(Line::finish);
    }

    fn say(&self, detail: &str) {
        let Some(line) = &self.line else { return };
        let stage = self.stage.lock().unwrap_or_else(PoisonError::into_inner);
        let [what, words] = &*stage;
        let parts = [what.as_str(), words, detail].into_iter().filter(|part| !part.is_empty());
        let parts = parts.chain(self.is_stopped().then_some("stopping"));
        line.say(&parts.collect::<Vec<_>>().join(": "));
    }
}

impl Progress for Watch {
    fn stage(&self, words: &str) {
        self.stage.lock().unwrap_or_else(PoisonError::into_inner)[1] = words.to_owned();
        self.say("");
    }

    fn evaluation(&self, evaluations: usize, best: f64) -> ControlFlow<()> {
        self.say(&format!("{evaluations} evaluations, log likelihood {best:.1}"));
        if !self.is_stopped() {
            return ControlFlow::Continue(());
        }
        self.ended.store(true, Ordering::Relaxed);
        ControlFlow::Break(())
    }
}
