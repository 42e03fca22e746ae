use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
};

use crate::common::error::FormatError;

/// Runs a decoder of another crate and turns its panic into an error. Some decoders panic at a damaged file.
pub(crate) fn guard<T>(
    path: &Path,
    kind: &'static str,
    decode: impl FnOnce() -> Result<T, FormatError>,
) -> Result<T, FormatError> {
    catch_unwind(AssertUnwindSafe(decode))
        .unwrap_or_else(|_| Err(FormatError::broken(path, kind, &"the decoder gave up")))
}
