use cli::CliError;
use files::shorten_words;
use pyo3::PyErr;
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;

create_exception!(
    plumbline,
    PlumblineError,
    PyValueError,
    "A robot, a log, a scenario or a model that cannot be used, in the words of the program."
);

/// The exception that an error of the program becomes: its sentence, and what to do about it.
pub fn exception(error: impl Into<CliError>) -> PyErr {
    let error = error.into();
    let words = error.words();
    // Errors of a place in a file begin as the program prints them.
    let words = words.strip_prefix("error: ").unwrap_or(&words);
    PlumblineError::new_err(match error.help() {
        Some(help) => format!("{words}\nhelp: {}", shorten_words(&help)),
        None => words.to_owned(),
    })
}
