use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
};

use crate::LogError;

/// Runs a decoder of another crate, which may panic at a damaged file of this kind instead of
/// refusing it.
pub(crate) fn guarded<T>(
    path: &Path,
    kind: &'static str,
    decode: impl FnOnce() -> Result<T, LogError>,
) -> Result<T, LogError> {
    catch_unwind(AssertUnwindSafe(decode))
        .unwrap_or_else(|_| Err(LogError::broken(path, kind, &"the decoder gave up")))
}
