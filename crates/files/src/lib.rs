//! Files that someone names, read in one way.
//!
//! Whoever names a file – a person on the command line, a key of a document, an attribute of a description – may
//! name anything: a pipe that never ends, a device, a folder, the passwords of the computer. What is read here
//! is a regular file of a bounded size, and an error says what was found without a word of its content. Names and
//! numbers that a message quotes from a file have a bounded length.

mod error;
mod long_words;
mod named_file;

pub use error::FileError;
pub use long_words::{MESSAGE, WORD, shorten, shorten_words};
pub use named_file::{KEPT_BYTES, bytes, each_piece, is_below, open, read_some, text};
