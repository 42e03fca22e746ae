//! Files of meshes: where they are looked for, and what tells one from another file of its name.

pub(crate) mod find;
pub(crate) mod folders;
pub(crate) mod kind;
pub(crate) mod packages;
