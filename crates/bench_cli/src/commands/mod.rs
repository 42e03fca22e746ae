//! The commands, one file or folder each.

pub mod account;
pub mod board;
pub mod compare;
pub mod damage;
pub mod export;
pub mod figure;
pub mod merge;
pub mod missing;
pub mod plan;
pub mod schema;
pub mod score;
pub mod sheets;
pub mod status;
pub mod submit;
pub mod times;
pub mod trial_pace;
pub mod work;
pub mod work_line;
