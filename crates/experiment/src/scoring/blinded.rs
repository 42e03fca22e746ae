use std::path::Path;

use serde::Deserialize;
use simulator::{StrangerTruth, Truth};

use crate::error::ExperimentError;

/// The truth about simulated logs, read only after they are diagnosed.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Blinded {
    /// The seed of all random draws.
    pub seed: u64,
    /// The injected effects.
    pub effects: Vec<Truth>,
    /// The injected effects that no catalogue has.
    #[serde(default)]
    pub strangers: Vec<StrangerTruth>,
}

impl Blinded {
    /// Name of the file with the truth, beside the logs.
    pub const FILE: &str = "truth.json";

    /// Reads the truth about the logs of a folder.
    ///
    /// # Errors
    ///
    /// [`ExperimentError::UnreadableTruth`].
    pub fn open(folder: &Path) -> Result<Self, ExperimentError> {
        let path = folder.join(Self::FILE);
        let unreadable = |reason| ExperimentError::UnreadableTruth { path: path.clone(), reason };
        let text = files::text(&path, files::KEPT_BYTES).map_err(|e| unreadable(e.to_string()))?;
        serde_json::from_str(&text).map_err(|e| unreadable(e.to_string()))
    }
}
