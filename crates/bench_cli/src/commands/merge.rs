use std::path::PathBuf;

use benchmark::{CampaignFolder, KindCount, MergedPanel, Record};
use cli::{display_path, print};
use report::{FileHash, Provenance, sha256_of};

use crate::commands::missing::{Folder, missing, sentences};
use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

/// Puts the trials that are made together: tables, `trials.parquet`, `tally.json`, `report.html`.
pub fn run(arguments: &Folder) -> Result<BenchExitStatus, BenchError> {
    let root = arguments.folder.as_path();
    let folder = CampaignFolder::open(root)?;
    let made = folder.manifest()?;
    let doubts = missing(&made, &KindCount::all(&folder, &made));
    let provenance = provenance(&folder)?;
    let merged = MergedPanel::new(&folder, &made);
    let page = benchmark::panel_page(&merged, &doubts, &provenance)?;
    let json = serde_json::to_string_pretty(&merged).map_err(std::io::Error::from)?;
    let records: Vec<Record> = made.records.into_values().collect();
    Record::write(&root.join("trials.parquet"), &records)?;
    let files = [("tally.json", json.as_bytes()), ("report.html", page.as_bytes())];
    report::write_folder(root, &files)?;
    print(&format!("{}{}", merged.text(), sentences(&doubts)))?;
    print(&format!("\nreport  {}\n", display_path(&root.join("report.html"))))?;
    Ok(if doubts.is_empty() { BenchExitStatus::Good } else { BenchExitStatus::Gap })
}

/// The same for whoever merges, wherever the folder lies.
fn provenance(folder: &CampaignFolder) -> Result<Provenance, BenchError> {
    let file = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Ok(FileHash { role: "campaign", path: name, sha256: sha256_of(path)? })
    };
    Ok(Provenance {
        program: cli::program_name(),
        version: env!("CARGO_PKG_VERSION"),
        command: ["plumbline-bench", "merge"].map(str::to_owned).to_vec(),
        files: folder.plans().iter().map(file).collect::<Result<_, BenchError>>()?,
        seed: None,
    })
}
