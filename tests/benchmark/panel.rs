//! Judgements of answers that are made up, by sheets that are written down here.

use benchmark::{
    AlarmLedger, Fraction, HeldOut, Judgement, MergedPanel, PANEL_SCHEMA, PanelRow, PanelTally,
    Rate, Record, Share, TextTable,
};
use catalogue::EffectKind::{Backlash, CoulombFriction, Payload, TorqueOffset, ViscousFriction};
use diagnosis::{EffectAt, Estimate, Finding, Verdict};
use population::{FieldFeature, Knowledge, MotionClass, Strength, TruthSheet};
use report::Provenance;

use crate::made_up::{FAINT, SEEN, answers, at, finding, sheet, stranger};

fn judge(sheet: &TruthSheet, verdict: Verdict, findings: Vec<Finding>) -> Judgement {
    Judgement::new(sheet, &answers(verdict, findings))
}

fn part(fraction: Fraction) -> (f64, f64) {
    (fraction.hits, fraction.of)
}

#[test]
fn findings_that_are_there_however_small_are_true_and_only_visible_causes_are_asked_for() {
    let sheet = sheet(&[
        (CoulombFriction, "elbow", SEEN),
        (Backlash, "elbow", Strength { torque: 0.1, ..SEEN }),
        (ViscousFriction, "shoulder", FAINT),
    ]);
    let findings = vec![
        finding(at(CoulombFriction, "elbow"), 0.6, &[]),
        finding(at(ViscousFriction, "shoulder"), 0.1, &[]),
        finding(at(TorqueOffset, "elbow"), 0.3, &[]),
    ];
    let one = judge(&sheet, Verdict::Explained, findings);
    assert_eq!(part(one.precision().unwrap()), (2.0, 3.0));
    assert_eq!(part(one.recall()), (1.0, 2.0));
    let (hits, of) = part(one.precision_by_torque().unwrap());
    assert!((hits - 0.7).abs() < 1e-12 && (of - 1.0).abs() < 1e-12);
    let (hits, of) = part(one.recall_by_torque());
    assert!((hits - 0.4).abs() < 1e-12 && (of - 0.5).abs() < 1e-12);
    assert_eq!(
        (one.right(), one.false_assurance(), one.false_alarm()),
        (Some(false), Some(true), None)
    );
    // The largest share is the first.
    assert_eq!(one.findings[1].at, at(TorqueOffset, "elbow"));
    assert!(!one.findings[1].is_true && one.findings[2].is_true);
}

#[test]
fn a_true_rival_and_a_rival_of_a_true_finding_are_no_false_names() {
    let sheet = sheet(&[(CoulombFriction, "elbow", SEEN)]);
    let says_it = finding(at(ViscousFriction, "elbow"), 0.5, &[at(CoulombFriction, "elbow")]);
    let one = judge(&sheet, Verdict::Explained, vec![says_it]);
    assert_eq!(part(one.precision().unwrap()), (1.0, 1.0));
    assert_eq!((one.causes[0].finding, one.causes[0].one_of), (None, Some(0)));
    assert_eq!((one.right(), one.false_assurance()), (Some(true), Some(false)));

    let true_one = finding(at(CoulombFriction, "elbow"), 0.5, &[at(ViscousFriction, "elbow")]);
    let rival = finding(at(ViscousFriction, "elbow"), 0.3, &[]);
    let other = finding(at(ViscousFriction, "shoulder"), 0.1, &[]);
    let one = judge(&sheet, Verdict::Explained, vec![true_one, rival, other]);
    assert_eq!(one.findings.iter().map(|f| f.is_true).collect::<Vec<_>>(), [true, true, false]);
}

#[test]
fn false_assurance_is_a_good_verdict_about_what_is_hidden() {
    let causes = [(CoulombFriction, "elbow", SEEN)];
    let named = || vec![finding(at(CoulombFriction, "elbow"), 0.5, &[])];
    let hiding = sheet(&causes);
    let with_stranger = TruthSheet { strangers: vec![stranger(SEEN)], ..sheet(&causes) };
    let with_faint_one = TruthSheet { strangers: vec![stranger(FAINT)], ..sheet(&causes) };
    let clean = sheet(&[(CoulombFriction, "elbow", FAINT)]);
    let assured =
        |sheet: &TruthSheet, verdict, findings| judge(sheet, verdict, findings).false_assurance();
    assert_eq!(assured(&hiding, Verdict::Consistent, Vec::new()), Some(true));
    assert_eq!(assured(&hiding, Verdict::Consistent, named()), Some(true));
    assert_eq!(assured(&hiding, Verdict::Explained, named()), Some(false));
    assert_eq!(assured(&hiding, Verdict::PartlyExplained, Vec::new()), Some(false));
    assert_eq!(assured(&hiding, Verdict::DataInadequate, Vec::new()), Some(false));
    assert_eq!(assured(&with_stranger, Verdict::Explained, named()), Some(true));
    assert_eq!(assured(&with_stranger, Verdict::PartlyExplained, named()), Some(false));
    assert_eq!(assured(&with_faint_one, Verdict::Explained, named()), Some(false));
    assert_eq!(assured(&clean, Verdict::Consistent, Vec::new()), None);
}

#[test]
fn a_false_alarm_is_a_name_or_an_open_verdict_where_nothing_is() {
    let clean = sheet(&[(CoulombFriction, "elbow", FAINT)]);
    let alarm = |verdict, findings| judge(&clean, verdict, findings).false_alarm();
    assert_eq!(alarm(Verdict::Consistent, Vec::new()), Some(false));
    assert_eq!(alarm(Verdict::DataInadequate, Vec::new()), Some(false));
    // What is there is no alarm, however faint.
    let faint = vec![finding(at(CoulombFriction, "elbow"), 0.5, &[])];
    assert_eq!(alarm(Verdict::Explained, faint), Some(false));
    let made_up = vec![finding(at(Backlash, "elbow"), 0.5, &[])];
    assert_eq!(alarm(Verdict::Explained, made_up), Some(true));
    assert_eq!(alarm(Verdict::Unexplained, Vec::new()), Some(true));
    let hiding = sheet(&[(CoulombFriction, "elbow", SEEN)]);
    assert_eq!(judge(&hiding, Verdict::Unexplained, Vec::new()).false_alarm(), None);
}

#[test]
fn of_recorded_logs_only_what_was_added_is_asked_for() {
    let other = || vec![finding(at(Backlash, "elbow"), 0.5, &[])];
    let added =
        TruthSheet { knowledge: Knowledge::Added, ..sheet(&[(CoulombFriction, "elbow", SEEN)]) };
    let one = judge(&added, Verdict::PartlyExplained, other());
    assert_eq!((one.precision(), part(one.recall())), (None, (0.0, 1.0)));
    assert_eq!((one.right(), one.false_alarm(), one.names_falsely()), (Some(false), None, false));
    let plain = TruthSheet { knowledge: Knowledge::None, ..sheet(&[]) };
    let one = judge(&plain, Verdict::Explained, other());
    assert_eq!((one.precision(), part(one.recall())), (None, (0.0, 0.0)));
    assert_eq!((one.right(), one.false_alarm(), one.false_assurance()), (None, None, None));
}

/// Errors of 3 of 10 N m and of 0.8 of 2 N m: sqrt((0.3^2 + 0.4^2) / 2).
#[test]
fn errors_are_those_of_joints_over_their_torque() {
    let held_out = |extended: Option<Vec<Option<f64>>>| {
        let mut said = answers(Verdict::Explained, Vec::new());
        said.held_out =
            HeldOut { nominal: Some(vec![Some(3.0), Some(0.8)]), extended, ..HeldOut::default() };
        Judgement::new(&sheet(&[]), &said).prediction
    };
    let half = held_out(Some(vec![Some(1.5), Some(0.4)]));
    let nominal = half.nominal.as_ref().unwrap();
    assert!((nominal.all - 0.125_f64.sqrt()).abs() < 1e-12);
    assert!((nominal.joints[0].unwrap() - 0.3).abs() < 1e-12);
    assert!((half.ratio(half.extended.as_ref()).unwrap() - 0.5).abs() < 1e-12);
    assert_eq!((half.worse(), half.ratio(half.least_squares.as_ref())), (Some(false), None));
    assert_eq!(held_out(Some(vec![Some(3.0 * 1.009), Some(0.8 * 1.009)])).worse(), Some(false));
    assert_eq!(held_out(Some(vec![Some(3.0 * 1.011), Some(0.8 * 1.011)])).worse(), Some(true));
    assert_eq!(
        held_out(Some(vec![Some(f64::NAN), Some(0.1)])).worse(),
        Some(true),
        "no prediction at all"
    );
    assert_eq!(held_out(None).worse(), None);

    // A joint without effort has no error to speak of.
    let mut said = answers(Verdict::Explained, Vec::new());
    said.held_out.nominal = Some(vec![Some(3.0), Some(0.8)]);
    let resting = TruthSheet { torque_rms: vec![10.0, 0.0], ..sheet(&[]) };
    let nominal = Judgement::new(&resting, &said).prediction.nominal.unwrap();
    assert!(nominal.joints[1].is_none() && (nominal.all - 0.3).abs() < 1e-12);
    // Nor has one that stands all along.
    said.held_out.nominal = Some(vec![Some(3.0), None]);
    assert_eq!(Judgement::new(&sheet(&[]), &said).prediction.nominal, Some(nominal));
}

#[test]
fn least_squares_is_asked_for_the_same_causes_and_has_no_rivals() {
    let sheet = sheet(&[(CoulombFriction, "elbow", SEEN), (TorqueOffset, "elbow", SEEN)]);
    let mut said = answers(Verdict::Consistent, Vec::new());
    let elbow: EffectAt = at(CoulombFriction, "elbow");
    said.least_squares = vec![elbow.clone(), at(ViscousFriction, "elbow"), elbow.clone()];
    let one = Judgement::new(&sheet, &said);
    assert_eq!(one.least_squares.iter().map(|c| c.is_true).collect::<Vec<_>>(), [true, false]);
    let tally = PanelTally::of(&[one]);
    let all = &tally.rows[0];
    let rates = [all.least_squares.precision, all.least_squares.recall, all.named.recall];
    assert_eq!(rates.map(|rate| rate.value), [0.5, 0.5, 0.0].map(Some));
    assert_eq!(all.named.precision.value, None);
}

#[test]
fn sizes_of_causes_that_a_finding_names_are_compared() {
    let mut sheet = sheet(&[(CoulombFriction, "elbow", SEEN)]);
    sheet.causes[0].truth.parameters.insert("level".to_owned(), 0.5);
    let ci95 = [0.5, 0.7];
    let level = Estimate {
        name: "level",
        value: 0.6,
        ci95,
        noise95: ci95,
        nominal: 0.0,
        unit: "N m",
        determined: true,
    };
    let mut named = finding(at(CoulombFriction, "elbow"), 0.6, &[]);
    named.parameters.push(level);
    let one = judge(&sheet, Verdict::Explained, vec![named]);
    let row = PanelTally::of(&[one]).kinds.remove(0);
    assert_eq!((row.kind.as_str(), row.visible), ("FR02 Coulomb friction", 1));
    assert!((row.sizes.median_error.unwrap() - 0.2).abs() < 1e-12);
    assert_eq!(row.sizes.covered, Share::new(1, 1));
}

/// Where every thing is a trial of its own, the interval is that of independent things with the variance
/// of n - 1 for n; where ten trials have ten equal things each, it is that of ten.
#[test]
fn things_of_one_trial_count_as_one_draw() {
    let single = |hit: bool| Fraction { hits: f64::from(u8::from(hit)), of: 1.0, items: 1 };
    let alone = Rate::over((0..10).map(|k| single(k < 6)));
    let ten = |hit: bool| Fraction { hits: 10.0 * f64::from(u8::from(hit)), of: 10.0, items: 10 };
    let together = Rate::over((0..10).map(|k| ten(k < 6)));
    assert_eq!((alone.value, together.value), (Some(0.6), Some(0.6)));
    let ends = alone.interval.unwrap().into_iter().zip(together.interval.unwrap());
    assert!(ends.into_iter().all(|(one, ten)| (one - ten).abs() < 1e-9));
    assert_eq!((alone.items, together.items, together.trials), (10, 100, 10));
    let [low, high] = alone.interval.unwrap();
    let [nine_low, nine_high] = Share::new(6, 10).interval.unwrap();
    assert!(low < nine_low && high > nine_high && high - low < 1.06 * (nine_high - nine_low));
    // Half of each trial: a trial more tells nothing new, and all things could be independent.
    let halves = Rate::over((0..10).map(|_| Fraction { hits: 5.0, of: 10.0, items: 10 }));
    assert_eq!(halves.interval, Share::new(5, 10).interval);
    // All of all trials: as sure as that many trials make it.
    let all = Rate::over((0..10).map(|_| ten(true)));
    assert_eq!(all.interval, Share::new(10, 10).interval);
    assert_eq!(Rate::over([Fraction::default()].into_iter()).words(), "-");
}

/// Four trials: two with friction, one of them named, one clean with an alarm, one with a stranger.
fn panel() -> Vec<Judgement> {
    let friction = sheet(&[(CoulombFriction, "elbow", SEEN)]);
    let mut sweep =
        judge(&friction, Verdict::Explained, vec![finding(at(CoulombFriction, "elbow"), 0.6, &[])]);
    sweep.costs.diagnosis_s = 90.0;
    let mut rest = judge(&friction, Verdict::Consistent, Vec::new());
    rest.corner.motion = MotionClass::PointToPoint;
    rest.corner.encoder_step = 0.0001;
    rest.corner.arm = "a recorded arm".to_owned();
    let mut alarm =
        judge(&sheet(&[]), Verdict::Explained, vec![finding(at(Payload, "elbow"), 0.6, &[])]);
    alarm.corner.logs = 4;
    let strange = TruthSheet { strangers: vec![stranger(SEEN)], ..sheet(&[]) };
    let strange = judge(&strange, Verdict::Unexplained, Vec::new());
    let all = [sweep, rest, alarm, strange].into_iter().enumerate();
    all.map(|(k, one)| Judgement { seed: k as u64, ..one }).collect()
}

fn row<'a>(tally: &'a PanelTally, side: &str) -> &'a PanelRow {
    tally.rows.iter().find(|row| row.side.to_string() == side).unwrap()
}

#[test]
fn a_trial_is_in_the_row_of_everything_that_it_has_of_robots_in_use() {
    let mut judgements = panel();
    judgements[0].corner.field = vec![FieldFeature::WrongMass, FieldFeature::StrongFriction];
    judgements[1].corner.field = vec![FieldFeature::StrongFriction];
    let tally = PanelTally::of(&judgements);
    let last = tally.rows.iter().rev().take(2).map(|row| (row.side.to_string(), row.trials));
    let expected =
        [("met with strong friction".to_owned(), 2), ("met with wrong mass".to_owned(), 1)];
    assert_eq!(last.collect::<Vec<_>>(), expected);
}

#[test]
fn a_tally_counts_every_trial_in_one_row_of_each_kind() {
    let tally = PanelTally::of(&panel());
    let sides: Vec<String> = tally.rows.iter().map(|row| row.side.to_string()).collect();
    let expected = [
        "all",
        "arm cobot",
        "arm a recorded arm",
        "logs are simulated",
        "motion point to point",
        "motion sweep",
        "effort current",
        "encoder coarse",
        "encoder fine",
        "visible causes 0",
        "visible causes 1",
        "logs 2-3",
        "logs 4+",
        "runs differ",
        "log usual",
        "goals of a controller",
    ];
    assert_eq!(sides, expected);
    let all = row(&tally, "all");
    assert_eq!(
        (all.trials, all.named.precision.value, all.named.recall.value),
        (4, Some(0.5), Some(0.5))
    );
    assert_eq!(all.false_assurance, Share::new(1, 3));
    assert_eq!(all.false_alarm, Share::new(1, 1));
    assert_eq!((all.median_s, all.nine_of_ten_s), (Some(2.0), Some(90.0)));
    assert_eq!(row(&tally, "encoder fine").false_assurance, Share::new(1, 1));
    assert_eq!(row(&tally, "logs 4+").false_alarm, Share::new(1, 1));
    let false_ones: Vec<(&str, usize)> =
        tally.kinds.iter().map(|row| (row.kind.as_str(), row.false_findings)).collect();
    assert_eq!(false_ones, [("FR02 Coulomb friction", 0), ("IN01 payload", 1), ("all", 1)]);
    let wall = &tally.strangers[0];
    assert_eq!(
        (wall.name.as_str(), wall.open, wall.misnamed),
        ("soft_wall", Share::new(1, 1), Share::new(0, 1))
    );
    assert_eq!((tally.slowest.len(), tally.slowest[0].seed), (4, 0));
    assert!((tally.slowest[0].samples - 7500.0).abs() < 1e-9);
}

#[test]
fn a_tally_is_the_same_in_any_order_and_its_tables_are_within_120_columns() {
    let mut judgements = panel();
    let tally = PanelTally::of(&judgements);
    judgements.reverse();
    assert_eq!(PanelTally::of(&judgements), tally);
    let mut many = Vec::new();
    for round in 0..500_u64 {
        many.extend(panel().into_iter().map(|one| Judgement { seed: u64::MAX >> 1, ..one }));
        many.last_mut().unwrap().costs.logs_s = 100.0 + round as f64;
    }
    let text = PanelTally::of(&many).text();
    let longest = text.lines().map(|line| line.chars().count()).max().unwrap();
    assert!(longest <= 120, "{longest}:\n{text}");
    let tables: Vec<TextTable> = tally.tables().to_vec();
    assert!(tables.iter().all(|t| t.rows.iter().all(|row| row.len() == t.header.len())));
}

/// All diagnoses over 60 s are listed, of the others as many as make ten.
#[test]
fn every_long_diagnosis_is_listed() {
    let one = panel().remove(1);
    let of = |seconds: f64| {
        let mut one = one.clone();
        one.costs.diagnosis_s = seconds;
        one
    };
    let long: Vec<Judgement> = (0..15).map(|k| of(if k < 12 { 61.0 } else { 5.0 })).collect();
    assert_eq!(PanelTally::of(&long).slowest.len(), 12);
    let short: Vec<Judgement> = (0..15).map(|_| of(5.0)).collect();
    assert_eq!(PanelTally::of(&short).slowest.len(), 10);
}

#[test]
fn a_judgement_is_read_back_as_it_was_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("records.parquet");
    let endless = Strength { sigmas: f64::INFINITY, ..SEEN };
    let sheet = sheet(&[(CoulombFriction, "elbow", endless)]);
    let mut said = answers(
        Verdict::PartlyExplained,
        vec![finding(at(CoulombFriction, "elbow"), 0.6, &[at(Backlash, "elbow")])],
    );
    said.held_out.nominal = Some(vec![Some(1.0), Some(2.0)]);
    said.least_squares = vec![at(Backlash, "elbow")];
    let judgement = Judgement::new(&sheet, &said);
    assert!(judgement.causes[0].visible());
    let record =
        |task, score| Record { task, hidden: None, seed: 7, campaign: "c".to_owned(), score };
    let records = [record(0, Ok(judgement.into())), record(1, Err("it ran away".to_owned()))];
    Record::write(&path, &records).unwrap();
    assert_eq!(Record::read(&path).unwrap(), records);
    assert!(records[0].judgement().is_some() && records[1].judgement().is_none());
}

#[test]
fn the_page_shows_every_corner_and_opens_without_scripts() {
    let merged = MergedPanel {
        schema: PANEL_SCHEMA,
        campaign: "0123456789abcdef".to_owned(),
        counts: Vec::new(),
        failures: Vec::new(),
        tally: PanelTally::of(&panel()),
        alarms: AlarmLedger::of(&panel()),
    };
    let provenance = Provenance {
        program: "plumbline",
        version: "0",
        command: vec!["plumbline".to_owned()],
        files: Vec::new(),
        seed: None,
    };
    let page = benchmark::panel_page(&merged, &[], &provenance).unwrap();
    assert!(
        !page.contains("http://")
            && !page.contains("https://")
            && page.matches("<script>").count() == 1
    );
    assert!(page.contains("default-src 'none'"));
    let shown: usize = merged
        .tally
        .rows
        .iter()
        .map(|row| {
            let rates = [row.named.precision.value, row.named.recall.value];
            rates.iter().flatten().count() + usize::from(row.false_assurance.of > 0)
        })
        .sum();
    assert_eq!(page.matches("<circle").count(), shown);
    for expected in [
        "50 % of findings are true, 50 % of visible causes are named; false assurance in 1 of 3",
        "encoder fine (1)</text>",
        "<title>encoder fine: false assurance 100 % 21-100</title>",
        "soft wall",
        "plumbline.panel/2",
    ] {
        assert!(page.contains(expected), "{expected} is missing");
    }
}
