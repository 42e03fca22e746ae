//! The ledger of false alarms: what is planted in judgements that are made up is counted, and nothing else.

use benchmark::{AlarmLedger, AlarmRow, Judgement};
use catalogue::EffectKind::{CoulombFriction, TorqueConstant, ViscousFriction};
use diagnosis::{Finding, Verdict};
use population::{Corner, EffortClass, Origin, TruthSheet};

use crate::made_up::{SEEN, answers, at, corner, finding, sheet};

/// A trial of a seed at a rate, with what was said of it.
fn judged(seed: u64, rate_hz: f64, verdict: Verdict, findings: Vec<Finding>) -> Judgement {
    let corner = Corner { rate_hz, ..corner() };
    let sheet = TruthSheet { seed, corner, ..sheet(&[]) };
    Judgement::new(&sheet, &answers(verdict, findings))
}

fn false_name() -> Vec<Finding> {
    vec![finding(at(TorqueConstant, "elbow"), 0.6, &[])]
}

fn planted() -> Vec<Judgement> {
    let hides = TruthSheet { seed: 9, ..sheet(&[(CoulombFriction, "elbow", SEEN)]) };
    let mut refused = judged(5, 20.0, Verdict::DataInadequate, Vec::new());
    refused.refused = Some("it has no time".to_owned());
    let mut other = judged(3, 250.0, Verdict::Unexplained, Vec::new());
    other.corner.origin = Origin::AnotherEngine;
    vec![
        judged(1, 250.0, Verdict::Consistent, Vec::new()),
        judged(2, 20.0, Verdict::Explained, false_name()),
        other,
        judged(4, 20.0, Verdict::PartlyExplained, false_name()),
        refused,
        // What is there is no false alarm, whatever is said of it.
        Judgement::new(&hides, &answers(Verdict::Unexplained, false_name())),
    ]
}

fn row<'a>(rows: &'a [AlarmRow], logs: &str) -> &'a AlarmRow {
    rows.iter().find(|row| row.logs == logs).unwrap()
}

fn counts(row: &AlarmRow) -> [usize; 5] {
    let AlarmRow { alarms, named, unexplained, refused, .. } = row;
    [alarms.of, alarms.count, named.count, unexplained.count, refused.count]
}

#[test]
fn planted_alarms_are_counted_by_corner_and_true_causes_are_none() {
    let ledger = AlarmLedger::of(&planted());
    assert_eq!(counts(row(&ledger.rows, "all")), [5, 3, 2, 2, 1]);
    assert_eq!(counts(row(&ledger.rows, "rate 20 Hz")), [3, 2, 2, 1, 1]);
    assert_eq!(counts(row(&ledger.rows, "rate 250 Hz")), [2, 1, 0, 1, 0]);
    assert_eq!(counts(row(&ledger.rows, "made by another engine")), [1, 1, 0, 1, 0]);
    assert_eq!(counts(row(&ledger.rows, "made by the simulator")), [4, 2, 2, 1, 1]);
    // log2(2 pi / 0.001) = 12.6
    assert_eq!(counts(row(&ledger.rows, "encoder 13 bits")), [5, 3, 2, 2, 1]);
    assert_eq!(counts(row(&ledger.pairs, "rate 20 Hz, effort current")), [3, 2, 2, 1, 1]);
    let corner = "arm cobot, rate 250 Hz, encoder 13 bits, effort current";
    assert_eq!(counts(row(&ledger.corners, corner)), [2, 1, 0, 1, 0]);
    let names: Vec<usize> = ledger.names.iter().map(|name| name.trials).collect();
    assert_eq!(names, [2]);
    let seeds: Vec<u64> = ledger.alarms.iter().map(|alarm| alarm.seed).collect();
    assert_eq!(seeds, [2, 3, 4]);
    assert!(ledger.alarms[0].names[0].contains("elbow") && ledger.alarms[1].names.is_empty());
}

#[test]
fn every_property_has_each_clean_log_once() {
    let mut all = planted();
    all[0].corner.effort = EffortClass::JointTorque;
    let ledger = AlarmLedger::of(&all);
    for thing in ["made by", "motion", "arm", "rate", "encoder", "effort"] {
        let own = ledger.rows.iter().filter(|row| row.logs.starts_with(thing));
        assert_eq!(own.map(|row| row.alarms.of).sum::<usize>(), 5, "{thing}");
    }
    assert_eq!(ledger.pairs.iter().map(|row| row.alarms.of).sum::<usize>(), 6 * 5);
    assert_eq!(ledger.corners.iter().map(|row| row.alarms.of).sum::<usize>(), 5);
}

#[test]
fn the_ledger_is_the_same_whatever_the_order_of_the_trials() {
    let mut turned = planted();
    turned.reverse();
    let [one, other] = [planted(), turned].map(|all| AlarmLedger::of(&all));
    assert_eq!(one.text(), other.text());
    assert_eq!(serde_json::to_string(&one).unwrap(), serde_json::to_string(&other).unwrap());
    assert!(one.text().contains("the alarms") && one.text().contains("20 Hz 13 bits"));
}

#[test]
fn without_a_clean_log_there_is_no_ledger() {
    let hides = sheet(&[(ViscousFriction, "elbow", SEEN)]);
    let one = Judgement::new(&hides, &answers(Verdict::Unexplained, false_name()));
    assert_eq!(AlarmLedger::of(&[one]).text(), "");
    assert_eq!(AlarmLedger::of(&[]).text(), "");
}
