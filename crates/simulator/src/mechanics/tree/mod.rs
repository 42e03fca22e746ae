//! The arm as a tree of bodies, worked out and stepped here: motion and momentum, dry friction, a leapfrog of second
//! order.

mod bodies;
mod held;
mod kick;
pub(crate) mod leapfrog;
mod spatial;
