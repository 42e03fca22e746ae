//! The workspace's own rules: floors and walls between crates, what a manifest says, what
//! a source file may hold, and that the documents name things that exist.
//!
//! Every rule is a function from what it looks at to the sentences that tell what breaks
//! it. It is held against this workspace, and against a made-up one that breaks it.
#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

mod book;
mod distribution;
mod documents;
mod floors;
mod manifests;
mod modules;
mod named_files;
mod names;
mod places;
mod references;
mod rings;
mod sealed;
mod security;
mod sources;
mod supply;
mod thresholds;
mod tree;
mod walls;
mod workspace;

/// Fails with every sentence of `broken`.
fn assert_kept(broken: &[String]) {
    assert!(broken.is_empty(), "\n{}\n", broken.join("\n"));
}
