//! The dynamics against other engines, closed forms and the identities of mechanics.

#![allow(clippy::unwrap_used, reason = "a test that cannot build its input has failed")]

mod allocation;
mod base_parameters;
mod closed_form;
mod consistency;
mod golden;
mod identities;
