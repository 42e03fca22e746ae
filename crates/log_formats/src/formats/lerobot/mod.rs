//! Datasets of LeRobot, versions 2 and 3: a folder of Parquet files.

pub(crate) mod dataset;
pub(crate) mod episode;
