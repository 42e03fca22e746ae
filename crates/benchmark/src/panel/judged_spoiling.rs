use std::fmt;

use diagnosis::{Diagnosis, Verdict};
use population::{LogKind, TrueStranger};
use serde::{Deserialize, Serialize};

use crate::panel::judged_finding::JudgedFinding;
use crate::panel::spoiling_phrases::{EXCHANGED, OTHER_SIGN, spoiling_phrases};

/// Starts of the names of strangers that are in the logs, or in how the model reads them, instead of the arm.
const SPOILINGS: [&str; 2] = ["log: ", "model: "];

/// End of the sentence of a correction that a diagnosis applies.
const READ_SO: &str = "Until then the logs are read so.";

/// Phrases with which an inspection of whole logs says that something is wrong with them.
const SAYS_SPOILT: [&str; 14] = [
    "other sign",
    "seem to be exchanged",
    "in another unit",
    "lack the torque of gravity",
    "what a second is",
    "stands still while the arm",
    "stand still while the clock",
    "single samples that are off",
    "jumps between two samples",
    "seems to be degrees",
    "ask for a gravity",
    "seems to be off by",
    "fit the motion when they are taken",
    "Nothing of the nominal torque",
];

/// What a diagnosis makes of spoilt logs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SpoilingOutcome {
    /// It says what is spoilt and where.
    ToldRightly,
    /// It says that something else is spoilt, or the same elsewhere.
    ToldWrongly,
    /// It says what is spoilt and where, and reads the logs as they should be.
    ReadRightly,
    /// It rejects the logs or leaves them open for another reason, and names nothing false.
    Refused,
    /// It closes the logs or names something false, and says nothing of the spoiling.
    TakenIn,
}

/// A spoiling of the logs of a trial that an oracle sees, and what became of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JudgedSpoiling {
    /// Its name on the sheet, without `log: ` or `model: `.
    pub name: String,
    /// The joint that it is at, where it is at one.
    pub joint: Option<String>,
    /// What the diagnosis makes of it.
    pub outcome: SpoilingOutcome,
}

impl SpoilingOutcome {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::ToldRightly, Self::ToldWrongly, Self::ReadRightly, Self::Refused, Self::TakenIn];

    /// Whether nobody is misled.
    pub fn is_right(self) -> bool {
        matches!(self, Self::ToldRightly | Self::ReadRightly | Self::Refused)
    }

    fn new(
        stranger: &TrueStranger,
        diagnosis: Result<&Diagnosis, &String>,
        findings: &[JudgedFinding],
    ) -> Self {
        let tells = |text: &str| says(stranger, text);
        let tells_another = |text: &str| SAYS_SPOILT.iter().any(|words| text.contains(words));
        let diagnosis = match diagnosis {
            Err(why) if tells(why) => return Self::ToldRightly,
            Err(why) if tells_another(why) => return Self::ToldWrongly,
            Err(_) => return Self::Refused,
            Ok(diagnosis) => diagnosis,
        };
        let reasons = diagnosis.joints.iter().map(|joint| &joint.because);
        let said: Vec<&String> = diagnosis.warnings.iter().chain(reasons).collect();
        let mut told = said.iter().filter(|text| tells(text)).peekable();
        let told_at_all = told.peek().is_some();
        let is_open = match diagnosis.verdict {
            Verdict::DataInadequate => true,
            Verdict::Unexplained | Verdict::PartlyExplained => {
                findings.iter().all(|finding| finding.is_true)
            }
            Verdict::Consistent | Verdict::Explained => false,
        };
        if diagnosis.data.put_right && told.any(|text| text.ends_with(READ_SO)) {
            Self::ReadRightly
        } else if told_at_all {
            Self::ToldRightly
        } else if said.iter().any(|text| tells_another(text)) {
            Self::ToldWrongly
        } else if is_open {
            Self::Refused
        } else {
            Self::TakenIn
        }
    }
}

impl JudgedSpoiling {
    /// Whether a stranger of a sheet is in the logs, or in how the model reads them, instead of the arm.
    pub(super) fn is_one(stranger: &TrueStranger) -> bool {
        SPOILINGS.iter().any(|start| stranger.name.starts_with(start))
    }

    /// The visible spoilings among the strangers of a sheet.
    pub(super) fn all(
        strangers: &[TrueStranger],
        diagnosis: Result<&Diagnosis, &String>,
        findings: &[JudgedFinding],
    ) -> Vec<Self> {
        let visible = |other: &&TrueStranger| Self::is_one(other) && other.strength.visible();
        let judge = |stranger: &TrueStranger| Self {
            name: kind(stranger).to_owned(),
            joint: stranger.joint.clone(),
            outcome: SpoilingOutcome::new(stranger, diagnosis, findings),
        };
        strangers.iter().filter(visible).map(judge).collect()
    }
}

fn kind(stranger: &TrueStranger) -> &str {
    let mut kinds = SPOILINGS.iter().filter_map(|start| stranger.name.strip_prefix(start));
    kinds.next().unwrap_or(&stranger.name)
}

/// Whether a text names the spoiling and its joint, if it has one.
fn says(stranger: &TrueStranger, text: &str) -> bool {
    let name = kind(stranger);
    let logged = LogKind::ALL.iter().find(|kind| kind.stranger() == stranger.name);
    let phrases = match (logged, name) {
        (Some(kind), _) => spoiling_phrases(*kind),
        (None, "axis turned") => OTHER_SIGN,
        (None, "columns exchanged" | "joints exchanged") => EXCHANGED,
        (None, _) => std::slice::from_ref(&name),
    };
    let at_joint = |joint: &String| {
        let is_part_of_a_name = |c: char| c.is_alphanumeric() || c == '_';
        let names = text.split(|c: char| !is_part_of_a_name(c));
        text.contains("all joints") || names.into_iter().any(|name| name == joint)
    };
    phrases.iter().any(|phrase| text.contains(phrase)) && stranger.joint.iter().all(at_joint)
}

impl fmt::Display for SpoilingOutcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::ToldRightly => "told rightly",
            Self::ToldWrongly => "told wrongly",
            Self::ReadRightly => "read so rightly",
            Self::Refused => "refused",
            Self::TakenIn => "taken in",
        })
    }
}
