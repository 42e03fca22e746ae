mod residual;

use std::path::{Path, PathBuf};

use catalogue::EffectKind;
use diagnosis::{Diagnosis, DiagnosisProgress, Verdict};
use exchange::{Export, Format};
use experiment::{DiagnosedLogs, ExperimentError, ForwardGap};
use logs::Run;
use recording::RecordingError;
use report::{Report, ReportError};
use robot::{Loaded, Robot};

use residual::ResidualFile;

use crate::columns::LogArguments;
use crate::diagnosed_input::{json_in, options_of};
use crate::error::CliError;
use crate::escape::escape_line;
use crate::exit_status::ExitStatus;
use crate::input::{RobotArguments, SearchArguments, hashes_of};
use crate::input_warnings::input_warnings;
use crate::messages::warn;
use crate::output::{display_path, keep_inputs, print_answer, refuse_file};
use crate::progress::{Line, with_bar};
use crate::quiet::Quiet;

/// Columns of a comment in `extended.toml`.
const COMMENT_WIDTH: usize = 95;

/// Name of the recording in the output folder.
const RECORDING: &str = "recording.rrd";

/// The recording until it is whole.
const BEGUN: &str = ".plumbline-recording.rrd";

/// Arguments of `diagnose`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    robot: RobotArguments,
    /// Logs (CSV, Parquet, NumPy, MATLAB, HDF5, bags of ROS 2, datasets of LeRobot), one run each, of the same robot; a run in
    /// several files has a + between them, q.mat+tau.mat+t.mat
    #[arg(long = "log", value_name = "FILE", required = true, num_args = 1..)]
    logs: Vec<PathBuf>,
    /// Folder for report.html, recording.rrd, figure.svg, diagnosis.json and extended.toml
    #[arg(long, value_name = "DIR", default_value = "out/diagnose")]
    out: PathBuf,
    #[command(flatten)]
    reading: LogArguments,
    #[command(flatten)]
    search: SearchArguments,
    /// Learn a model of what the findings leave as well, and keep it where it predicts data that
    /// it has not seen
    #[arg(long, value_enum, value_name = "MODEL")]
    residual: Option<ResidualKind>,
    /// Leave recording.rrd out
    #[arg(long)]
    no_recording: bool,
    /// Print diagnosis.json instead of the text
    #[arg(long)]
    json: bool,
    /// Print nothing but errors, and the JSON if it is asked for
    #[arg(long)]
    quiet: bool,
}

/// Files of an output folder.
pub(super) const FILES: [&str; 8] = [
    "diagnosis.json",
    "report.html",
    "figure.svg",
    "extended.toml",
    "extended.urdf",
    "robot.urdf",
    RECORDING,
    residual::FILE,
];

/// A model of what the findings leave.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum ResidualKind {
    /// A Gaussian process about the extended robot
    Gp,
}

/// Diagnoses the logs, writes the output folder and prints the verdict.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    refuse_file(&arguments.out)?;
    let loaded = arguments.robot.load()?;
    let runs = arguments.reading.read_runs(&arguments.logs, &loaded.robot)?;
    if !arguments.quiet {
        input_warnings(&loaded, &runs).iter().for_each(|warning| warn(warning));
    }
    let given = [&arguments.robot.robot, &loaded.urdf_path];
    let given = given.into_iter().chain(&arguments.reading.columns.map);
    let inputs = given.chain(&arguments.logs).map(PathBuf::as_path);
    keep_inputs(&arguments.out, &FILES, inputs)?;
    let settings = arguments.search.settings(&loaded);
    let outcome = with_bar(Quiet(arguments.quiet), |progress| {
        diagnosis::diagnose(&loaded.robot, &runs, &settings, progress)
    })?;
    let read = outcome.read.as_deref().unwrap_or(&runs);

    let forward = forward(arguments, &loaded, read, &outcome);

    let learn = |ResidualKind::Gp| {
        residual::learn(&loaded.robot, &outcome, (!arguments.quiet).then(Line::new))
    };
    let residual = arguments.residual.map(learn).transpose()?;

    let mut provenance = arguments.robot.provenance(&loaded, arguments.reading.map_file())?;
    provenance.files.extend(hashes_of(&runs));
    let report = Report {
        residual: residual.as_ref().map(|learned| &learned.model),
        forward: forward.as_ref(),
        descriptions: &descriptions(&loaded, &outcome)?,
        input: Some(&options_of(&arguments.robot.part, &arguments.reading)),
        ..Report::new(&outcome, &loaded.robot, &provenance)
    };
    let json = write(&arguments.out, &loaded, &outcome, &report, residual.as_ref())?;
    let diagnosed = DiagnosedLogs {
        loaded: &loaded,
        runs: read,
        outcome: &outcome,
        verdict: &report::markdown(&report),
    };
    let recording = record(arguments, &diagnosed);
    let written = recording.as_ref().ok().and_then(Option::as_deref);
    say(arguments, &report, &json, written)?;
    recording?;
    Ok(match outcome.diagnosis.verdict {
        Verdict::Consistent | Verdict::Explained => ExitStatus::Good,
        Verdict::PartlyExplained | Verdict::Unexplained | Verdict::DataInadequate => {
            ExitStatus::Gap
        }
    })
}

/// How far simulations drift from the logs. A robot that cannot be simulated gives a warning, as
/// the rest of the report does not need it.
fn forward(
    arguments: &Arguments,
    loaded: &Loaded,
    runs: &[Run],
    outcome: &diagnosis::DiagnosisRun,
) -> Option<ForwardGap> {
    let (robots, data) = ([&loaded.robot, &outcome.extended], &outcome.diagnosis.data);
    let gap = with_bar(Quiet(arguments.quiet), |progress| {
        experiment::forward_gap_of_logs(robots, runs, data.cutoff_hz, progress)
    });
    gap.inspect_err(|error| warn(error)).ok()
}

/// The text of the URDF. A description that includes others is whole: they do not lie beside it.
fn source(loaded: &Loaded) -> Result<Vec<u8>, ReportError> {
    match &loaded.expanded {
        Some(text) => Ok(text.clone().into_bytes()),
        None => read(&loaded.urdf_path),
    }
}

/// The extended robot in the file of another program.
fn export_extended(
    loaded: &Loaded,
    outcome: &diagnosis::DiagnosisRun,
    format: Format,
) -> Result<Export, CliError> {
    let robot = Loaded { robot: outcome.extended.clone(), ..loaded.clone() };
    Ok(exchange::export(&robot, &String::from_utf8_lossy(&source(loaded)?), format)?)
}

/// The extended robot as a report shows it.
///
/// # Errors
///
/// [`CliError::Report`] and [`CliError::Exchange`].
pub fn descriptions(
    loaded: &Loaded,
    outcome: &diagnosis::DiagnosisRun,
) -> Result<Vec<(Format, Export)>, CliError> {
    let all = [Format::Urdf, Format::Mjcf].into_iter();
    all.map(|format| Ok((format, export_extended(loaded, outcome, format)?))).collect()
}

/// Writes an output folder, all but the recording, and returns its `diagnosis.json`.
///
/// # Errors
///
/// [`CliError::Report`], [`CliError::Extended`] and [`CliError::Exchange`].
pub fn write(
    out: &Path,
    loaded: &Loaded,
    outcome: &diagnosis::DiagnosisRun,
    report: &Report,
    residual: Option<&ResidualFile>,
) -> Result<String, CliError> {
    let json = json_in(out, report)?;
    let extended = extended_toml(loaded, &outcome.extended, &outcome.diagnosis)?;
    let (html, figure) = (report::html(report)?, report::figure(report)?);
    let urdf = source(loaded)?;
    let extended_urdf = match report.descriptions.iter().find(|(format, _)| *format == Format::Urdf)
    {
        Some((_, export)) => export.text.clone(),
        None => export_extended(loaded, outcome, Format::Urdf)?.text,
    };
    let mut files = vec![
        ("diagnosis.json", json.as_bytes()),
        ("report.html", html.as_bytes()),
        ("figure.svg", figure.as_bytes()),
        ("extended.toml", extended.as_bytes()),
        ("extended.urdf", extended_urdf.as_bytes()),
        ("robot.urdf", &urdf),
    ];
    files.extend(residual.map(|learned| (residual::FILE, learned.bytes.as_slice())));
    report::write_folder(out, &files)?;
    if residual.is_none() {
        // One of an earlier diagnosis would be about another extended robot.
        let _ = std::fs::remove_file(out.join(residual::FILE));
    }
    Ok(json)
}

/// Writes the recording and returns its path. A recording that cannot be made gives a warning, as
/// all other files are written.
///
/// # Errors
///
/// [`ExperimentError::Recording`] where the disk refuses it.
fn record(
    arguments: &Arguments,
    diagnosed: &DiagnosedLogs<'_>,
) -> Result<Option<PathBuf>, CliError> {
    if arguments.no_recording || !recording::IS_BUILT {
        remove_recordings(&arguments.out);
        return Ok(None);
    }
    let recorded = with_bar(Quiet(arguments.quiet), |progress| {
        write_recording(&arguments.out, diagnosed, progress)
    });
    match recorded {
        Ok(path) => Ok(Some(path)),
        Err(error) => match *error {
            ExperimentError::Recording(RecordingError::Unwritable { .. }) => Err((*error).into()),
            other => {
                warn(&other);
                Ok(None)
            }
        },
    }
}

/// Writes the recording of a diagnosis into an output folder, under its name when it is whole.
///
/// # Errors
///
/// Those of [`experiment::record_diagnosis`]; no recording is then there.
pub fn write_recording(
    out: &Path,
    diagnosed: &DiagnosedLogs<'_>,
    progress: &dyn DiagnosisProgress,
) -> Result<PathBuf, Box<ExperimentError>> {
    let (path, begun) = (out.join(RECORDING), out.join(BEGUN));
    remove_recordings(out);
    let to_error = |error: ExperimentError| {
        let _ = std::fs::remove_file(&begun);
        Box::new(match error {
            ExperimentError::Recording(RecordingError::Unwritable { reason, .. }) => {
                RecordingError::Unwritable { path: path.clone(), reason }.into()
            }
            ExperimentError::Recording(RecordingError::LeftOut { .. }) => {
                RecordingError::LeftOut { path: path.clone() }.into()
            }
            ExperimentError::Recording(RecordingError::TurnedOff { value, .. }) => {
                RecordingError::TurnedOff { path: path.clone(), value }.into()
            }
            other => other,
        })
    };
    experiment::record_diagnosis(&begun, diagnosed, progress).map_err(to_error)?;
    let renamed = std::fs::rename(&begun, &path).and_then(|()| logs::sync_folder(out));
    renamed.map_err(|error| {
        let reason = error.to_string();
        to_error(RecordingError::Unwritable { path: path.clone(), reason }.into())
    })?;
    Ok(path)
}

/// Removes the recording of an earlier diagnosis, which would show something else than the report beside it, and one
/// that a killed process has begun.
fn remove_recordings(out: &Path) {
    for name in [RECORDING, BEGUN] {
        let _ = std::fs::remove_file(out.join(name));
    }
}

/// A comment of TOML, on one line whatever names stand in it.
fn comment(words: &str) -> String {
    format!("# {}\n", escape_line(words))
}

/// The extended robot as a `robot.toml`, its findings as comments on top.
fn extended_toml(
    loaded: &Loaded,
    extended: &Robot,
    diagnosis: &Diagnosis,
) -> Result<String, CliError> {
    let mut text = comment(&format!("{} with the findings of diagnosis.json", extended.name()));
    if !loaded.part.is_whole() {
        text.push_str("# robot.urdf has more joints: those that are not named here are locked\n");
    }
    for finding in &diagnosis.findings {
        let mut sizes = report::sizes(finding);
        match sizes.first_mut() {
            Some(first) => *first = format!("{}: {first}", finding.at.words()),
            None => sizes.push(format!("{}: of unknown size", finding.at.words())),
        }
        let lines = report::pack(sizes.iter().map(String::as_str), "; ", COMMENT_WIDTH);
        for (i, line) in lines.iter().enumerate() {
            text.push_str(&comment(&format!("{}{line}", if i == 0 { "" } else { "  " })));
        }
    }
    let fitted = diagnosis.also_fitted.iter().flat_map(|also| &also.parameters);
    let mut fitted: Vec<String> = fitted.map(|p| p.at.words()).collect();
    fitted.dedup();
    let negligible: Vec<String> = diagnosis.negligible.iter().map(|n| n.at.words()).collect();
    let headings = [
        ("Fitted without a name (--only-findings leaves these out):", fitted),
        ("Seen and negligible:", negligible),
    ];
    for (heading, places) in headings.iter().filter(|(_, places)| !places.is_empty()) {
        text.push_str(&format!("#\n# {heading}\n"));
        let lines = report::pack(places.iter().map(String::as_str), "; ", COMMENT_WIDTH);
        lines.iter().for_each(|line| text.push_str(&comment(line)));
    }
    let is_named = diagnosis.findings.iter().any(|f| f.at.effect == EffectKind::TimeSkew);
    if let Some(skew_ms) = skew_of(&loaded.robot, extended).filter(|_| !is_named) {
        text.push_str(&format!(
            "#\n# Also set: effort_skew_ms. The efforts of these logs are {skew_ms} ms late; this is of the logs, and no \
             other program's\n# file has it.\n"
        ));
    }
    let toml = loaded.to_toml(extended, "robot.urdf").map_err(CliError::Extended)?;
    Ok(format!("{text}\n{toml}"))
}

/// How much later the efforts of the extended robot are at the first joint where they are (ms), in words.
fn skew_of(described: &Robot, extended: &Robot) -> Option<String> {
    let pairs = described.links().iter().zip(extended.links());
    let skews = pairs.map(|(own, new)| new.actuator.effort_skew_s - own.actuator.effort_skew_s);
    let first_s = skews.into_iter().find(|skew| skew.abs() > 0.0)?;
    Some(report::significant(1e3 * first_s, 3))
}

fn read(path: &Path) -> Result<Vec<u8>, ReportError> {
    files::bytes(path, files::KEPT_BYTES)
        .map_err(|e| ReportError::Unreadable { path: path.to_owned(), reason: e.to_string() })
}

/// Text or JSON on the standard output; with JSON, where the files lie on the standard error.
fn say(
    arguments: &Arguments,
    report: &Report,
    json: &str,
    recording: Option<&Path>,
) -> Result<(), CliError> {
    let out = &arguments.out;
    let recording = recording.map_or_else(String::new, |path| {
        format!("recording      {} (plumbline view {})\n", display_path(path), display_path(out))
    });
    let residual = report.residual.map_or_else(String::new, |model| {
        format!("residual model {} (for track --learned)\n", display_path(&out.join(&model.file)))
    });
    let closing = format!(
        "report         {} (open it in a browser)\n{recording}figure         {}\nextended model {} (for --robot)\n{residual}",
        display_path(&out.join("report.html")),
        display_path(&out.join("figure.svg")),
        display_path(&out.join("extended.toml"))
    );
    let json = arguments.json.then_some(json);
    print_answer(Quiet(arguments.quiet), json, || report::text(report), &closing)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_skew_that_the_description_has_not_is_told() {
        let urdf = "<robot name=\"r\"><link name=\"base\"/><joint name=\"j\" type=\"continuous\">\
                    <parent link=\"base\"/><child link=\"a\"/><axis xyz=\"0 1 0\"/></joint><link name=\"a\"><inertial>\
                    <mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/>\
                    </inertial></link></robot>";
        let described = Robot::from_urdf(urdf).unwrap();
        let mut extended = described.clone();
        assert_eq!(skew_of(&described, &extended), None);
        extended.link_mut(0).unwrap().actuator.effort_skew_s = -0.0009;
        assert_eq!(skew_of(&described, &extended).as_deref(), Some("-0.900"));
        assert_eq!(skew_of(&extended, &extended), None);
    }
}
