use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::error::{CliError, VIEWER_INSTALLATION};
use crate::exit_status::ExitStatus;
use crate::messages::warn;
use crate::output::{display_path, print};

/// The viewer of recordings, and the version that they are written for.
const VIEWER: &str = "rerun";
const VERSION: &str = "0.36";

/// Names of a folder that a message lists.
const MOST_NAMES: usize = 8;

/// Arguments of `view`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The output folder of a command
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Name what would be opened and open nothing
    #[arg(long)]
    print: bool,
}

/// Opens the report of a folder in the browser and its recordings in the viewer.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let found = Found::in_folder(&arguments.folder)?;
    if arguments.print {
        print(&found.text())?;
        return Ok(ExitStatus::Good);
    }
    if !found.recordings.is_empty() {
        match view(&found.recordings) {
            Err(missing @ CliError::NoViewer { .. }) if found.report.is_some() => missing.print(),
            result => result?,
        }
    }
    if let Some(report) = &found.report {
        open::that_detached(report).map_err(|error| CliError::NotOpened {
            path: report.clone(),
            reason: error.to_string(),
        })?;
    }
    print(&found.text())?;
    Ok(ExitStatus::Good)
}

/// What there is to look at.
struct Found {
    report: Option<PathBuf>,
    recordings: Vec<PathBuf>,
}

impl Found {
    fn in_folder(folder: &Path) -> Result<Self, CliError> {
        let to_unlisted = |error: std::io::Error| CliError::Unlisted {
            path: folder.to_owned(),
            reason: error.to_string(),
        };
        let entries: Result<Vec<_>, _> = fs::read_dir(folder).map_err(to_unlisted)?.collect();
        let entries = entries.map_err(to_unlisted)?;
        let mut files: Vec<PathBuf> = entries.iter().map(fs::DirEntry::path).collect();
        files.sort();
        let is_recording = |path: &PathBuf| {
            path.extension().is_some_and(|own| own.eq_ignore_ascii_case("rrd")) && path.is_file()
        };
        let report = folder.join("report.html");
        let found = Self {
            report: report.is_file().then_some(report),
            recordings: files.iter().filter(|path| is_recording(path)).cloned().collect(),
        };
        if found.report.is_none() && found.recordings.is_empty() {
            return Err(CliError::NothingToView { path: folder.to_owned(), found: names(&files) });
        }
        Ok(found)
    }

    /// One line a file.
    fn text(&self) -> String {
        let report = self.report.iter().map(|path| format!("report     {}\n", display_path(path)));
        let recordings =
            self.recordings.iter().map(|path| format!("recording  {}\n", display_path(path)));
        report.chain(recordings).collect()
    }
}

/// The names of files for a message.
fn names(files: &[PathBuf]) -> String {
    let name = |path: &PathBuf| path.file_name().unwrap_or_default().display().to_string();
    let first: Vec<String> = files.iter().take(MOST_NAMES).map(name).collect();
    match files.len().saturating_sub(MOST_NAMES) {
        _ if files.is_empty() => "nothing".to_owned(),
        0 => first.join(", "),
        more => format!("{} and {more} more", first.join(", ")),
    }
}

/// Starts the viewer with all recordings and leaves it running.
fn view(recordings: &[PathBuf]) -> Result<(), CliError> {
    let to_error = |error: std::io::Error| match error.kind() {
        ErrorKind::NotFound => CliError::NoViewer { recordings: names(recordings) },
        _ => CliError::NotOpened { path: VIEWER.into(), reason: error.to_string() },
    };
    let answer = Command::new(VIEWER).arg("--version").output().map_err(to_error)?;
    let answer = String::from_utf8_lossy(&answer.stdout).into_owned();
    if let Some(doubt) = doubt(&answer) {
        warn(&doubt);
    }
    let mut viewer = Command::new(VIEWER);
    viewer.args(recordings).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    // Ctrl-C at the terminal is not for the viewer.
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut viewer, 0);
    viewer.spawn().map_err(to_error)?;
    Ok(())
}

/// What to know of a viewer that calls itself so; nothing where it is the right one.
fn doubt(answer: &str) -> Option<String> {
    let is_version =
        |word: &&str| word.starts_with(|c: char| c.is_ascii_digit()) && word.contains('.');
    let version = answer.split_whitespace().find(is_version);
    let is_right = |version: &str| {
        version.strip_prefix(VERSION).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    };
    match version {
        Some(version) if is_right(version) => None,
        Some(version) => Some(format!(
            "{VIEWER} {version} was found, the recordings are written for {VERSION}: {VIEWER_INSTALLATION}"
        )),
        None => Some(format!(
            "{VIEWER} does not tell its version, the recordings are written for {VERSION}"
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_viewer_of_another_version_is_told() {
        assert_eq!(doubt("rerun_py 0.36.3 [rustc 1.92.0, LLVM 20.1.8] x86_64 main\n"), None);
        assert_eq!(doubt("rerun-cli 0.36.0"), None);
        let told = doubt("rerun_py 0.361.0 [rustc 1.92.0]").unwrap();
        assert!(
            told.starts_with("rerun 0.361.0 was found, the recordings are written for 0.36: pip")
        );
        assert!(doubt("rerun").is_some_and(|told| told.contains("does not tell its version")));
    }

    #[test]
    fn many_names_are_cut_short() {
        let files: Vec<PathBuf> = (0..10).map(|i| format!("out/{i}.txt").into()).collect();
        assert_eq!(names(&files[..2]), "0.txt, 1.txt");
        assert!(names(&files).ends_with("7.txt and 2 more"));
        assert_eq!(names(&[]), "nothing");
    }
}
