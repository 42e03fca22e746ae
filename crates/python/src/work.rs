use std::any::Any;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::thread::{Builder, scope};
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::{Py, PyAny, PyErr, PyResult, Python};

/// Time between two looks at what Python wants (s).
const LOOK: Duration = Duration::from_millis(50);

/// Stack of the thread that works (bytes): as much as a program's first one has.
const STACK: usize = 8 << 20;

/// Work that goes on: how far it is, and whether it is to end.
#[derive(Default)]
pub struct Work {
    stop: AtomicBool,
    stage: Mutex<Stage>,
}

#[derive(Debug, Default, Clone, PartialEq)]
struct Stage {
    name: String,
    steps: usize,
    done: usize,
}

/// What unwinds the threads of work that is to end.
struct Ended;

/// Does `work` on another thread and without the lock of the interpreter, tells `progress` how far it
/// is (`progress(stage, done, steps)`), and ends it where a signal raises an exception.
///
/// # Errors
///
/// The exception of the signal or of `progress`, and `RuntimeError` for a mistake of this library.
pub fn run<T: Send>(
    py: Python<'_>,
    progress: Option<&Py<PyAny>>,
    work: impl FnOnce(&Work) -> T + Send,
) -> PyResult<T> {
    let state = Work::default();
    let (over, is_over) = channel::<()>();
    let is_over = Mutex::new(is_over);
    let state = &state;
    scope(|scope| {
        let task = move || {
            // Dropped at the end of the work, whatever that is.
            let _over = over;
            work(state)
        };
        let thread = Builder::new().stack_size(STACK).spawn_scoped(scope, task)?;
        let mut interrupted = None;
        let mut told = Stage::default();
        loop {
            let looked = py.detach(|| {
                is_over.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(LOOK)
            });
            if looked != Err(RecvTimeoutError::Timeout) {
                break;
            }
            if let Err(error) =
                py.check_signals().and_then(|()| state.tell(py, progress, &mut told))
            {
                interrupted.get_or_insert(error);
                state.stop.store(true, Ordering::Relaxed);
            }
        }
        let result = py.detach(|| thread.join());
        match (interrupted, result) {
            (Some(error), _) => Err(error),
            (None, Ok(result)) => Ok(result),
            (None, Err(panic)) => Err(mistake(panic.as_ref())),
        }
    })
}

fn mistake(panic: &(dyn Any + Send)) -> PyErr {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("it gave up");
    PyRuntimeError::new_err(format!("a mistake of plumbline, not of yours: {text}"))
}

impl Work {
    /// Begins a stage of as many steps.
    pub fn stage(&self, name: &str, steps: usize) {
        self.go_on();
        *self.lock() = Stage { name: name.to_owned(), steps, done: 0 };
    }

    /// A step of the stage is done.
    pub fn step(&self) {
        self.go_on();
        self.lock().done += 1;
    }

    /// Unwinds where the work is to end.
    fn go_on(&self) {
        if self.stop.load(Ordering::Relaxed) {
            std::panic::resume_unwind(Box::new(Ended));
        }
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Stage> {
        self.stage.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn tell(&self, py: Python<'_>, progress: Option<&Py<PyAny>>, told: &mut Stage) -> PyResult<()> {
        let Some(progress) = progress else { return Ok(()) };
        let stage = self.lock().clone();
        if stage != *told && !stage.name.is_empty() {
            progress.call1(py, (&stage.name, stage.done, stage.steps))?;
            *told = stage;
        }
        Ok(())
    }
}

impl diagnosis::DiagnosisProgress for Work {
    fn stage(&self, name: &str, steps: usize) {
        self.stage(name, steps);
    }

    fn step(&self) {
        self.step();
    }
}

impl learner::TrainingProgress for Work {
    fn stage(&self, words: &str) {
        self.stage(words, 0);
    }

    fn evaluation(&self, _: usize, _: f64) -> ControlFlow<()> {
        self.step();
        ControlFlow::Continue(())
    }
}

impl experiment::Progress for Work {
    fn begin(&self, what: &str) {
        self.stage(what, 0);
    }

    fn second(&self) {
        self.step();
    }

    fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}
