use std::path::PathBuf;

use benchmark::{Campaign, CampaignFolder, Record, read_finished};
use cli::{create_folder, display_path, print};
use document::Document;

use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

/// Characters of a line.
const WIDTH: usize = 80;

/// Arguments of `plan`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The campaign (TOML)
    campaign: PathBuf,
    /// Folder for the campaign and its trials
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Trials of this campaign that are made already: trials.parquet of folders that were merged
    #[arg(long, value_name = "FILE", num_args = 1..)]
    made: Vec<PathBuf>,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
}

/// Plans a campaign and takes over the trials that are made already.
pub fn run(arguments: &Arguments) -> Result<BenchExitStatus, BenchError> {
    let campaign = Campaign::from_document(&Document::read(&arguments.campaign)?)?;
    let read = |table: &PathBuf| -> Result<Vec<Record>, BenchError> {
        Ok(read_finished(&campaign, table)?)
    };
    let made: Result<Vec<_>, BenchError> = arguments.made.iter().map(read).collect();
    let made = made?.concat();
    create_folder(&arguments.out)?;
    let folder = CampaignFolder::plan(&arguments.out, campaign)?;
    let taken = folder.take(&made)?;
    if !arguments.quiet {
        let out = display_path(&arguments.out);
        let made = match taken {
            0 => "To make them".to_owned(),
            taken => format!("{taken} are made already. To make the others"),
        };
        print(&format!(
            "{}\n{made}:\n  plumbline-bench work {out}\n",
            contents(folder.campaign())
        ))?;
    }
    Ok(BenchExitStatus::Good)
}

/// How many trials, and of what.
fn contents(campaign: &Campaign) -> String {
    let (trials, kinds) = (campaign.trials(), campaign.kinds());
    let Some(each) = trials.checked_div(kinds.len()) else {
        return format!("{trials} trials of a population");
    };
    let names: Vec<String> = kinds.iter().map(ToString::to_string).collect();
    let names = report::pack(names.iter().map(String::as_str), ", ", WIDTH).join(",\n");
    format!("{trials} trials, {each} of each kind:\n{names}")
}
