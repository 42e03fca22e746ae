//! Columns of a table of records.

use std::sync::Arc;

use arrow_array::{ArrayRef, BooleanArray, Float64Array, StringArray, UInt64Array};

use crate::panel::judgement::Judgement;
use crate::trials::record::Record;

/// A column and its name.
pub(super) type Named = (&'static str, ArrayRef);

/// All columns.
pub(super) fn all(records: &[Record]) -> Result<Vec<Named>, serde_json::Error> {
    let json = |record: &Record| record.score.as_ref().ok().map(serde_json::to_string).transpose();
    let json = records.iter().map(json).collect::<Result<Vec<_>, _>>()?;
    let number = |of: fn(&Record) -> u64| numbers(records.iter().map(|r| Some(of(r))));
    let mut columns = vec![
        ("task", number(|r| r.task as u64)),
        ("seed", number(|r| r.seed)),
        ("campaign", texts(records.iter().map(|r| Some(r.campaign.clone())))),
        ("error", texts(records.iter().map(|r| r.score.clone().err()))),
        ("score", texts(json.into_iter())),
        ("hidden", texts(records.iter().map(|r| r.hidden.map(|hidden| hidden.to_string())))),
    ];
    columns.extend(of_judgements(records));
    Ok(columns)
}

fn of_judgements(records: &[Record]) -> Vec<Named> {
    let judgements = || records.iter().map(Record::judgement);
    let text =
        |of: fn(&Judgement) -> &str| texts(judgements().map(|j| j.map(|j| of(j).to_owned())));
    let count =
        |of: fn(&Judgement) -> usize| numbers(judgements().map(|j| j.map(|j| of(j) as u64)));
    let answer = |of: fn(&Judgement) -> Option<bool>| answers(judgements().map(|j| j.and_then(of)));
    let times = judgements().map(|j| j.map(|j| j.costs.diagnosis_s));
    vec![
        ("arm", text(|j| &j.corner.arm)),
        ("motion", text(|j| j.corner.motion.name())),
        ("verdict", text(|j| j.verdict.words())),
        ("right", answer(Judgement::right)),
        ("findings", count(|j| j.findings.len())),
        ("true_findings", count(|j| j.findings.iter().filter(|f| f.is_true).count())),
        ("visible", count(|j| j.causes_to_name().count())),
        ("named", count(|j| j.causes_to_name().filter(|cause| cause.is_named()).count())),
        ("false_assurance", answer(Judgement::false_assurance)),
        ("false_alarm", answer(Judgement::false_alarm)),
        ("misled", answer(Judgement::is_misled)),
        ("worse", answer(|j| j.fair_prediction()?.worse())),
        ("worse_than_by_hand", answer(|j| j.fair_prediction()?.worse_than_by_hand())),
        ("diagnosis_s", Arc::new(times.collect::<Float64Array>())),
    ]
}

fn numbers(all: impl Iterator<Item = Option<u64>>) -> ArrayRef {
    Arc::new(all.collect::<UInt64Array>())
}

fn texts(all: impl Iterator<Item = Option<String>>) -> ArrayRef {
    Arc::new(all.collect::<StringArray>())
}

fn answers(all: impl Iterator<Item = Option<bool>>) -> ArrayRef {
    Arc::new(all.collect::<BooleanArray>())
}
