use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
    thread,
};

use crate::common::error::FormatError;

/// Stack of a decoder that follows what a file nests (bytes). The deepest nesting that the decoders allow takes a
/// hundredth of it.
const STACK: usize = 1 << 26;

/// Runs a decoder of another crate and turns its panic into an error. Some decoders panic at a damaged file.
pub(crate) fn guard<T>(
    path: &Path,
    kind: &'static str,
    decode: impl FnOnce() -> Result<T, FormatError>,
) -> Result<T, FormatError> {
    catch_unwind(AssertUnwindSafe(decode)).unwrap_or_else(|_| Err(gave_up(path, kind)))
}

fn gave_up(path: &Path, kind: &'static str) -> FormatError {
    FormatError::broken(path, kind, &"the decoder gave up")
}

/// The same for a decoder that follows groups, links and types into one another: on a stack of its own, which is that
/// deep wherever the program is called from.
pub(crate) fn guard_deep<T: Send>(
    path: &Path,
    kind: &'static str,
    decode: impl FnOnce() -> Result<T, FormatError> + Send,
) -> Result<T, FormatError> {
    thread::scope(|scope| {
        let work = || guard(path, kind, decode);
        let begun = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work);
        let begun = begun.map_err(|e| FormatError::unreadable(path, &e))?;
        begun.join().unwrap_or_else(|_| Err(gave_up(path, kind)))
    })
}
