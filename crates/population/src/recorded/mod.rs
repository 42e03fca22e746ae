//! Recorded logs of real arms as trials: as they are, and with a cause added to them.
//!
//! ```text
//! folder of logs -> arm -> logs, thinned and cut -> given and held out ----------> plain trial
//!                                                          \--> + law(q, qd, effort) -> transplant
//! ```

pub(crate) mod arm;
pub(crate) mod cut;
pub(crate) mod draw;
pub(crate) mod law;
pub(crate) mod point_mass;
pub(crate) mod signals;
pub(crate) mod size;
pub(crate) mod transplant;
pub(crate) mod trial;
