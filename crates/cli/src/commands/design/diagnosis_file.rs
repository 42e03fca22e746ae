use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use catalogue::EffectKind;
use diagnosis::SCHEMA;
use effects::Hypothesis;
use next_motion::Goal;
use robot::Robot;
use serde::Deserialize;

use super::cause;
use crate::design_error::DesignError;
use crate::diagnosed_input::file_of;

/// Half-width of an interval, as a share of the change that it is of, from which on a size is
/// to be determined.
const WIDE: f64 = 0.5;

/// What a design reads of a `diagnosis.json`.
#[derive(Debug, Deserialize)]
pub struct DiagnosisFile {
    /// Where it was read, or its name in messages.
    #[serde(skip)]
    path: PathBuf,
    schema: String,
    joints: Vec<Joint>,
    findings: Vec<Finding>,
    data: Data,
    provenance: Provenance,
}

#[derive(Debug, Deserialize)]
struct Joint {
    name: String,
    remaining_rms_nm: Option<f64>,
    autocorrelation_time_s: Option<f64>,
}

#[derive(Debug, Deserialize)]
struct Finding {
    #[serde(flatten)]
    at: At,
    parameters: BTreeMap<String, Size>,
    not_separable_from: Vec<At>,
    undetermined: Vec<String>,
}

#[derive(Debug, Deserialize)]
struct At {
    effect: EffectKind,
    joint: Option<String>,
    link: Option<String>,
}

#[derive(Debug, Deserialize)]
struct Size {
    value: Option<f64>,
    ci95: [Option<f64>; 2],
    nominal: Option<f64>,
    determined: bool,
}

#[derive(Debug, Deserialize)]
struct Data {
    cutoff_hz: f64,
}

#[derive(Debug, Deserialize)]
struct Provenance {
    files: Vec<File>,
}

#[derive(Debug, Deserialize)]
struct File {
    role: String,
    sha256: String,
}

impl DiagnosisFile {
    /// A `diagnosis.json`, or the one in a folder.
    ///
    /// # Errors
    ///
    /// A file that is none, or one of another robot.
    pub fn read(path: &Path, robot: &Robot) -> Result<Self, DesignError> {
        let file = file_of(path);
        let text = files::text(&file, files::KEPT_BYTES)
            .map_err(|e| DesignError::Diagnosis { path: file.clone(), reason: e.to_string() })?;
        Self::parse(&text, &file, robot).map(|read| Self { path: path.to_owned(), ..read })
    }

    /// The text of a `diagnosis.json`, of this name in messages.
    ///
    /// # Errors
    ///
    /// As [`read`](Self::read).
    pub fn parse(text: &str, name: &Path, robot: &Robot) -> Result<Self, DesignError> {
        let wrong = |reason: String| DesignError::Diagnosis { path: name.to_owned(), reason };
        let read: Self = serde_json::from_str(text).map_err(|e| wrong(e.to_string()))?;
        if read.schema != SCHEMA {
            return Err(wrong(format!("its schema is {}, not {SCHEMA}", read.schema)));
        }
        if !read.joints.iter().map(|j| j.name.as_str()).eq(robot.joint_names()) {
            return Err(wrong(format!("its joints are not those of {}", robot.name())));
        }
        Ok(Self { path: name.to_owned(), ..read })
    }

    /// Where it was read.
    pub fn path(&self) -> PathBuf {
        self.path.clone()
    }

    /// Whether a log with this checksum was diagnosed.
    pub fn knows(&self, sha256: &str) -> bool {
        self.provenance.files.iter().any(|f| f.role == "log" && f.sha256 == sha256)
    }

    /// Cut-off of the low-pass (Hz).
    pub fn cutoff_hz(&self) -> f64 {
        self.data.cutoff_hz
    }

    /// Variance of what is left of the effort of each joint times its autocorrelation time.
    pub fn noise(&self) -> Vec<f64> {
        let noise = |j: &Joint| {
            let product = j.remaining_rms_nm.zip(j.autocorrelation_time_s);
            product.map_or(0.0, |(rms, time_s)| rms * rms * time_s)
        };
        self.joints.iter().map(noise).collect()
    }

    /// The causes that were named.
    pub fn findings(&self, robot: &Robot) -> Result<Vec<Hypothesis>, DesignError> {
        self.findings.iter().map(|f| f.at.hypothesis(robot)).collect()
    }

    /// The pairs that could not be told apart; where there are none, the causes that were not
    /// determined.
    pub fn goals(&self, robot: &Robot) -> Result<Vec<Goal>, DesignError> {
        let mut goals = Vec::new();
        for finding in &self.findings {
            let own = finding.at.hypothesis(robot)?;
            for rival in &finding.not_separable_from {
                goals.push(Goal::Separate { finding: own, rival: rival.hypothesis(robot)? });
            }
        }
        if goals.is_empty() {
            let open = self.findings.iter().filter(|f| f.is_open());
            for finding in open {
                goals.push(Goal::Determine { finding: finding.at.hypothesis(robot)? });
            }
        }
        Ok(goals)
    }
}

impl At {
    fn hypothesis(&self, robot: &Robot) -> Result<Hypothesis, DesignError> {
        cause::at(self.effect, self.joint.as_deref().or(self.link.as_deref()), robot)
    }
}

impl Finding {
    fn is_open(&self) -> bool {
        !self.undetermined.is_empty() || self.parameters.values().any(Size::is_open)
    }
}

impl Size {
    /// Whether the size is not determined, or known to no better than half of it.
    fn is_open(&self) -> bool {
        let [Some(low), Some(high)] = self.ci95 else { return true };
        let change = self.value.zip(self.nominal).map(|(value, nominal)| (value - nominal).abs());
        !self.determined || change.is_none_or(|change| 0.5 * (high - low) > WIDE * change)
    }
}

#[cfg(test)]
mod tests {
    use checks::{mutated, round};

    use super::*;

    /// A diagnosis with every field that a design reads.
    fn good(robot: &Robot) -> String {
        let joint = |name: &str| {
            format!(
                "{{\"name\": {name:?}, \"remaining_rms_nm\": 0.05, \"autocorrelation_time_s\": null}}"
            )
        };
        let joints: Vec<String> = robot.joint_names().map(joint).collect();
        let at = |effect: &str| {
            format!("\"effect\": {effect:?}, \"joint\": \"j4_elbow_pitch\", \"link\": null")
        };
        format!(
            r#"{{"schema": {SCHEMA:?}, "data": {{"cutoff_hz": 12.5}}, "joints": [{}],
"findings": [{{{}, "not_separable_from": [{{{}}}], "undetermined": ["level"], "parameters": {{"level":
{{"value": 1.5, "ci95": [1.4, 1.6], "nominal": 0.0, "determined": true}}}}}}],
"provenance": {{"files": [{{"role": "log", "path": "run.csv", "sha256": "00"}}]}}}}"#,
            joints.join(",\n"),
            at("coulomb_friction"),
            at("stribeck_friction")
        )
    }

    fn read(path: &Path, robot: &Robot) -> Result<(), String> {
        let sentence = |error: DesignError| error.to_string();
        let file = DiagnosisFile::read(path, robot).map_err(sentence)?;
        // What is wrong with a cause is told of its name.
        let _ = (file.findings(robot).is_ok(), file.goals(robot).is_ok());
        let _ = (file.noise(), file.cutoff_hz(), file.knows("00"));
        Ok(())
    }

    fn round(seeds: std::ops::Range<u64>) -> round::Counts {
        let robot = checks::arms::wam();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("diagnosis.json");
        let good = good(&robot);
        std::fs::write(&path, &good).unwrap();
        assert_eq!(read(&path, &robot), Ok(()));
        let change = |random: &mut _| mutated::text(&good, random);
        let counts = round::run("diagnosis", seeds, &path, change, |path| read(path, &robot));
        let counts = counts.unwrap();
        let few = (counts.read + counts.refused) / 50;
        assert!(counts.read > few && counts.refused > few, "{counts:?}");
        counts
    }

    #[test]
    fn no_changed_diagnosis_ends_the_program() {
        match round::fresh_seeds() {
            None => println!("{:?}", round(0..1500)),
            Some(first) => println!("{:?}", round(first..first + 20_000)),
        }
    }
}
