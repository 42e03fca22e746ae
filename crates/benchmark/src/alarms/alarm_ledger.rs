use std::collections::BTreeMap;

use serde::Serialize;

use crate::alarms::alarm::Alarm;
use crate::alarms::alarm_row::AlarmRow;
use crate::alarms::false_name::FalseName;
use crate::alarms::log_property::{LogProperties, LogProperty};
use crate::panel::judgement::Judgement;

/// What was said of clean logs: trials of which all causes are known and in which an oracle sees none.
///
/// ```text
/// alarm = something false is named, or structure is left open
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AlarmLedger {
    /// All clean logs, then by what made them, motion, arm, rate, encoder and effort.
    pub rows: Vec<AlarmRow>,
    /// By two of arm, rate, encoder and effort.
    pub pairs: Vec<AlarmRow>,
    /// By arm, rate, encoder and effort together.
    pub corners: Vec<AlarmRow>,
    /// Kinds of effects that are named falsely, the most frequent first.
    pub names: Vec<FalseName>,
    /// The alarms, by the seed of the trial.
    pub alarms: Vec<Alarm>,
}

impl AlarmLedger {
    /// The ledger of some judgements, whatever their order.
    pub fn of(judgements: &[Judgement]) -> Self {
        let mut clean: Vec<&Judgement> =
            judgements.iter().filter(|one| one.false_alarm().is_some()).collect();
        clean.sort_by_key(|one| (one.seed, one.corner.origin));
        let all = (!clean.is_empty()).then(|| AlarmRow::new("all".to_owned(), &clean));
        let crossed = |one: &Judgement| LogProperty::of(&one.corner, LogProperties::Crossed);
        let single = |one: &Judgement| {
            let properties = LogProperty::of(&one.corner, LogProperties::All);
            properties.into_iter().map(|property| vec![property]).collect()
        };
        Self {
            rows: all.into_iter().chain(rows(&clean, single)).collect(),
            pairs: rows(&clean, |one| pairs(&crossed(one))),
            corners: rows(&clean, |one| vec![crossed(one)]),
            names: FalseName::all(&clean),
            alarms: clean.iter().filter_map(|one| Alarm::of(one)).collect(),
        }
    }
}

/// One row for each group that a trial belongs to, in the order of their properties.
fn rows(
    clean: &[&Judgement],
    groups: impl Fn(&Judgement) -> Vec<Vec<LogProperty>>,
) -> Vec<AlarmRow> {
    let mut all: BTreeMap<Vec<LogProperty>, Vec<&Judgement>> = BTreeMap::new();
    for one in clean {
        for group in groups(one) {
            all.entry(group).or_default().push(one);
        }
    }
    let words =
        |group: &[LogProperty]| group.iter().map(LogProperty::words).collect::<Vec<_>>().join(", ");
    all.iter().map(|(group, own)| AlarmRow::new(words(group), own)).collect()
}

/// Every two of some properties.
fn pairs(properties: &[LogProperty]) -> Vec<Vec<LogProperty>> {
    let with_later = |(k, first): (usize, &LogProperty)| {
        let later = properties.iter().skip(k + 1);
        later.map(|second| vec![first.clone(), second.clone()]).collect::<Vec<_>>()
    };
    properties.iter().enumerate().flat_map(with_later).collect()
}
