use std::collections::BTreeMap;
use std::fmt;

use population::{ArmClass, Corner, EffortClass, FieldFeature, LogKind, MotionClass, Origin};
use serde::{Serialize, Serializer};

use crate::panel::judgement::Judgement;

/// Step of a position reading above which an encoder is coarse (rad or m).
const COARSE: f64 = 0.0005;

/// Largest lateness of a servo's goals that counts as none (ms): half a row at 100 Hz.
const PUNCTUAL_MS: f64 = 5.0;

/// Trials of a population that have one property in common.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct PanelSide {
    /// Indices of the property and of its value among the rows of a table.
    order: [usize; 2],
    /// The common property; empty for all trials.
    thing: &'static str,
    /// Its value.
    kind: String,
}

impl PanelSide {
    /// Judgements by side: all of them, then by each property in turn. For each property a trial is in one side; of
    /// what robots in use have, it is in as many as it has.
    pub(crate) fn by_side(judgements: &[Judgement]) -> Vec<(Self, Vec<&Judgement>)> {
        let mut sides: BTreeMap<Self, Vec<&Judgement>> = BTreeMap::new();
        for judgement in judgements {
            for side in Self::of(judgement) {
                sides.entry(side).or_default().push(judgement);
            }
        }
        sides.into_iter().collect()
    }

    /// The common property; empty for all trials.
    pub fn thing(&self) -> &'static str {
        self.thing
    }

    /// The sides that a judgement is in.
    pub(crate) fn of(judgement: &Judgement) -> Vec<Self> {
        let corner = &judgement.corner;
        let causes = bucket(judgement.visible().count(), &["0", "1", "2-3", "4-7", "8+"], CAUSES);
        let logs = bucket(corner.logs, &["1", "2-3", "4+"], LOGS);
        let arms: Vec<&str> = ArmClass::ALL.iter().map(|arm| arm.name()).collect();
        let coarse = usize::from(corner.encoder_step <= COARSE);
        let repeats = usize::from(corner.repeats);
        let things = [
            ("", (0, "all".to_owned())),
            ("arm", place(&corner.arm, &arms)),
            ("logs are", place(corner.origin.name(), &names(Origin::ALL, Origin::name))),
            ("motion", place(corner.motion.name(), &names(MotionClass::ALL, MotionClass::name))),
            ("effort", place(corner.effort.name(), &names(EffortClass::ALL, EffortClass::name))),
            ("encoder", (coarse, ["coarse", "fine"][coarse].to_owned())),
            ("visible causes", causes),
            ("logs", logs),
            ("runs", (repeats, ["differ", "repeat"][repeats].to_owned())),
            ("log", log(corner)),
            ("goals", goals(corner)),
        ];
        let met = names(FieldFeature::ALL, FieldFeature::name);
        let met = corner.field.iter().map(|feature| ("met with", place(feature.name(), &met)));
        let met = met.map(|side| (things.len(), side)).collect::<Vec<_>>();
        let side = |(thing, (name, (rank, kind)))| Self { order: [thing, rank], thing: name, kind };
        things.into_iter().enumerate().chain(met).map(side).collect()
    }
}

/// The first kind in which the logs differ from usual ones.
fn log(corner: &Corner) -> (usize, String) {
    let kinds: Vec<&str> = LogKind::ALL.iter().map(|kind| kind.name()).collect();
    match corner.log_kinds.first() {
        None => (0, "usual".to_owned()),
        Some(kind) => {
            let (rank, name) = place(kind.name(), &kinds);
            (1 + rank, name)
        }
    }
}

/// Whether a controller follows the motion, or servos their goals, and how late.
fn goals(corner: &Corner) -> (usize, String) {
    let rank = match corner.goal_delay_ms {
        None => 0,
        Some(delay_ms) => 1 + usize::from(delay_ms > PUNCTUAL_MS),
    };
    (rank, ["of a controller", "of servos", "of servos, late"][rank].to_owned())
}

/// Lower ends of the classes.
const CAUSES: &[usize] = &[0, 1, 2, 4, 8];
const LOGS: &[usize] = &[0, 2, 4];

fn bucket(count: usize, names: &[&str], least: &[usize]) -> (usize, String) {
    let rank = least.iter().filter(|least| count >= **least).count().saturating_sub(1);
    (rank, names.get(rank).copied().unwrap_or_default().to_owned())
}

fn names<T: Copy>(all: &[T], name: fn(T) -> &'static str) -> Vec<&'static str> {
    all.iter().map(|one| name(*one)).collect()
}

/// Index of a name among the known ones, and the name; unknown names follow.
fn place(name: &str, known: &[&str]) -> (usize, String) {
    let rank = known.iter().position(|other| *other == name);
    (rank.unwrap_or(known.len()), name.to_owned())
}

impl fmt::Display for PanelSide {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let space = if self.thing.is_empty() { "" } else { " " };
        write!(f, "{}{space}{}", self.thing, self.kind.replace('_', " "))
    }
}

/// As it is written.
impl Serialize for PanelSide {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
