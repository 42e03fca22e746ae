mod compare;
mod crew;
mod pace;
mod shift;
mod submit;

use std::path::{Path, PathBuf};

use clap::Subcommand;
use document::Document;
use evaluation::{
    Campaign, CampaignFolder, KindCount, Made, Merged, MergedPanel, Record, finished, work,
};
use report::{FileHash, Provenance, sha256_of};

use crate::Outcome;
use crate::error::CliError;
use crate::output::{create_folder, print, shown};
use crate::progress::Line;

pub use self::submit::SubmitError;

use self::shift::Shift;

/// Characters of a line.
const WIDTH: usize = 80;

/// What to do with blind trials.
#[derive(Debug, Subcommand)]
pub enum Action {
    /// Puts a campaign into a folder, with all that it needs
    Plan(Plan),
    /// Makes every trial that is left; may be ended and begun again, and run several times at once
    Work(crew::Arguments),
    /// Has a cluster that shares the folder make every trial that is left, a part a task
    Submit(submit::Arguments),
    /// Says how many trials are made, failed, broken and left
    Status(Folder),
    /// Puts the trials that are made together: tables, trials.parquet, tally.json, report.html
    Merge(Folder),
    /// Compares two results of the same trials, trial by trial: wins, losses and which trials turned
    Compare(compare::Arguments),
}

/// Arguments of `trials plan`.
#[derive(Debug, clap::Args)]
pub struct Plan {
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

/// Arguments of `trials status` and `trials merge`.
#[derive(Debug, clap::Args)]
pub struct Folder {
    /// The folder of a campaign that was planned
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

/// Plans, makes, submits and puts together blind trials.
pub fn run(action: &Action) -> Result<Outcome, CliError> {
    match action {
        Action::Plan(arguments) => plan(arguments),
        Action::Work(arguments) => make(arguments),
        Action::Submit(arguments) => submit::run(arguments),
        Action::Status(arguments) => status(&arguments.folder),
        Action::Merge(arguments) => merge(&arguments.folder),
        Action::Compare(arguments) => compare::run(arguments),
    }
}

fn plan(arguments: &Plan) -> Result<Outcome, CliError> {
    let campaign = Campaign::from_document(&Document::read(&arguments.campaign)?)?;
    let read =
        |table: &PathBuf| -> Result<Vec<Record>, CliError> { Ok(finished(&campaign, table)?) };
    let made: Result<Vec<_>, CliError> = arguments.made.iter().map(read).collect();
    let made = made?.concat();
    create_folder(&arguments.out)?;
    let folder = CampaignFolder::plan(&arguments.out, campaign)?;
    let taken = folder.take(&made)?;
    if !arguments.quiet {
        let out = shown(&arguments.out);
        let made = match taken {
            0 => "To make them".to_owned(),
            taken => format!("{taken} are made already. To make the others"),
        };
        print(&format!(
            "{}\n{made}:\n  plumbline trials work {out}\n",
            contents(folder.campaign())
        ))?;
    }
    Ok(Outcome::Good)
}

/// How many trials, and of what.
fn contents(campaign: &Campaign) -> String {
    let (trials, kinds) = (campaign.trials(), campaign.kinds());
    let Some(each) = trials.checked_div(kinds.len()) else {
        return format!("{trials} trials of a population");
    };
    let names: Vec<String> = kinds.iter().map(ToString::to_string).collect();
    let names = report::packed(names.iter().map(String::as_str), ", ", WIDTH).join(",\n");
    format!("{trials} trials, {each} of each kind:\n{names}")
}

fn make(arguments: &crew::Arguments) -> Result<Outcome, CliError> {
    let folder = CampaignFolder::open(&arguments.folder)?;
    let crew = arguments.crew();
    let shift = Shift::new(crew.jobs, (!arguments.quiet).then(Line::new))?;
    let worked = work(&folder, &crew, &shift);
    shift.finish();
    worked?;
    let left = folder.left(crew.part)?.len();
    if !arguments.quiet {
        print(&format!("{}\n", shift.summary(left)))?;
    }
    Ok(if left == 0 { Outcome::Good } else { Outcome::Gap })
}

fn status(folder: &Path) -> Result<Outcome, CliError> {
    let folder = CampaignFolder::open(folder)?;
    let made = folder.made()?;
    let counts = KindCount::all(&folder, &made);
    print(&KindCount::table(&counts).text(1))?;
    let doubts = doubts(&made, &counts);
    print(&sentences(&doubts))?;
    Ok(if doubts.is_empty() { Outcome::Good } else { Outcome::Gap })
}

fn merge(root: &Path) -> Result<Outcome, CliError> {
    let folder = CampaignFolder::open(root)?;
    let made = folder.made()?;
    let doubts = doubts(&made, &KindCount::all(&folder, &made));
    let provenance = provenance(&folder)?;
    let (text, json, page) = match folder.campaign() {
        Campaign::Scenario(_) => {
            let merged = Merged::new(&folder, &made);
            let page = report::trials_page(&merged, &doubts, &provenance)?;
            (merged.text(), serde_json::to_string_pretty(&merged), page)
        }
        Campaign::Population(_) => {
            let merged = MergedPanel::new(&folder, &made);
            let page = report::panel_page(&merged, &doubts, &provenance)?;
            (merged.text(), serde_json::to_string_pretty(&merged), page)
        }
    };
    let json = json.map_err(std::io::Error::from)?;
    let records: Vec<Record> = made.records.into_values().collect();
    Record::write(&root.join("trials.parquet"), &records)
        .map_err(evaluation::EvaluationError::Log)?;
    let files = [("tally.json", json.as_bytes()), ("report.html", page.as_bytes())];
    report::write_folder(root, &files)?;
    print(&format!("{text}{}", sentences(&doubts)))?;
    print(&format!("\nreport  {}\n", shown(&root.join("report.html"))))?;
    Ok(if doubts.is_empty() { Outcome::Good } else { Outcome::Gap })
}

/// What is missing, in sentences.
fn doubts(made: &Made, counts: &[KindCount]) -> Vec<String> {
    let broken = made
        .broken
        .iter()
        .map(|broken| format!("{}: it does not count, {}", shown(&broken.path), broken.reason));
    let left = counts.last().filter(|all| all.open() > 0).map(|all| {
        format!("{} of {} trials are left to make: plumbline trials work", all.open(), all.trials())
    });
    broken.chain(left).collect()
}

/// Sentences on lines of their own, a blank one above.
fn sentences(all: &[String]) -> String {
    if all.is_empty() { String::new() } else { format!("\n{}\n", all.join("\n")) }
}

/// The same for whoever merges, wherever the folder lies.
fn provenance(folder: &CampaignFolder) -> Result<Provenance, CliError> {
    let file = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Ok(FileHash { role: "campaign", path: name, sha256: sha256_of(path)? })
    };
    Ok(Provenance {
        program: "plumbline",
        version: env!("CARGO_PKG_VERSION"),
        command: ["plumbline", "trials", "merge"].map(str::to_owned).to_vec(),
        files: folder.plans().iter().map(file).collect::<Result<_, CliError>>()?,
        seed: None,
    })
}
