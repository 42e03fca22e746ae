use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
};

use crate::common::error::FormatError;

/// Runs a decoder of another crate, which may panic at a damaged file of this kind instead of
/// refusing it.
pub(crate) fn guard<T>(
    path: &Path,
    kind: &'static str,
    decode: impl FnOnce() -> Result<T, FormatError>,
) -> Result<T, FormatError> {
    catch_unwind(AssertUnwindSafe(decode))
        .unwrap_or_else(|_| Err(FormatError::broken(path, kind, &"the decoder gave up")))
}
