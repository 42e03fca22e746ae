use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use benchmark::{
    BenchmarkError, Campaign, DAMAGE_SIZES, DamageCurves, DamageOutcome, damage_kinds,
};
use clap::builder::PossibleValuesParser;
use cli::{Line, create_folder, print};
use document::Document;

use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

/// Arguments of `damage`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// A campaign of a population (TOML), whose simulated trials are spoilt
    campaign: PathBuf,
    /// Folder for the trials, damage.json and damage.txt
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Kinds of damage; all of them where it is left out
    #[arg(
        long,
        value_name = "KIND",
        num_args = 1..,
        value_parser = PossibleValuesParser::new(damage_kinds().map(|kind| kind.name()))
    )]
    kinds: Vec<String>,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
}

/// Spoils the logs of a few trials more and more, and says what each answer becomes. A new name with nothing left open
/// is a gap.
pub fn run(arguments: &Arguments) -> Result<BenchExitStatus, BenchError> {
    let Campaign::Population(campaign) =
        Campaign::from_document(&Document::read(&arguments.campaign)?)?
    else {
        let path = arguments.campaign.clone();
        return Err(BenchmarkError::NoPopulation { path }.into());
    };
    create_folder(&arguments.out)?;
    let asked =
        |name: &str| arguments.kinds.is_empty() || arguments.kinds.iter().any(|kind| kind == name);
    let kinds: Vec<_> = damage_kinds().filter(|kind| asked(kind.name())).collect();
    let all = kinds.len() * DAMAGE_SIZES.len() * campaign.population.trials;
    let (line, answered) = (Line::new(), AtomicUsize::new(0));
    let on_point = || {
        let count = answered.fetch_add(1, Ordering::Relaxed) + 1;
        if !arguments.quiet {
            line.say(&format!("{count} of {all} spoilt logs answered"));
        }
    };
    let measured = DamageCurves::measure(&campaign, &kinds, &arguments.out, &on_point);
    line.finish();
    let curves = measured?;
    let text = curves.text();
    let json = serde_json::to_string_pretty(&curves).map_err(std::io::Error::from)? + "\n";
    let files = [("damage.json", json.as_bytes()), ("damage.txt", text.as_bytes())];
    report::write_folder(&arguments.out, &files)?;
    if !arguments.quiet {
        print(&text)?;
    }
    let wrong = curves.count(DamageOutcome::Wrong);
    Ok(if wrong == 0 { BenchExitStatus::Good } else { BenchExitStatus::Gap })
}
