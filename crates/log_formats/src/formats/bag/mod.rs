//! ROS 2 bags: files of MCAP or SQLite, or folders of such files.

pub(crate) mod bag_file;
pub(crate) mod cdr;
pub(crate) mod controller_state;
pub(crate) mod folder;
pub(crate) mod folder_files;
pub(crate) mod joint_message;
pub(crate) mod joint_state;
pub(crate) mod joint_states;
pub(crate) mod json_joint_state;
pub(crate) mod mcap;
pub(crate) mod message_kind;
pub(crate) mod sqlite;
pub(crate) mod storage;
pub(crate) mod topic;
