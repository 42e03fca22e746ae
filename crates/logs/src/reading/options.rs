use log_formats::{Excerpt, LerobotDataset, Request};

use crate::naming::column_map::ColumnMap;

/// How a log is read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReadOptions<'a> {
    /// Names and units of the columns, for a file that does not use the usual ones.
    pub map: Option<&'a ColumnMap>,
    /// Name of the column of time, where the map gives none.
    pub time: &'a str,
    /// Suffix of the effort columns: the effort is read from `<joint>.<effort>`. The default is `effort`. With another
    /// value the columns `<joint>.effort` are kept among the further ones, and the `effort` entries of the
    /// column map are ignored.
    pub effort: &'a str,
    /// The topic of a bag from which joint states are read. By default it is `/joint_states`, or else the only topic of
    /// the type.
    pub topic: Option<&'a str>,
    /// The seconds of the log that are read; by default all. Rows outside are ignored, also by checks.
    pub excerpt: Option<Excerpt>,
    /// The episode of a LeRobot dataset; it may be left out for a dataset with a single episode.
    pub episode: Option<u64>,
    /// The dataset at the path, where it is open already. Its column of episodes is then not read again.
    pub dataset: Option<&'a LerobotDataset>,
}

impl Default for ReadOptions<'_> {
    fn default() -> Self {
        Self {
            map: None,
            time: "time",
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
        self.map.and_then(ColumnMap::time).map_or(self.time, |mapped| &mapped.column)
    }

    /// The part of the file that is read.
    pub(crate) fn request(&self) -> Request<'a> {
        Request { time: self.time(), topic: self.topic, episode: self.episode }
    }
}
