//! Blind trials: what is hidden in a simulated arm, and how well a diagnosis names it.

mod hidden;
mod score;
mod share;
mod size;
mod tally;
mod tally_text;
mod trial;

pub use hidden::Hidden;
pub use score::{Named, PutIn, Score};
pub use share::Share;
pub use size::{Estimated, Size};
pub use tally::{Group, Row, SizeTally, Tally};
pub use trial::{Trial, judge};
