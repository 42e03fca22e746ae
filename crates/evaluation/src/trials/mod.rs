//! Blind trials: what is hidden in a simulated arm, and how well a diagnosis names it.

mod campaign;
mod campaign_folder;
mod confusion;
mod hidden;
mod kind_count;
mod merged;
mod part;
mod power;
mod record;
mod score;
mod share;
mod size;
mod smallest;
mod stored;
mod table;
mod tally;
mod tally_text;
mod trial;
mod work;

pub use campaign::{Campaign, CampaignSpec};
pub use campaign_folder::{BrokenShard, CampaignFolder, Made};
pub use confusion::Confusion;
pub use hidden::Hidden;
pub use kind_count::KindCount;
pub use merged::{Failure, MERGED_SCHEMA, Merged};
pub use part::{NoPart, Part};
pub use power::{Power, SizeClass};
pub use record::Record;
pub use score::{Named, PutIn, Score};
pub use share::Share;
pub use size::{Estimated, Size};
pub use table::TextTable;
pub use tally::{Group, Row, SizeTally, Tally};
pub use trial::{Trial, judge};
pub use work::{Crew, TrialLogs, WorkProgress, work};
