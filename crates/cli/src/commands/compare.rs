use std::path::{Path, PathBuf};

use diagnosis::{Comparison, DiagnosisRun, Finding};
use logs::Run;
use report::{Provenance, Report};
use robot::Loaded;

use super::diagnose;
use crate::columns::LogArguments;
use crate::diagnosed_input::{options_of, provenance_in};
use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::input::{RobotArguments, SearchArguments, hashes_of, provenance};
use crate::input_warnings::input_warnings;
use crate::messages::warn;
use crate::output::{display_path, keep_inputs, print_answer, refuse_file};
use crate::progress::with_bar;
use crate::quiet::Quiet;

/// Columns of the text.
const WIDTH: usize = 100;

/// Arguments of `compare`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    robot: RobotArguments,
    /// The first logs (CSV, Parquet, NumPy, MATLAB, HDF5, bags of ROS 2), one run each
    #[arg(long, value_name = "FILE", required = true, num_args = 1..)]
    before: Vec<PathBuf>,
    /// The logs in which something may have changed
    #[arg(long, value_name = "FILE", required = true, num_args = 1..)]
    after: Vec<PathBuf>,
    /// Folder for report.html, comparison.json and the two diagnoses, before and after
    #[arg(long, value_name = "DIR", default_value = "out/compare")]
    out: PathBuf,
    #[command(flatten)]
    reading: LogArguments,
    #[command(flatten)]
    search: SearchArguments,
    /// Print comparison.json instead of the text
    #[arg(long)]
    json: bool,
    /// Print nothing but errors, and the JSON if it is asked for
    #[arg(long)]
    quiet: bool,
}

/// What changed, beside the folders of the two diagnoses.
const PAGE: &str = "report.html";

/// The same for programs.
const JSON: &str = "comparison.json";

/// Folders of the two diagnoses.
const SIDES: [&str; 2] = ["before", "after"];

/// Compares two sets of logs, writes a diagnosis of each and prints what changed.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let out = &arguments.out;
    refuse_file(out)?;
    let loaded = arguments.robot.load()?;
    let read = |paths| arguments.reading.read_runs(paths, &loaded.robot);
    let runs = [read(&arguments.before)?, read(&arguments.after)?];
    if !arguments.quiet {
        input_warnings(&loaded, runs.iter().flatten()).iter().for_each(|warning| warn(warning));
    }
    let robot_files = [&arguments.robot.robot, &loaded.urdf_path];
    let given = || robot_files.into_iter().chain(&arguments.reading.columns.map);
    let inputs = || given().chain(&arguments.before).chain(&arguments.after).map(PathBuf::as_path);
    keep_inputs(out, &[PAGE, JSON], inputs())?;
    for side in SIDES {
        keep_inputs(&out.join(side), &diagnose::FILES, inputs())?;
    }
    let settings = arguments.search.settings(&loaded);
    let sets = [runs[0].as_slice(), runs[1].as_slice()];
    let comparison = with_bar(Quiet(arguments.quiet), |progress| {
        diagnosis::compare(&loaded.robot, sets, &settings, progress)
    })?;
    let json = write(arguments, &loaded, &runs, &comparison)?;
    let json = arguments.json.then_some(json.as_str());
    print_answer(Quiet(arguments.quiet), json, || words(&comparison), &closing(out))?;
    let changes = &comparison.after.diagnosis.findings;
    Ok(if changes.is_empty() { ExitStatus::Good } else { ExitStatus::Gap })
}

/// Writes the diagnosis of each set of logs into a folder of its own, and what changed; returns its JSON.
///
/// The other logs are diagnosed about the robot that the first ones extend: `extended.toml` in the folder of the first
/// is the robot that their diagnosis names.
fn write(
    arguments: &Arguments,
    loaded: &Loaded,
    runs: &[Vec<Run>; 2],
    comparison: &Comparison,
) -> Result<String, CliError> {
    let out = &arguments.out;
    let [before, after] = SIDES.map(|side| out.join(side));
    let map = arguments.reading.map_file();
    let origin = |robot: &Path, loaded: &Loaded, runs: &[Run]| -> Result<Provenance, CliError> {
        let mut provenance = provenance(robot, loaded, map)?;
        provenance.files.extend(hashes_of(runs));
        Ok(provenance)
    };
    let given = origin(&arguments.robot.robot, loaded, &runs[0])?;
    write_side(arguments, &before, loaded, &comparison.before, &given)?;
    let extended = Loaded {
        robot: comparison.before.extended.clone(),
        urdf_path: before.join("robot.urdf"),
        ..loaded.clone()
    };
    let found = origin(&before.join("extended.toml"), &extended, &runs[1])?;
    write_side(arguments, &after, &extended, &comparison.after, &found)?;
    let named = [&given, &found].map(|provenance| provenance_in(out, provenance));
    let json = report::change_json(comparison, named.each_ref())?;
    let mut all = given;
    all.files.extend(hashes_of(&runs[1]));
    let report = Report::new(&comparison.after, &extended.robot, &all);
    let page = report::change_page(comparison, &report)?;
    report::write_folder(out, &[(PAGE, page.as_bytes()), (JSON, json.as_bytes())])?;
    Ok(json)
}

/// Writes the diagnosis of one set of logs, about the robot `loaded`, into a folder.
fn write_side(
    arguments: &Arguments,
    folder: &Path,
    loaded: &Loaded,
    outcome: &DiagnosisRun,
    provenance: &Provenance,
) -> Result<(), CliError> {
    let report = Report {
        descriptions: &diagnose::descriptions(loaded, outcome)?,
        input: Some(&options_of(&arguments.robot.part, &arguments.reading)),
        ..Report::new(outcome, &loaded.robot, provenance)
    };
    diagnose::write(folder, loaded, outcome, &report, None)?;
    Ok(())
}

/// What changed and what is wrong in both, a line or a few each.
pub fn words(comparison: &Comparison) -> String {
    let changes = &comparison.after.diagnosis.findings;
    let mut text = format!("{}.\n", report::change_sentence(comparison));
    for finding in changes {
        text.push_str(&lines(finding));
        text.push_str(&first(comparison, finding));
    }
    if !comparison.alike.is_empty() {
        text.push_str("\nOscillations of the same amplitude before, and so no change\n");
        comparison.alike.iter().for_each(|finding| text.push_str(&lines(finding)));
    }
    let held = &comparison.before.diagnosis.findings;
    if !held.is_empty() {
        text.push_str("\nFound before, and held where nothing above is said of it\n");
        held.iter().for_each(|finding| text.push_str(&lines(finding)));
    }
    for outcome in [&comparison.before, &comparison.after] {
        report::push_warnings(&mut text, &outcome.diagnosis.warnings);
    }
    text
}

/// A finding with its sizes and its rivals.
fn lines(finding: &Finding) -> String {
    let mut text = format!("  {}\n", finding.at.words());
    let sizes = report::sizes(finding);
    for line in report::pack(sizes.iter().map(String::as_str), "; ", WIDTH - 4) {
        text.push_str(&format!("    {line}\n"));
    }
    let (rivals, _) = finding.rivals();
    if !rivals.is_empty() {
        let words = format!("may as well be {}", rivals.join(" or "));
        for line in report::pack(words.split_whitespace(), " ", WIDTH - 4) {
            text.push_str(&format!("    {line}\n"));
        }
    }
    text
}

/// What the first logs by themselves say of the size of a change.
fn first(comparison: &Comparison, finding: &Finding) -> String {
    let Some(sizes) = report::sizes_before(comparison, finding) else { return String::new() };
    let words = format!("in the first logs {}", sizes.join("; "));
    let lines = report::pack(words.split_whitespace(), " ", WIDTH - 4);
    lines.iter().map(|line| format!("    {line}\n")).collect()
}

fn closing(out: &Path) -> String {
    let at = |name: &str| display_path(&out.join(name));
    format!(
        "report         {} (open it in a browser)\n\
         before         {} (what the first logs say of the robot)\n\
         after          {} (what the others say of the robot as the first found it)\n\
         extended model {} (for --robot)\n",
        at(PAGE),
        at("before/report.html"),
        at("after/report.html"),
        at("after/extended.toml")
    )
}
