use std::path::{Path, PathBuf};

use diagnosis::{Diagnosis, Progress, Settings, Silent, Verdict};
use logs::{ColumnMap, ReadOptions, Run};
use report::{FileHash, Provenance, Report, ReportError};
use robot::{Loaded, Robot};

use crate::Outcome;
use crate::error::CliError;
use crate::output::{print, shown};
use crate::progress::Bar;

/// Columns of a comment in `extended.toml`.
const COMMENT_WIDTH: usize = 95;

/// Arguments of `diagnose`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The robot: a robot.urdf, or a robot.toml that names one
    #[arg(long, value_name = "FILE")]
    robot: PathBuf,
    /// CSV or Parquet files, one run each, of the same robot
    #[arg(long = "log", value_name = "FILE", required = true, num_args = 1..)]
    logs: Vec<PathBuf>,
    /// Folder for report.html, figure.svg, diagnosis.json and extended.toml
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Names and units of columns that are called otherwise (TOML)
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,
    /// The effort is read from the columns `<joint>.COLUMN`
    #[arg(long, value_name = "COLUMN", default_value = "effort")]
    effort: String,
    /// Cut-off of the low-pass filter; chosen from the data when it is left out
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    cutoff_hz: Option<f64>,
    /// Share of false causes that is accepted among the findings
    #[arg(long, value_name = "SHARE", default_value_t = Settings::default().false_discovery_rate, value_parser = share, allow_negative_numbers = true)]
    fdr: f64,
    /// Seed of every random draw
    #[arg(long, default_value_t = Settings::default().seed)]
    seed: u64,
    /// Print diagnosis.json instead of the text
    #[arg(long)]
    json: bool,
    /// Print nothing but errors, and the JSON if it is asked for
    #[arg(long)]
    quiet: bool,
}

fn positive(text: &str) -> Result<f64, String> {
    number(text, |v| v > 0.0 && v.is_finite(), "a positive number was expected")
}

fn share(text: &str) -> Result<f64, String> {
    number(text, |v| v > 0.0 && v < 1.0, "a number between 0 and 1 was expected")
}

fn number(text: &str, fits: impl Fn(f64) -> bool, expected: &str) -> Result<f64, String> {
    text.parse().ok().filter(|&v| fits(v)).ok_or_else(|| expected.to_owned())
}

/// Diagnoses the logs, writes the output folder and prints the verdict.
pub fn run(arguments: &Arguments) -> Result<Outcome, CliError> {
    if arguments.out.exists() && !arguments.out.is_dir() {
        return Err(ReportError::NotAFolder { path: arguments.out.clone() }.into());
    }
    let loaded = Robot::load(&arguments.robot)?;
    let runs = read_runs(arguments, &loaded.robot)?;
    let settings = Settings {
        cutoff_hz: arguments.cutoff_hz,
        control_rate_hz: loaded.control.rate_hz,
        false_discovery_rate: arguments.fdr,
        seed: arguments.seed,
        ..Settings::default()
    };
    let bar = Bar::new();
    let progress: &dyn Progress = if arguments.quiet { &Silent } else { &bar };
    let outcome = diagnosis::diagnose(&loaded.robot, &runs, &settings, progress);
    bar.finish();
    let outcome = outcome?;

    let provenance = provenance(arguments, &loaded, &runs)?;
    let report = Report {
        diagnosis: &outcome.diagnosis,
        traces: &outcome.traces,
        robot: &loaded.robot,
        provenance: &provenance,
    };
    let json = report::json(&report)?;
    let extended = extended_toml(&loaded, &outcome.extended, &outcome.diagnosis)?;
    let urdf = read(&loaded.urdf_path)?;
    report::write_folder(
        &arguments.out,
        &[
            ("diagnosis.json", json.as_bytes()),
            ("report.html", report::html(&report)?.as_bytes()),
            ("figure.svg", report::figure(&report)?.as_bytes()),
            ("extended.toml", extended.as_bytes()),
            ("robot.urdf", &urdf),
        ],
    )?;
    say(arguments, &report, &json)?;
    Ok(match outcome.diagnosis.verdict {
        Verdict::Consistent | Verdict::Explained => Outcome::Good,
        Verdict::PartlyExplained | Verdict::Unexplained | Verdict::DataInadequate => Outcome::Gap,
    })
}

fn read_runs(arguments: &Arguments, robot: &Robot) -> Result<Vec<Run>, CliError> {
    let map = arguments.map.as_deref().map(ColumnMap::load).transpose()?;
    let options = ReadOptions { map: map.as_ref(), effort: &arguments.effort };
    let runs: Result<Vec<Run>, _> =
        arguments.logs.iter().map(|path| logs::read_run(path, robot, &options)).collect();
    Ok(runs?)
}

fn provenance(
    arguments: &Arguments,
    loaded: &Loaded,
    runs: &[Run],
) -> Result<Provenance, CliError> {
    let hash = |role, path: &Path| -> Result<FileHash, ReportError> {
        Ok(FileHash { role, path: shown(path), sha256: report::sha256_of(path)? })
    };
    let mut files = vec![hash("robot", &arguments.robot)?];
    if loaded.urdf_path != arguments.robot {
        files.push(hash("urdf", &loaded.urdf_path)?);
    }
    if let Some(map) = &arguments.map {
        files.push(hash("map", map)?);
    }
    files.extend(runs.iter().map(|run| FileHash {
        role: "log",
        path: shown(&run.source),
        sha256: run.sha256.clone(),
    }));
    let given = std::env::args_os().skip(1).map(|a| a.to_string_lossy().into_owned());
    Ok(Provenance {
        program: "plumbline",
        version: env!("CARGO_PKG_VERSION"),
        command: std::iter::once("plumbline".to_owned()).chain(given).collect(),
        files,
        seed: arguments.seed,
    })
}

/// The extended robot as a `robot.toml`, its findings as comments on top.
fn extended_toml(
    loaded: &Loaded,
    extended: &Robot,
    diagnosis: &Diagnosis,
) -> Result<String, CliError> {
    let mut text = format!("# {} with the findings of diagnosis.json\n", extended.name());
    for finding in &diagnosis.findings {
        let mut sizes = report::sizes(finding);
        if let Some(first) = sizes.first_mut() {
            *first = format!("{}: {first}", finding.at.words());
        }
        let lines = report::packed(sizes.iter().map(String::as_str), "; ", COMMENT_WIDTH);
        text.push_str(&format!("# {}\n", lines.join("\n#   ")));
    }
    let toml = loaded.to_toml(extended, "robot.urdf").map_err(CliError::Extended)?;
    Ok(format!("{text}\n{toml}"))
}

fn read(path: &Path) -> Result<Vec<u8>, ReportError> {
    std::fs::read(path)
        .map_err(|e| ReportError::Unreadable { path: path.to_owned(), reason: e.to_string() })
}

/// Text or JSON on the standard output; with JSON, where the files lie on the standard error.
fn say(arguments: &Arguments, report: &Report, json: &str) -> Result<(), CliError> {
    let out = &arguments.out;
    let closing = format!(
        "report         {} (open it in a browser)\nfigure         {}\nextended model {} (for --robot)\n",
        shown(&out.join("report.html")),
        shown(&out.join("figure.svg")),
        shown(&out.join("extended.toml"))
    );
    if arguments.json {
        print(json)?;
    }
    match (arguments.quiet, arguments.json) {
        (true, _) => {}
        (false, true) => anstream::eprint!("{closing}"),
        (false, false) => print(&format!("{}\n{closing}", report::text(report)))?,
    }
    Ok(())
}
