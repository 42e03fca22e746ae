use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use catalogue::{EffectKind, Parameter};
use diagnosis::{
    DataSummary, Diagnosis, EffectAt, Estimate, Finding, Gain, InverseGain, SCHEMA, Verdict,
};

use files::FileError;
use serde_json::{Map, Value};

use crate::cause_bench::answer::{NamedCause, NamedPlace, NamedSize, TrialAnswer};
use crate::cause_bench::answer_fault::AnswerFault;
use crate::cause_bench::manifest::BenchTrial;

/// Largest answer (bytes); predictions and models are files of their own.
const MOST_BYTES: u64 = 1 << 20;
/// Most names of an answer.
const MOST_NAMES: usize = 200;
/// Most rivals of a name.
pub(super) const MOST_RIVALS: usize = 4;
/// Most sizes of a name.
const MOST_SIZES: usize = 20;

/// An answer to a trial, checked.
#[derive(Debug, Clone, PartialEq)]
pub struct SpokenAnswer {
    /// What it says of causes, as a diagnosis; an error where it refuses the logs.
    pub diagnosis: Result<Diagnosis, String>,
    /// The file with its prediction.
    pub prediction: Option<PathBuf>,
    /// Processor time that it states (s).
    pub seconds: Option<f64>,
}

impl SpokenAnswer {
    /// An answer that says nothing.
    pub fn silent() -> Self {
        Self {
            diagnosis: Ok(diagnosis(Verdict::Consistent, vec![])),
            prediction: None,
            seconds: None,
        }
    }

    /// Reads and checks the answer to a trial from a folder of answers.
    ///
    /// # Errors
    ///
    /// [`AnswerFault`] with the first key at fault. The whole answer then counts as nothing said, but where the disk failed.
    pub fn read(folder: &Path, trial: &BenchTrial) -> Result<Self, AnswerFault> {
        let path = folder.join(format!("{}.json", trial.name));
        let check = Check { path: &path, folder, trial };
        let whole = |found: String| check.fault("", found, "the answer to a trial as JSON");
        let text = files::text(&path, MOST_BYTES).map_err(|error| match error {
            FileError::Missing => whole("no file".to_owned()),
            FileError::Unreadable { reason } => AnswerFault { is_unread: true, ..whole(reason) },
            error => whole(error.to_string()),
        })?;
        let unread =
            |error: serde_json::Error| whole(files::shorten_words(&error.to_string()).into_owned());
        // A list would be read as the fields of an answer in their order.
        let object: Map<String, Value> = serde_json::from_str(&text).map_err(unread)?;
        let answer: TrialAnswer = serde_json::from_value(object.into()).map_err(unread)?;
        check.answer(answer)
    }
}

/// Checks an answer.
struct Check<'a> {
    path: &'a Path,
    folder: &'a Path,
    trial: &'a BenchTrial,
}

impl Check<'_> {
    fn fault(&self, place: &str, found: String, expected: &str) -> AnswerFault {
        let place = if place.is_empty() { String::new() } else { format!("{place}: ") };
        let (path, expected) = (self.path.to_owned(), expected.to_owned());
        AnswerFault { path, place, found, expected, is_unread: false }
    }

    fn answer(&self, answer: TrialAnswer) -> Result<SpokenAnswer, AnswerFault> {
        self.at_most("names", answer.names.len(), MOST_NAMES)?;
        let mut findings = Vec::with_capacity(answer.names.len());
        let mut seen = BTreeSet::new();
        for (k, named) in answer.names.iter().enumerate() {
            let finding = self.finding(&format!("names[{k}]"), named, k)?;
            if !seen.insert(finding.at.words()) {
                let words = files::shorten_words(&finding.at.words()).into_owned();
                return Err(self.fault(&format!("names[{k}]"), words, "each cause once"));
            }
            findings.push(finding);
        }
        if let Some(seconds) = answer.seconds.filter(|s| !(s.is_finite() && *s >= 0.0)) {
            return Err(self.fault("seconds", seconds.to_string(), "a time from 0"));
        }
        let file = |key: &str, name: Option<String>| name.map(|n| self.beside(key, &n)).transpose();
        file("model", answer.model)?;
        let verdict = match (answer.left_open, findings.is_empty()) {
            (true, true) => Verdict::Unexplained,
            (true, false) => Verdict::PartlyExplained,
            (false, true) => Verdict::Consistent,
            (false, false) => Verdict::Explained,
        };
        Ok(SpokenAnswer {
            diagnosis: match answer.refused {
                true => Err("the logs are refused".to_owned()),
                false => Ok(diagnosis(verdict, findings)),
            },
            prediction: file("prediction", answer.prediction)?,
            seconds: answer.seconds,
        })
    }

    fn at_most(&self, place: &str, found: usize, most: usize) -> Result<(), AnswerFault> {
        if found <= most {
            return Ok(());
        }
        Err(self.fault(place, format!("a list of {found}"), &format!("{most} at most")))
    }

    /// A file whose name stands at a key: it lies in the folder of the answers.
    fn beside(&self, key: &str, name: &str) -> Result<PathBuf, AnswerFault> {
        let path = self.folder.join(name);
        let is_name = !name.contains(['/', '\\']) && files::is_below(&path, self.folder);
        match is_name && path.is_file() {
            true => Ok(path),
            false => Err(self.fault(key, quote(name), "the name of a file beside the answer")),
        }
    }

    fn finding(
        &self,
        place: &str,
        named: &NamedCause,
        rank: usize,
    ) -> Result<Finding, AnswerFault> {
        self.at_most(&format!("{place}.rivals"), named.rivals.len(), MOST_RIVALS)?;
        self.at_most(&format!("{place}.sizes"), named.sizes.len(), MOST_SIZES)?;
        let at = self.place(place, &named.effect, [&named.joint, &named.link])?;
        let rivals = named.rivals.iter().enumerate();
        let rival = |(k, NamedPlace { effect, joint, link }): (usize, &NamedPlace)| {
            self.place(&format!("{place}.rivals[{k}]"), effect, [joint, link])
        };
        let rivals: Result<Vec<_>, _> = rivals.map(rival).collect();
        let sizes = named.sizes.iter().enumerate();
        let parameters: Result<Vec<_>, _> = sizes
            .map(|(k, size)| self.estimate(&format!("{place}.sizes[{k}]"), at.effect, size))
            .collect();
        Ok(Finding {
            at,
            parameters: parameters?,
            // Findings are put in the order of this share: the order of the answer.
            share_explained: 1.0 / (1.0 + rank as f64),
            log_evidence: 0.0,
            held_out_gain: 0.0,
            not_separable_from: rivals?,
            told_apart_by: None,
            evidence: Vec::new(),
            undetermined: Vec::new(),
        })
    }

    fn place(
        &self,
        place: &str,
        effect: &str,
        [joint, link]: [&Option<String>; 2],
    ) -> Result<EffectAt, AnswerFault> {
        let kind: EffectKind = effect.parse().map_err(|_| {
            let expected = "a name of the catalogue such as coulomb_friction, or its code FR02";
            self.fault(&format!("{place}.effect"), quote(effect), expected)
        })?;
        let known = |key: &str, name: &Option<String>, all: &[String]| match name {
            Some(name) if !all.contains(name) => {
                let expected = format!("one of {}", all.join(", "));
                Err(self.fault(&format!("{place}.{key}"), quote(name), &expected))
            }
            _ => Ok(()),
        };
        known("joint", joint, &self.trial.joints)?;
        known("link", link, &self.trial.links)?;
        Ok(EffectAt { effect: kind, joint: joint.clone(), link: link.clone() })
    }

    fn estimate(
        &self,
        place: &str,
        effect: EffectKind,
        size: &NamedSize,
    ) -> Result<Estimate, AnswerFault> {
        let parameters = effect.entry().parameters;
        let Some(Parameter { name, unit, .. }) =
            parameters.iter().find(|p| p.name == size.parameter)
        else {
            let names: Vec<&str> = parameters.iter().map(|p| p.name).collect();
            let expected = format!("one of {}", names.join(", "));
            return Err(self.fault(
                &format!("{place}.parameter"),
                quote(&size.parameter),
                &expected,
            ));
        };
        let [low, high] = size.interval;
        let numbers = [size.value, low, high, size.described.unwrap_or(0.0)];
        if low > high || numbers.iter().any(|number| !number.is_finite()) {
            let found = format!("{} ({low} to {high})", size.value);
            return Err(self.fault(place, found, "finite numbers, the lower end first"));
        }
        let nominal = size.described.unwrap_or(match effect {
            EffectKind::TorqueConstant | EffectKind::TransmissionRatio => 1.0,
            _ => 0.0,
        });
        let (value, ci95) = (size.value, size.interval);
        Ok(Estimate { name, value, ci95, noise95: ci95, nominal, unit, determined: true })
    }
}

/// A diagnosis that says this and nothing else.
fn diagnosis(verdict: Verdict, findings: Vec<Finding>) -> Diagnosis {
    Diagnosis {
        schema: SCHEMA,
        robot: String::new(),
        verdict,
        joints: Vec::new(),
        findings,
        negligible: Vec::new(),
        unexplained: Vec::new(),
        also_fitted: None,
        ruled_out: Vec::new(),
        gain: Gain {
            inverse: InverseGain {
                nmse_before: Vec::new(),
                nmse_after: Vec::new(),
                rms_before_nm: Vec::new(),
                rms_after_nm: Vec::new(),
                held_out: String::new(),
                folds: Vec::new(),
            },
        },
        data: DataSummary {
            runs: Vec::new(),
            put_right: false,
            cutoff_hz: 0.0,
            cutoff_reason: String::new(),
            regression_rate_hz: 0.0,
            block_s: 0.0,
            blocks: 0,
            hypotheses: 0,
        },
        warnings: Vec::new(),
    }
}

fn quote(text: &str) -> String {
    format!("{:?}", files::shorten(text))
}
