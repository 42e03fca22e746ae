use log_formats::{Excerpt, LerobotDataset, Request};

use crate::naming::column_map::ColumnMap;

/// How a log is read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReadOptions<'a> {
    /// Names and units of a file that has its own.
    pub map: Option<&'a ColumnMap>,
    /// The effort is read from the columns `<joint>.<effort>`, by default `effort`; the
    /// columns `<joint>.effort` then stay among the further ones. With another value the
    /// column map's `effort` entries are not used.
    pub effort: &'a str,
    /// The topic of a bag whose joint states are read; `/joint_states` or the only one of the type
    /// where it is left out.
    pub topic: Option<&'a str>,
    /// The seconds that are read, or the whole log. Rows outside are ignored, also by checks.
    pub excerpt: Option<Excerpt>,
    /// The episode of a dataset of LeRobot; one that has a single episode needs none.
    pub episode: Option<u64>,
    /// The dataset at the path, where it is open already, so that its column of episodes is read once.
    pub dataset: Option<&'a LerobotDataset>,
}

impl Default for ReadOptions<'_> {
    fn default() -> Self {
        Self {
            map: None,
            effort: "effort",
            topic: None,
            excerpt: None,
            episode: None,
            dataset: None,
        }
    }
}

impl<'a> ReadOptions<'a> {
    /// Name of the column of time.
    pub(crate) fn time(&self) -> &'a str {
        self.map.and_then(ColumnMap::time).map_or("time", |mapped| &mapped.column)
    }

    /// What is asked of the file.
    pub(crate) fn request(&self) -> Request<'a> {
        Request { time: self.time(), topic: self.topic, episode: self.episode }
    }
}
