use benchmark::{CampaignFolder, KindCount};
use cli::print;

use crate::commands::missing::{Folder, missing, sentences};
use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

/// Prints how many trials are made, failed, broken and left.
pub fn run(arguments: &Folder) -> Result<BenchExitStatus, BenchError> {
    let folder = CampaignFolder::open(&arguments.folder)?;
    let made = folder.manifest()?;
    let counts = KindCount::all(&folder, &made);
    print(&KindCount::table(&counts).text(1))?;
    let doubts = missing(&made, &counts);
    print(&sentences(&doubts))?;
    Ok(if doubts.is_empty() { BenchExitStatus::Good } else { BenchExitStatus::Gap })
}
