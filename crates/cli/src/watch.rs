use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use crate::error::CliError;
use crate::messages::tell;
use crate::progress::Line;

/// Exit code of a program that Ctrl-C has ended.
const INTERRUPTED: i32 = 130;

/// The answer to the first Ctrl-C.
const STOPPING: &str =
    "stopping: what is begun comes to its end; another Ctrl-C ends the program now";

/// Shows what is being done, and ends it at Ctrl-C, searches with the best they have; a second
/// one ends the program.
pub struct Watch {
    line: Option<Line>,
    /// What is done and the part of it that is.
    stage: Mutex<[String; 2]>,
    /// Seconds of motion simulated since it began.
    seconds: AtomicUsize,
    stop: Arc<AtomicBool>,
    /// Whether a search was ended since the last query.
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
            tell(&STOPPING);
        })
        .map_err(|error| CliError::Signal { reason: error.to_string() })?;
        Ok(Self { stop, ..Self::of_all(line) })
    }

    /// Shows what is done; Ctrl-C ends the program where it is.
    pub fn of_all(line: Option<Line>) -> Self {
        Self {
            line,
            stage: Mutex::default(),
            seconds: AtomicUsize::new(0),
            stop: Arc::default(),
            ended: AtomicBool::new(false),
        }
    }

    /// Leaves words on the standard error, where anything is shown.
    pub fn leave(&self, words: &str) {
        self.line.iter().for_each(|line| line.leave(words));
    }

    /// Begins work that has no stages of its own.
    pub fn begin(&self, what: &str) {
        *self.stage.lock().unwrap_or_else(PoisonError::into_inner) =
            [what.to_owned(), String::new()];
        self.seconds.store(0, Ordering::Relaxed);
        self.say("");
    }

    /// Whether Ctrl-C was pressed.
    pub fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Whether a search was ended since the last call.
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

impl learner::TrainingProgress for Watch {
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

impl diagnosis::DiagnosisProgress for Watch {
    fn stage(&self, name: &str, _: usize) {
        self.begin(name);
    }

    fn step(&self) {}
}

impl experiment::Progress for Watch {
    fn begin(&self, what: &str) {
        self.begin(what);
    }

    fn second(&self) {
        let seconds = 1 + self.seconds.fetch_add(1, Ordering::Relaxed);
        self.say(&format!("{seconds} s done"));
    }

    fn is_stopped(&self) -> bool {
        self.is_stopped()
    }
}
