use std::path::{Path, PathBuf};

use catalogue::EffectKind;
use document::{Document, DocumentError, KeyPath};
use experiment::sha256;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simulator::scenario::{Scenario, ScenarioSpec};

use crate::error::BenchmarkError;
use crate::trials::hash::seed_of;
use crate::trials::hidden::Hidden;
use crate::trials::trial::Trial;

/// The word for every kind of the catalogue, one effect each.
const EACH: &str = "each";
/// The word for the same, each left out of the diagnosis.
const WITHOUT_EACH: &str = "without_each";
/// The word for the same, each left out together with the effects it is confused with.
const STRANGE_EACH: &str = "strange_each";
/// Start of the identity of a campaign.
const IDENTITY: &str = "campaign by content/1\n";
/// Most trials of a kind.
const MOST_SEEDS: usize = 1_000_000;

/// A campaign of blind trials: what is hidden in the arm of a scenario, and how often.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Plumbline campaign of blind trials")]
pub struct CampaignSpec {
    /// The scenario of the arm, relative to this file: its robot, sensors, engine and runs.
    pub scenario: PathBuf,
    /// What is hidden, kind by kind: `clean`; an effect, or `each` for every one of the catalogue;
    /// two with a plus between them, or `any+any`; `without_` and an effect, or `without_each`,
    /// for one that the diagnosis does not look for; `strange_` and an effect, or `strange_each`,
    /// for one of which it looks for nothing that it is confused with either.
    #[schemars(schema_with = "names_of_kinds")]
    pub hidden: Vec<String>,
    /// Effects that `each`, `without_each`, `strange_each` and `any+any` leave out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(schema_with = "names_of_effects")]
    pub except: Vec<EffectKind>,
    /// Trials of each kind.
    pub seeds: usize,
    /// Seed from which, with kind and number, that of every trial follows.
    #[serde(default)]
    pub seed: u64,
    /// Settings of the scenario, `key=value` as `--set` takes them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub settings: Vec<String>,
    /// Whether the last run of the scenario takes no part in the diagnosis and shows how well its
    /// torque is predicted: by the robot as described, with the findings and by least squares.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub gains: bool,
}

fn names_of_kinds(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let names = names();
    let name = schemars::json_schema!({ "type": "string", "enum": names });
    let two = schemars::json_schema!({ "type": "string", "pattern": "^[^+]+[+][^+]+$" });
    let unknown = schemars::json_schema!({ "type": "string", "pattern": "^(without|strange)_.+$" });
    schemars::json_schema!({ "type": "array", "items": { "anyOf": [name, two, unknown] } })
}

fn names_of_effects(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let names = EffectKind::ALL.map(EffectKind::name);
    schemars::json_schema!({ "type": "array", "items": { "type": "string", "enum": names } })
}

fn names() -> Vec<&'static str> {
    let several = ["clean", EACH, WITHOUT_EACH, STRANGE_EACH];
    several.into_iter().chain(EffectKind::ALL.map(EffectKind::name)).collect()
}

/// A campaign of the arm of a scenario, with checked values.
///
/// ```text
/// task  = number len(kinds) + place of the kind,  number = 0 .. seeds - 1
/// seed  = first 63 bits of SHA-256("campaign seed/kind/number")
/// ```
///
/// A half-finished campaign thus has equally many trials of every kind, and trials of different kinds are
/// independent.
#[derive(Debug, Clone)]
pub struct ScenarioCampaign {
    kinds: Vec<Hidden>,
    seeds: usize,
    seed: u64,
    /// The scenario including the settings, as one text that can be read from any folder.
    scenario: String,
    /// Content of the scenario, without a path.
    content: String,
    gains: bool,
}

impl ScenarioCampaign {
    /// Reads a campaign from a document.
    ///
    /// # Errors
    ///
    /// [`ExperimentError::Document`](experiment::ExperimentError::Document) at the value at fault, and the errors of
    /// the scenario.
    pub fn from_document(document: &Document) -> Result<Self, BenchmarkError> {
        let spec: CampaignSpec = document.parse()?;
        let kinds = kinds(document, &spec)?;
        if !(1..=MOST_SEEDS).contains(&spec.seeds) {
            let message = format!("{}, a number from 1 to {MOST_SEEDS} was expected", spec.seeds);
            return Err(document.mistake(&KeyPath::root().key("seeds"), message, None).into());
        }
        let scenario = scenario(document, &spec)?;
        if spec.gains && runs(&scenario)? < 2 {
            let message =
                "one run, two or more were expected: the last one takes no part in the diagnosis";
            return Err(document.mistake(&KeyPath::root().key("gains"), message, None).into());
        }
        let content = content(&scenario)?;
        let (seeds, seed, gains) = (spec.seeds, spec.seed, spec.gains);
        Ok(Self { kinds, seeds, seed, scenario, content, gains })
    }

    /// The campaign as one text, beside a scenario file of this name.
    pub(super) fn self_contained_text(&self, scenario: &str) -> String {
        let spec = CampaignSpec {
            scenario: PathBuf::from(scenario),
            hidden: self.kinds.iter().map(Hidden::to_string).collect(),
            except: Vec::new(),
            seeds: self.seeds,
            seed: self.seed,
            settings: Vec::new(),
            gains: self.gains,
        };
        // What has come from TOML can be written as TOML.
        toml::to_string(&spec).unwrap_or_default()
    }

    /// The scenario that every trial starts from, settings included.
    pub(super) fn scenario(&self) -> &str {
        &self.scenario
    }

    /// The hidden effects, kind by kind.
    pub fn kinds(&self) -> &[Hidden] {
        &self.kinds
    }

    /// Number of trials.
    pub fn trials(&self) -> usize {
        self.kinds.len() * self.seeds
    }

    /// Everything that its scores depend on, except for this program, as a text. Files count by their content,
    /// independent of their paths.
    pub(super) fn identity(&self) -> String {
        [IDENTITY, &self.self_contained_text(""), "\n", &self.content].concat()
    }

    /// The kind and the seed of a task, from 0 to [`trials`](Self::trials) - 1.
    pub fn task(&self, task: usize) -> (Hidden, u64) {
        let hidden = self.kinds[task % self.kinds.len()];
        (hidden, seed_of(self.seed, &hidden.to_string(), task / self.kinds.len()))
    }

    /// The trial of a task; `scenario` is the file of the scenario.
    pub(super) fn trial(&self, task: usize, scenario: &Path) -> Trial {
        let (hidden, seed) = self.task(task);
        let (scenario, settings) = (scenario.to_owned(), Vec::new());
        Trial { scenario, hidden, seed, settings, gains: self.gains }
    }
}

fn kinds(document: &Document, spec: &CampaignSpec) -> Result<Vec<Hidden>, DocumentError> {
    let path = KeyPath::root().key("hidden");
    let mut kinds: Vec<Hidden> = Vec::new();
    let each = |hide: fn(EffectKind) -> Hidden| drawn_kinds(spec).map(hide).collect();
    for (i, name) in spec.hidden.iter().enumerate() {
        let path = path.index(i);
        let named: Vec<Hidden> = match name.as_str() {
            EACH => each(Hidden::One),
            WITHOUT_EACH => each(Hidden::Unknown),
            STRANGE_EACH => each(Hidden::WithoutRelatives),
            name => {
                let unknown = |_| document.unknown_name(&path, "kind of trial", name, &names());
                vec![name.parse::<Hidden>().map_err(unknown)?.in_order()]
            }
        };
        if let Some(twice) = named.iter().find(|kind| kinds.contains(kind)) {
            let message = format!("{twice} is there already");
            return Err(document.mistake(&path, message, None));
        }
        kinds.extend(named);
    }
    if kinds.is_empty() {
        let message = "nothing, at least one kind was expected, such as \"each\"";
        return Err(document.mistake(&path, message, None));
    }
    Ok(kinds)
}

/// The kinds that effects are drawn from where no kind is given.
fn drawn_kinds(spec: &CampaignSpec) -> impl Iterator<Item = EffectKind> {
    EffectKind::ALL.into_iter().filter(|kind| !spec.except.contains(kind))
}

/// A resolved scenario in which the contents of its robot and recorded files replace their paths.
fn content(scenario: &str) -> Result<String, BenchmarkError> {
    let mut spec: ScenarioSpec = Document::from_text("scenario", scenario)?.parse()?;
    let content = Robot::load(&spec.robot)?.content()?;
    spec.robot = PathBuf::new();
    for file in spec.run.iter_mut().flat_map(|run| run.motion.files_mut()) {
        *file = PathBuf::from(content_of(file)?);
    }
    // What has come from TOML can be written as TOML.
    Ok(toml::to_string(&spec).unwrap_or_default() + &content)
}

/// Number of runs of a resolved scenario.
fn runs(scenario: &str) -> Result<usize, BenchmarkError> {
    let spec: ScenarioSpec = Document::from_text("scenario", scenario)?.parse()?;
    Ok(spec.run.len())
}

/// Hash of a file, or of the files of a bag in the order of their names.
fn content_of(path: &Path) -> Result<String, BenchmarkError> {
    let Ok(entries) = std::fs::read_dir(path) else { return Ok(sha256(path)?) };
    let mut files: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    files.sort();
    files.iter().filter(|file| file.is_file()).map(|file| Ok(sha256(file)?)).collect()
}

/// The scenario with the settings, checked.
fn scenario(document: &Document, spec: &CampaignSpec) -> Result<String, BenchmarkError> {
    let key = KeyPath::root().key("scenario");
    let (mut scenario, _) = document.read_named(&key, &spec.scenario)?;
    // A count is needed beside what a setting may say of hidden effects.
    for setting in Hidden::Nothing.settings() {
        scenario.set(&setting).map_err(|_| {
            let found = spec.scenario.display();
            let message = format!("{found} is no scenario: nothing can be hidden in it");
            document.mistake(&key, message, None)
        })?;
    }
    if !spec.except.is_empty() {
        let from: Vec<String> = drawn_kinds(spec).map(|kind| format!("'{kind}'")).collect();
        scenario.set(&format!("hidden.from=[{}]", from.join(", ")))?;
    }
    for setting in &spec.settings {
        scenario.set(setting)?;
    }
    Ok(Scenario::from_document(&scenario)?.self_contained_text().to_owned())
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    fn campaign(kinds: &[&str], seeds: usize, seed: u64) -> ScenarioCampaign {
        let kinds = kinds.iter().map(|kind| kind.parse().unwrap()).collect();
        let (scenario, content) = (String::new(), String::new());
        ScenarioCampaign { kinds, seeds, seed, scenario, content, gains: false }
    }

    /// The digests are those of `printf '%s' 7/backlash/1 | sha256sum`.
    #[test]
    fn a_seed_is_the_first_63_bits_of_a_published_hash() {
        let campaign = campaign(&["clean", "backlash"], 2, 7);
        assert_eq!(campaign.trials(), 4);
        let backlash = Hidden::One(EffectKind::Backlash);
        assert_eq!(campaign.task(3), (backlash, 0xbf979f4fe302b5e7 >> 1));
        assert_eq!(campaign.task(2).0, Hidden::Nothing);
    }

    #[test]
    fn no_two_trials_share_a_seed_and_each_fits_into_toml() {
        let all = |seed| {
            let campaign = campaign(&["clean", "backlash", "payload+backlash"], 100, seed);
            (0..campaign.trials()).map(|task| campaign.task(task).1).collect::<Vec<_>>()
        };
        let seeds = [all(0), all(1)].concat();
        assert!(seeds.iter().all(|&seed| i64::try_from(seed).is_ok()));
        assert_eq!(seeds.iter().collect::<BTreeSet<_>>().len(), 600);
    }

    #[test]
    fn whatever_a_score_follows_from_makes_another_campaign() {
        let usual = campaign(&["clean", "backlash"], 2, 7);
        let content = "robot = 'arm.toml'".to_owned();
        let others = [
            campaign(&["backlash", "clean"], 2, 7),
            campaign(&["clean", "backlash"], 3, 7),
            campaign(&["clean", "backlash"], 2, 8),
            ScenarioCampaign { content, ..usual.clone() },
            ScenarioCampaign { gains: true, ..usual.clone() },
        ];
        assert!(others.iter().all(|other| other.identity() != usual.identity()));
        assert_eq!(campaign(&["clean", "TR01"], 2, 7).identity(), usual.identity());
    }
}
