//! CauseBench: answers made by hand score what closed forms say, and hostile ones count as nothing said.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use benchmark::{
    BenchBoard, BenchLog, BenchManifest, BenchScores, BenchSet, BenchTrial, BenchTruth,
    MANIFEST_SCHEMA, ScoreRow, TrialTruth,
};
use catalogue::EffectKind as E;
use population::{Strength, TruthSheet};

use crate::made_up::{FAINT, SEEN, sheet, stranger};

/// Number of rows of a held-out log.
const ROWS: usize = 8;

/// A set of made-up trials, its truth and an empty folder of answers.
struct MadeUpSet {
    folder: tempfile::TempDir,
}

impl MadeUpSet {
    fn new(sheets: Vec<TruthSheet>) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let named = (1..).map(|k| format!("trial_{k}")).zip(sheets);
        let truths: BTreeMap<String, TrialTruth> =
            named.map(|(name, sheet)| (name, truth_of(sheet))).collect();
        let truth = folder.path().join("truth");
        let trials = truths.keys().map(|name| trial(name)).collect();
        let (text, truth_sha256) = BenchTruth::new(truths).seal(&truth).unwrap();
        fs::write(&truth, text).unwrap();
        let schema = MANIFEST_SCHEMA.to_owned();
        let manifest = BenchManifest { schema, set: BenchSet::Smoke, truth_sha256, trials };
        let text = serde_json::to_string(&manifest).unwrap();
        fs::write(folder.path().join(BenchManifest::FILE), text).unwrap();
        fs::create_dir(folder.path().join("somebody")).unwrap();
        Self { folder }
    }

    /// Two trials: one with two visible causes and a faint one, one with nothing.
    fn usual() -> Self {
        let causes = [
            (E::CoulombFriction, "elbow", SEEN),
            (E::ViscousFriction, "shoulder", SEEN),
            (E::RotorInertia, "elbow", FAINT),
        ];
        let mut with_sizes = sheet(&causes);
        with_sizes.causes[0].truth.parameters = [("level".to_owned(), 2.0)].into();
        with_sizes.causes[1].truth.parameters = [("viscous".to_owned(), 3.0)].into();
        Self::new(vec![with_sizes, sheet(&[])])
    }

    fn answers(&self) -> PathBuf {
        self.folder.path().join("somebody")
    }

    fn say(&self, trial: usize, answer: &str) {
        fs::write(self.answers().join(format!("trial_{trial}.json")), answer).unwrap();
    }

    /// Predicts every effort of a trial as its true one times a factor.
    fn predict(&self, file: &str, factor: f64) {
        let mut text = "time,shoulder.effort,elbow.effort\n".to_owned();
        for k in 0..ROWS {
            // A joint that stands in the last row may hold anything there.
            let factor = if k + 1 == ROWS { 100.0 } else { factor };
            let [a, b] = ["shoulder", "elbow"].map(|j| factor * f64::from(efforts()[j][k]));
            text += &format!("{},{a},{b}\n", 0.1 * k as f64);
        }
        fs::write(self.answers().join(file), text).unwrap();
    }

    fn score(&self) -> BenchScores {
        let truth = self.folder.path().join("truth");
        BenchScores::new(self.folder.path(), &self.answers(), &truth, None).unwrap()
    }

    fn all(&self) -> ScoreRow {
        let scores = self.score();
        assert_eq!(scores.faults, Vec::<String>::new());
        scores.rows[0].clone()
    }
}

/// Efforts of the held-out log of an arm with a shoulder and an elbow.
fn efforts() -> BTreeMap<String, Vec<f32>> {
    let of = |joint: &str, size: f32| {
        (joint.to_owned(), (0..ROWS).map(|k| size * (k as f32 - 3.0)).collect())
    };
    [of("shoulder", 5.0), of("elbow", 1.0)].into()
}

/// The truth of a trial whose joints move in all rows but the last.
fn truth_of(sheet: TruthSheet) -> TrialTruth {
    let moving = ["shoulder", "elbow"].map(|joint| (joint.to_owned(), vec![[0, 3], [3, ROWS - 1]]));
    TrialTruth { sheet, held_out_effort: efforts(), moving: moving.into() }
}

fn trial(name: &str) -> BenchTrial {
    let log = BenchLog {
        parquet: String::new(),
        npz: String::new(),
        rows: ROWS,
        rate_hz: Some(10.0),
        channels: vec!["position".to_owned()],
    };
    let both = |a: &str, b: &str| vec![a.to_owned(), b.to_owned()];
    BenchTrial {
        name: name.to_owned(),
        urdf: String::new(),
        mjcf: String::new(),
        description: String::new(),
        joints: both("shoulder", "elbow"),
        links: both("upper", "fore"),
        effort_source: both("current", "current"),
        logs: vec![log.clone()],
        held_out: log,
    }
}

fn close(found: Option<f64>, expected: f64) {
    assert!(found.is_some_and(|found| (found - expected).abs() < 1e-6), "{found:?}, {expected}");
}

const RIGHT: &str = r#"{"names": [
    {"effect": "FR02", "joint": "elbow", "sizes": [{"parameter": "level", "value": 2.1, "interval": [1.9, 2.3]}]},
    {"effect": "viscous_friction", "joint": "shoulder",
     "sizes": [{"parameter": "viscous", "value": 3.6, "interval": [3.4, 3.8], "described": 0.5}]}],
    "prediction": "p.csv", "seconds": 4}"#;

#[test]
fn an_answer_that_is_all_right_has_every_number_at_its_best() {
    let set = MadeUpSet::usual();
    set.say(1, RIGHT);
    set.say(2, r#"{"prediction": "p.csv"}"#);
    set.predict("p.csv", 1.0);
    let all = set.all();
    close(all.name.value, 1.0);
    close(all.true_names.value, 1.0);
    close(all.named.value, 1.0);
    // 3.6 of the arm are 3.1 beyond the description, and 2.9 to 3.3 hold the 3 that were hidden.
    close(all.size.value, 1.0);
    assert_eq!(all.size.items, 2);
    close(all.sharpness.value, 0.5 * (0.4 / 2.1 + 0.4 / 3.6));
    close(all.predict.value, 0.0);
    close(all.abstain.value, 1.0);
    close(all.cost_s.value, 4.0);
}

#[test]
fn an_answer_that_is_all_wrong_has_every_number_at_its_worst() {
    let set = MadeUpSet::usual();
    let wrong = r#"{"names": [{"effect": "backlash", "joint": "elbow"}], "prediction": "p.csv"}"#;
    set.say(1, wrong);
    set.say(2, wrong);
    set.predict("p.csv", -1.0);
    let all = set.all();
    close(all.name.value, 0.0);
    assert_eq!(all.size.value, None);
    // (-e - e)^2 / e^2
    close(all.predict.value, 4.0);
    close(all.abstain.value, 0.0);
}

#[test]
fn half_an_answer_scores_half() {
    let set = MadeUpSet::usual();
    set.say(
        1,
        r#"{"names": [{"effect": "FR02", "joint": "elbow", "sizes":
            [{"parameter": "level", "value": 3, "interval": [2.5, 3.5]}]},
            {"effect": "payload", "link": "fore"}], "prediction": "p.csv"}"#,
    );
    set.say(2, r#"{"prediction": "p.csv"}"#);
    set.predict("p.csv", 0.5);
    let all = set.all();
    // One true name of two, one named cause of two: (1 + 1) / (2 + 2).
    close(all.name.value, 0.5);
    close(all.size.value, 0.0);
    close(all.predict.value, 0.25);
    close(all.abstain.value, 1.0);
}

#[test]
fn a_faint_cause_makes_a_name_true_and_is_no_gap() {
    let set = MadeUpSet::usual();
    set.say(1, r#"{"names": [{"effect": "IN03", "joint": "elbow"}]}"#);
    set.say(2, "{}");
    let all = set.all();
    close(all.true_names.value, 1.0);
    close(all.named.value, 0.0);
    close(all.name.value, 1.0 / 3.0);
}

#[test]
fn a_name_with_many_rivals_stands_for_one_cause() {
    let set = MadeUpSet::usual();
    set.say(
        1,
        r#"{"names": [{"effect": "backlash", "joint": "elbow", "rivals": [
            {"effect": "IN03", "joint": "elbow"}, {"effect": "FR02", "joint": "elbow"},
            {"effect": "FR01", "joint": "shoulder"}]}]}"#,
    );
    set.say(2, "{}");
    let all = set.all();
    close(all.true_names.value, 1.0);
    // The visible one of its rivals comes before the faint one.
    close(all.named.value, 0.5);
    close(all.name.value, 2.0 / 3.0);
}

#[test]
fn what_is_not_said_is_a_fault_and_scores_as_silence() {
    let set = MadeUpSet::usual();
    let scores = set.score();
    assert_eq!(scores.faults.len(), 2);
    let silent = scores.rows[0].clone();
    close(silent.name.value, 0.0);
    close(silent.predict.value, 1.0);
    // Nothing is to be said of the trial in which nothing is visible.
    close(silent.abstain.value, 1.0);
    set.say(1, "{}");
    set.say(2, "{}");
    let all = set.all();
    assert_eq!((all.name, all.predict, all.abstain), (silent.name, silent.predict, silent.abstain));
}

#[test]
fn a_stranger_is_to_be_left_open_without_a_false_name() {
    let hidden =
        |strength: Strength| TruthSheet { strangers: vec![stranger(strength)], ..sheet(&[]) };
    let set = MadeUpSet::new(vec![hidden(SEEN), hidden(FAINT)]);
    set.say(1, r#"{"left_open": true}"#);
    set.say(2, r#"{"left_open": true}"#);
    // Rightly of the visible one, an alarm at the other.
    close(set.all().abstain.value, 0.5);
    set.say(1, r#"{"refused": true}"#);
    set.say(2, "{}");
    close(set.all().abstain.value, 1.0);
    set.say(1, r#"{"left_open": true, "names": [{"effect": "backlash", "joint": "elbow"}]}"#);
    close(set.all().abstain.value, 0.5);
}

#[test]
fn a_wrong_answer_is_told_and_counts_as_nothing_said() {
    let many = |n: usize| {
        let names: Vec<String> = (0..n).map(|_| r#"{"effect": "FR02"}"#.to_owned()).collect();
        format!(r#"{{"names": [{}]}}"#, names.join(","))
    };
    let hostile = [
        ("", "EOF while parsing"),
        ("[]", "the answer to a trial as JSON was expected"),
        (&format!(r#"{{"names": {}"#, "[".repeat(100_000)), "recursion limit exceeded"),
        (&format!(r#"{{"names": [{}"#, " ".repeat(2 << 20)), "bytes"),
        (r#"{"name": []}"#, "unknown field `name`"),
        (
            r#"{"names": [{"effect": "FR02", "joint": "elbw"}]}"#,
            "names[0].joint: \"elbw\" was found, one of shoulder, elbow",
        ),
        (r#"{"names": [{"effect": "FR02", "link": "elbow"}]}"#, "one of upper, fore"),
        (r#"{"names": [{"effect": "friction"}]}"#, "names[0].effect: \"friction\""),
        (r#"{"names": [{"effect": "FR02"}, {"effect": "coulomb_friction"}]}"#, "each cause once"),
        (&many(201), "names: a list of 201 was found, 200 at most"),
        (
            r#"{"names": [{"effect": "FR02", "sizes": [{"parameter": "size", "value": 1, "interval": [0, 1]}]}]}"#,
            "names[0].sizes[0].parameter: \"size\" was found, one of level",
        ),
        (
            r#"{"names": [{"effect": "FR02", "sizes": [{"parameter": "level", "value": 1, "interval": [2, 1]}]}]}"#,
            "the lower end first",
        ),
        (
            r#"{"names": [{"effect": "FR02", "sizes": [{"parameter": "level", "value": 1e999, "interval": [0, 1]}]}]}"#,
            "number out of range",
        ),
        (r#"{"seconds": -1}"#, "seconds: -1"),
        (r#"{"prediction": "../truth"}"#, "the name of a file beside the answer"),
        (r#"{"prediction": "/etc/passwd"}"#, "the name of a file beside the answer"),
        (r#"{"model": ".."}"#, "the name of a file beside the answer"),
        (r#"{"prediction": "absent.npz"}"#, "prediction: \"absent.npz\""),
    ];
    for (answer, words) in hostile {
        let set = MadeUpSet::usual();
        set.say(1, answer);
        set.say(2, "{}");
        let scores = set.score();
        assert_eq!(scores.faults.len(), 1, "{words}");
        let fault = &scores.faults[0];
        assert!(fault.contains(words) && fault.contains("trial_1.json: "), "{fault}");
        assert!(fault.len() < 600 && !fault.contains('\n'), "{fault}");
        close(scores.rows[0].name.value, 0.0);
        close(scores.rows[0].predict.value, 1.0);
    }
}

#[test]
fn a_prediction_of_other_rows_counts_as_none_and_its_names_still_count() {
    let tables = [
        ("time,shoulder.effort\n0,1\n0.1,2\n", "elbow.effort"),
        (
            "time,shoulder.effort,elbow.effort\n0,1,1\n0.1,2,2\n",
            "2 rows was found, 8 finite numbers",
        ),
        ("nonsense", "p.csv"),
    ];
    for (table, words) in tables {
        let set = MadeUpSet::usual();
        set.say(1, RIGHT);
        set.say(2, "{}");
        fs::write(set.answers().join("p.csv"), table).unwrap();
        let scores = set.score();
        assert_eq!(scores.faults.len(), 1);
        assert!(scores.faults[0].contains(words), "{}", scores.faults[0]);
        close(scores.rows[0].name.value, 1.0);
        close(scores.rows[0].predict.value, 1.0);
    }
}

#[test]
fn the_truth_of_another_set_is_refused() {
    let set = MadeUpSet::usual();
    let truth = set.folder.path().join("truth");
    let text = fs::read_to_string(&truth).unwrap().replace("elbow", "wrist");
    fs::write(&truth, text).unwrap();
    let score = |truth: &Path| {
        BenchScores::new(set.folder.path(), &set.answers(), truth, None).unwrap_err().to_string()
    };
    let told = score(&truth);
    assert!(told.contains("SHA-256") && told.contains("sealed with was expected"), "{told}");
    assert!(score(&set.folder.path().join("none")).contains("the truth of a set"));
}

#[test]
fn drifts_are_medians_over_the_trials_that_have_one() {
    let set = MadeUpSet::new(vec![sheet(&[]), sheet(&[]), sheet(&[])]);
    (1..=3).for_each(|trial| set.say(trial, "{}"));
    let [truth, drifts] = ["truth", "drifts"].map(|name| set.folder.path().join(name));
    let score = |text: &str| {
        fs::write(&drifts, text).unwrap();
        BenchScores::new(set.folder.path(), &set.answers(), &truth, Some(&drifts))
    };
    let both = r#"{"trials": {"trial_1": [0.01, 0.1, 0.5], "trial_2": [0.03, 0.3, 1.5], "other": [9, 9, 9]}}"#;
    let all = score(both).unwrap().rows[0].clone();
    [0.02, 0.2, 1.0].iter().zip(&all.replay).for_each(|(drift, found)| close(found.value, *drift));
    // Of three trials the median is no mean.
    let three = r#"{"trials": {"trial_1": [0.01, 0.1, 0.5], "trial_2": [0.03, 0.3, 1.5], "trial_3": [0.2, 2, 9]}}"#;
    let all = score(three).unwrap().rows[0].clone();
    [0.03, 0.3, 1.5].iter().zip(&all.replay).for_each(|(drift, found)| close(found.value, *drift));
    let one = score(r#"{"trials": {"trial_2": [0.03, 0.3, 1.5]}}"#).unwrap().rows[0].clone();
    close(one.replay[2].value, 1.5);
    assert_eq!(one.replay[2].of, 1);
    for wrong in [r#"{"trials": {"trial_1": [0.01, 0.1]}}"#, r#"{"drifts": {}}"#, ""] {
        let told = score(wrong).unwrap_err().to_string();
        assert!(told.contains("drifts as replay_answers.py writes them"), "{told}");
    }
}

#[test]
fn the_page_has_a_table_a_set_and_tells_where_a_peer_is_better() {
    let set = MadeUpSet::usual();
    set.say(2, "{}");
    set.say(1, r#"{"names": [{"effect": "backlash", "joint": "elbow"}]}"#);
    let wrong = set.score();
    set.say(1, RIGHT);
    set.predict("p.csv", 1.0);
    let right = set.score();
    let called = |scores: &BenchScores, entrant: &str, set| BenchScores {
        entrant: entrant.to_owned(),
        set,
        program: Some(format!("{entrant} | 1.0")),
        ..scores.clone()
    };
    let page = BenchBoard::new(vec![
        called(&wrong, "a_peer", BenchSet::Core),
        called(&right, "a_peer", BenchSet::Smoke),
        called(&right, "plumbline", BenchSet::Core),
        called(&wrong, "plumbline", BenchSet::Smoke),
    ])
    .page();
    let [smoke, core] =
        ["`smoke`, the first 2 of 12 trials:", "`core`, the first 2 of 120 trials:"]
            .map(|set| page.find(set).unwrap());
    assert!(smoke < core);
    let f1 = |best: &str, own: &str| format!("| name: F1 | {best} | {own} |");
    let words = [&right, &wrong].map(|scores| scores.rows[0].name.words());
    let [bold, plain] = [format!("**{}**", words[0]), words[1].clone()];
    assert!(page[smoke..core].contains(&f1(&plain, &bold)), "{page}");
    assert!(page[core..].contains(&f1(&bold, &plain)), "{page}");
    let behind = format!("- name: F1: a peer {}; Plumbline {}\n", words[0], words[1]);
    assert!(page[smoke..core].contains(&behind) && !page[core..].contains(&behind), "{page}");
    assert!(page[core..].contains("- in none of the tasks\n"), "{page}");
    // Nobody has a drift, so that no row asks for it, and words of others end no cell.
    assert!(!page.contains("| replay: 50 ms |"), "{page}");
    assert!(page.contains("| a peer | a peer / 1.0 | 4.00 | - |"), "{page}");
}
