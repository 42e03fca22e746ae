//! The servos of a robot in the files of other programs.

pub(crate) mod bam;
pub(crate) mod fates;
pub(crate) mod isaac_lab;
pub(crate) mod mjcf;
