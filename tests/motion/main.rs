//! Reference motions: derivatives, limits, figures, mistakes, the WAM's excitation.
#![allow(clippy::unwrap_used, reason = "tests may stop")]

mod derivatives;
mod excitation;
mod figures;
mod limits;
mod mistakes;
mod recorded;
mod sequences;
mod sinusoids;
mod support;
