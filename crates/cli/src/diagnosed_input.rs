use std::path::{Path, PathBuf};

use catalogue::EffectKind;
use diagnosis::EffectAt;
use report::{InputOptions, Provenance, Report};
use serde::Deserialize;

use crate::columns::{ColumnArguments, ExcerptArguments, LengthArguments, LogArguments};
use crate::design_error::DesignError;
use crate::input::PartArguments;
use crate::messages::warn;
use crate::output::display_path;
use crate::path::{near, relative_to};

/// Name of the file in an output folder.
const FILE: &str = "diagnosis.json";

/// What a diagnosis was made from, as its `diagnosis.json` says: the files, named from its folder, and how they were
/// read.
pub struct DiagnosedInput {
    file: PathBuf,
    options: InputOptions,
    files: Vec<SourceFile>,
    fitted: Vec<EffectAt>,
    negligible: Vec<EffectAt>,
}

/// The part of a `diagnosis.json` that is read here.
#[derive(Deserialize)]
struct Document {
    #[serde(default)]
    input: InputOptions,
    provenance: Files,
    also_fitted: Option<AlsoFitted>,
    #[serde(default)]
    negligible: Vec<Place>,
}

/// What was fitted without a name.
#[derive(Deserialize)]
struct AlsoFitted {
    parameters: Vec<Place>,
}

/// An effect and its place.
#[derive(Deserialize)]
struct Place {
    effect: EffectKind,
    joint: Option<String>,
    link: Option<String>,
}

#[derive(Deserialize)]
struct Files {
    files: Vec<SourceFile>,
}

#[derive(Deserialize)]
struct SourceFile {
    role: String,
    path: PathBuf,
    sha256: String,
}

impl DiagnosedInput {
    /// The input of the diagnosis in a folder, or in a `diagnosis.json`.
    ///
    /// # Errors
    ///
    /// [`DesignError::Diagnosis`] for a file that is none.
    pub fn read(path: &Path) -> Result<Self, DesignError> {
        let file = file_of(path);
        let wrong = |reason: String| DesignError::Diagnosis { path: file.clone(), reason };
        let text =
            files::text(&file, files::KEPT_BYTES).map_err(|error| wrong(error.to_string()))?;
        let Document { input, provenance, also_fitted, negligible } =
            serde_json::from_str(&text).map_err(|error| wrong(error.to_string()))?;
        let fitted = also_fitted.into_iter().flat_map(|also| also.parameters);
        let place = |Place { effect, joint, link }| EffectAt { effect, joint, link };
        Ok(Self {
            file,
            options: input,
            files: provenance.files,
            fitted: fitted.map(place).collect(),
            negligible: negligible.into_iter().map(place).collect(),
        })
    }

    /// What the extended robot has that no finding names, in words, each once.
    pub fn fitted_without_a_name(&self) -> Vec<String> {
        let mut places: Vec<String> = self.fitted.iter().map(EffectAt::words).collect();
        places.dedup();
        places
    }

    /// Causes that the extended robot has and that are too small to be findings, in words.
    pub fn negligible(&self) -> Vec<String> {
        self.negligible.iter().map(EffectAt::words).collect()
    }

    /// The folder of the diagnosis.
    pub fn folder(&self) -> &Path {
        self.file.parent().unwrap_or_else(|| Path::new(""))
    }

    /// The robot that was diagnosed. One that has changed since gives a warning.
    ///
    /// # Errors
    ///
    /// [`DesignError::Gone`].
    pub fn robot(&self) -> Result<PathBuf, DesignError> {
        let robot = self.of_one_role("robot")?;
        let path = self.present(robot, "--robot")?;
        if !robot.is_at(&path) {
            warn(&format!("{}: it has changed since the diagnosis", display_path(&path)));
        }
        Ok(path)
    }

    /// The robot that was diagnosed, if it is there and unchanged.
    pub fn unchanged_robot(&self) -> Option<PathBuf> {
        let robot = self.of_role("robot").next()?;
        self.present(robot, "--nominal").ok().filter(|path| robot.is_at(path))
    }

    /// The logs that were diagnosed, each once.
    ///
    /// # Errors
    ///
    /// [`DesignError::Gone`] for the first that is no longer there.
    pub fn logs(&self) -> Result<Vec<PathBuf>, DesignError> {
        let mut logs: Vec<PathBuf> = Vec::new();
        for log in self.of_role("log") {
            let log = self.present(log, "--log")?;
            if !logs.contains(&log) {
                logs.push(log);
            }
        }
        Ok(logs)
    }

    /// The part of the robot that was meant, where `given` says nothing else.
    pub fn part(&self, given: &PartArguments) -> PartArguments {
        let InputOptions { joints, locked, packages, allow_outside, .. } = &self.options;
        let packages =
            packages.iter().map(|(name, at)| (name.clone(), near(&self.folder().join(at))));
        PartArguments {
            joints: if given.joints.is_empty() { joints.clone() } else { given.joints.clone() },
            locked: locked.iter().chain(&given.locked).cloned().collect(),
            package: packages.chain(given.package.iter().cloned()).collect(),
            allow_outside: given.allow_outside || *allow_outside,
        }
    }

    /// How the columns of logs of the same kind are called, where `given` says nothing else.
    ///
    /// # Errors
    ///
    /// [`DesignError::Gone`] for a map that is no longer there.
    pub fn columns(&self, given: &LogArguments) -> Result<LogArguments, DesignError> {
        let own = &given.columns;
        let options = &self.options;
        let map = match (&own.map, &options.map, self.of_role("map").next()) {
            (Some(given), ..) => Some(given.clone()),
            (None, Some(name), _) => Some(name.into()),
            (None, None, Some(file)) => Some(self.present(file, "--map")?),
            (None, None, None) => None,
        };
        let columns = ColumnArguments {
            map,
            effort: own.effort.clone().or_else(|| options.effort.clone()),
            topic: own.topic.clone().or_else(|| options.topic.clone()),
            ..own.clone()
        };
        Ok(LogArguments { columns, length: given.length })
    }

    /// How the logs that were diagnosed are read again, where `given` says nothing else.
    ///
    /// # Errors
    ///
    /// As [`columns`](Self::columns).
    pub fn reading(&self, given: &LogArguments) -> Result<LogArguments, DesignError> {
        let LogArguments { columns: named, length } = self.columns(given)?;
        let options = &self.options;
        let episodes = || options.episodes.iter().map(|&(first, last)| first..=last).collect();
        let columns = ColumnArguments {
            episodes: if named.episodes.is_empty() { episodes() } else { named.episodes },
            until_damage: named.until_damage || options.until_damage,
            excerpt: ExcerptArguments {
                from_s: named.excerpt.from_s.or(options.from_s),
                to_s: named.excerpt.to_s.or(options.to_s),
            },
            ..named
        };
        let all_samples = length.all_samples || options.all_samples;
        Ok(LogArguments { columns, length: LengthArguments { all_samples } })
    }

    fn of_role(&self, role: &'static str) -> impl Iterator<Item = &SourceFile> {
        self.files.iter().filter(move |file| file.role == role)
    }

    fn of_one_role(&self, role: &'static str) -> Result<&SourceFile, DesignError> {
        self.of_role(role).next().ok_or_else(|| DesignError::Diagnosis {
            path: self.file.clone(),
            reason: format!("its provenance names no file with the role {role}"),
        })
    }

    /// Where a file lies, seen from the working folder.
    fn present(&self, file: &SourceFile, option: &'static str) -> Result<PathBuf, DesignError> {
        let path = self.folder().join(&file.path);
        if !logs::is_there(&path) {
            return Err(DesignError::Gone { path, diagnosis: self.file.clone(), option });
        }
        Ok(near(&path))
    }
}

impl SourceFile {
    /// Whether a file has the bytes that were read then.
    fn is_at(&self, path: &Path) -> bool {
        report::sha256_of(path).is_ok_and(|hash| hash == self.sha256)
    }
}

/// The `diagnosis.json` of a folder, or the file itself.
pub fn file_of(path: &Path) -> PathBuf {
    if path.is_dir() { path.join(FILE) } else { path.to_owned() }
}

/// How a command reads its robot and its logs, for [`Report::input`].
pub fn options_of(part: &PartArguments, reading: &LogArguments) -> InputOptions {
    InputOptions {
        joints: part.joints.clone(),
        locked: part.locked.clone(),
        packages: part.package.clone(),
        allow_outside: part.allow_outside,
        all_samples: reading.length.all_samples,
        ..options_of_columns(&reading.columns)
    }
}

/// How logs are read, of any robot.
pub fn options_of_columns(columns: &ColumnArguments) -> InputOptions {
    let ColumnArguments { effort, topic, episodes, until_damage, excerpt, .. } = columns;
    InputOptions {
        map: columns.preset().map(str::to_owned),
        effort: effort.clone(),
        topic: topic.clone(),
        episodes: episodes.iter().map(|range| (*range.start(), *range.end())).collect(),
        until_damage: *until_damage,
        from_s: excerpt.from_s,
        to_s: excerpt.to_s,
        ..InputOptions::default()
    }
}

/// The same with files that are named from a folder.
pub fn provenance_in(folder: &Path, provenance: &Provenance) -> Provenance {
    let mut provenance = provenance.clone();
    for file in &mut provenance.files {
        file.path = display_path(&relative_to(folder, Path::new(&file.path)));
    }
    provenance
}

/// `diagnosis.json` for an output folder: it names files from there, so that it is read wherever one stands.
///
/// # Errors
///
/// [`report::ReportError::Format`].
pub fn json_in(folder: &Path, report: &Report) -> Result<String, report::ReportError> {
    let provenance = provenance_in(folder, report.provenance);
    let input = report.input.map(|input| {
        let mut input = input.clone();
        input.packages.iter_mut().for_each(|(_, at)| *at = relative_to(folder, at));
        input
    });
    report::json(&Report { provenance: &provenance, input: input.as_ref(), ..*report })
}
