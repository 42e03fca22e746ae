//! LeRobot datasets, versions 2 and 3: folders of Parquet files.

pub(crate) mod dataset;
pub(crate) mod episode;
