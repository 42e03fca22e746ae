//! Two results of the same trials, by numbers that were worked out by hand.

use std::path::{Path, PathBuf};

use benchmark::{
    Judgement, Measure, PairedComparison, PairedMean, PairedShare, Record, TrialQuantity,
};
use catalogue::EffectKind::{Backlash, CoulombFriction};
use diagnosis::Verdict;
use population::TruthSheet;

use crate::made_up::{SEEN, answers, at, finding, sheet};

fn pairs(wins: usize, losses: usize, both: usize, neither: usize) -> Vec<(bool, bool)> {
    let of = |pair, count| std::iter::repeat_n(pair, count);
    let differ = of((false, true), wins).chain(of((true, false), losses));
    differ.chain(of((true, true), both)).chain(of((false, false), neither)).collect()
}

/// 2 (1 + 10 + 45) / 2^10, and the interval of 8 of 10 of Clopper & Pearson, 44.39 to 97.48 %.
#[test]
fn eight_wins_and_two_losses_are_no_proof() {
    let share = PairedShare::new(Measure::Right, &pairs(8, 2, 6, 4));
    assert_eq!((share.trials, share.wins, share.losses, share.ties()), (20, 8, 2, 10));
    assert_eq!((share.first, share.second), (8, 14));
    assert!((share.p - 112.0 / 1024.0).abs() < 1e-12);
    assert!((share.difference.unwrap() - 0.3).abs() < 1e-12);
    let [low, high] = share.interval.unwrap();
    assert!((low - (2.0 * 0.443_905 - 1.0) * 0.5).abs() < 1e-5, "{low}");
    assert!((high - (2.0 * 0.974_789 - 1.0) * 0.5).abs() < 1e-5, "{high}");
}

/// 2 / 2^6, and 1 - 0.025^(1/6) = 45.93 % at the least.
#[test]
fn six_wins_and_no_loss_are_significant() {
    let share = PairedShare::new(Measure::Right, &pairs(6, 0, 10, 0));
    assert!((share.p - 0.03125).abs() < 1e-12);
    let [low, high] = share.interval.unwrap();
    let least = 0.025_f64.powf(1.0 / 6.0);
    assert!((low - (2.0 * least - 1.0) * 6.0 / 16.0).abs() < 1e-9, "{low}");
    assert!((high - 6.0 / 16.0).abs() < 1e-12);
    assert!(low > 0.0);
}

#[test]
fn no_is_the_better_answer_to_a_false_alarm() {
    let share = PairedShare::new(Measure::FalseAlarm, &pairs(1, 4, 0, 5));
    assert_eq!((share.wins, share.losses), (4, 1));
    assert!(share.difference.unwrap() > 0.0);
    assert!((share.p - 12.0 / 32.0).abs() < 1e-12, "2 (1 + 5) / 2^5");
}

#[test]
fn trials_that_all_agree_say_nothing_of_a_difference() {
    let share = PairedShare::new(Measure::Right, &pairs(0, 0, 3, 2));
    assert_eq!((share.difference, share.interval), (Some(0.0), None));
    assert!((share.p - 1.0).abs() < 1e-12);
    assert_eq!(PairedShare::new(Measure::Right, &[]).difference, None);
}

/// Differences 1, 2 and 3: mean 2, deviation 1, t = 4.30265 with two degrees of freedom.
#[test]
fn a_mean_has_the_interval_of_student() {
    let mean =
        PairedMean::new(TrialQuantity::Recall, &[(0.0, 1.0), (1.0, 3.0), (2.0, 5.0)]).unwrap();
    assert!((mean.difference - 2.0).abs() < 1e-12 && (mean.first - 1.0).abs() < 1e-12);
    let [low, high] = mean.interval.unwrap();
    let half = 4.302_653 / 3.0_f64.sqrt();
    assert!((low - (2.0 - half)).abs() < 1e-5 && (high - (2.0 + half)).abs() < 1e-5);
    assert_eq!(PairedMean::new(TrialQuantity::Recall, &[(0.0, 1.0)]).unwrap().interval, None);
    assert!(PairedMean::new(TrialQuantity::Recall, &[]).is_none());
}

#[test]
fn times_are_compared_as_factors() {
    let pairs = [(1.0_f64.ln(), 2.0_f64.ln()), (3.0_f64.ln(), 6.0_f64.ln())];
    let mean = PairedMean::new(TrialQuantity::Time, &pairs).unwrap();
    assert!((mean.difference - 2.0).abs() < 1e-12);
    assert!((mean.first - 3.0_f64.sqrt()).abs() < 1e-12);
    assert!(mean.interval.unwrap().iter().all(|end| (end - 2.0).abs() < 1e-9));
}

/// A trial with Coulomb friction at the elbow that is named, or not, in so many seconds.
#[allow(clippy::fn_params_excessive_bools, reason = "a made-up trial is named or not")]
fn trial(task: usize, named: bool, seconds: f64) -> Record {
    let sheet =
        TruthSheet { seed: 100 + task as u64, ..sheet(&[(CoulombFriction, "elbow", SEEN)]) };
    let effect = if named { CoulombFriction } else { Backlash };
    let mut said = answers(Verdict::Explained, vec![finding(at(effect, "elbow"), 0.5, &[])]);
    said.costs.diagnosis_s = seconds;
    said.held_out.nominal = Some(vec![Some(1.0), Some(1.0)]);
    said.held_out.extended = Some(if named { vec![Some(0.5); 2] } else { vec![Some(2.0); 2] });
    let judgement = Judgement::new(&sheet, &said);
    Record {
        task,
        hidden: None,
        seed: sheet.seed,
        campaign: "0123456789".to_owned(),
        score: Ok(judgement.into()),
    }
}

fn table(folder: &Path, name: &str, records: &[Record]) -> PathBuf {
    let path = folder.join(name);
    Record::write(&path, records).unwrap();
    path
}

#[test]
fn two_tables_are_compared_trial_by_trial() {
    let folder = tempfile::tempdir().unwrap();
    let first = [(0, true), (1, false), (2, false), (3, true), (9, true)];
    let first =
        table(folder.path(), "a.parquet", &first.map(|(task, named)| trial(task, named, 1.0)));
    let second = [(3, false), (1, true), (2, true), (0, true)];
    let mut second = second.map(|(task, named)| trial(task, named, 3.0)).to_vec();
    // A seed of its own pairs with none, and what failed is not right.
    second.push(Record { seed: 5, ..trial(9, true, 3.0) });
    second[3].score = Err("it gave up".to_owned());
    let second = table(folder.path(), "b.parquet", &second);
    let compared = PairedComparison::read(&first, &second).unwrap();
    assert_eq!((compared.pairs, compared.alone, compared.failed), (4, [1, 1], [0, 1]));
    let of = |measure| *compared.shares.iter().find(|share| share.measure == measure).unwrap();
    let right = of(Measure::Right);
    assert_eq!((right.trials, right.wins, right.losses), (4, 2, 2));
    let assured = of(Measure::FalseAssurance);
    assert_eq!((assured.trials, assured.wins, assured.losses), (3, 2, 1));
    let worse = of(Measure::WorsePrediction);
    assert_eq!((worse.first, worse.second, worse.wins, worse.losses), (2, 1, 2, 1));
    assert!(!compared.shares.iter().any(|share| share.measure == Measure::FalseAlarm));
    let time = compared.means.iter().find(|mean| mean.quantity == TrialQuantity::Time).unwrap();
    assert!((time.difference - 3.0).abs() < 1e-9);
    let tasks: Vec<usize> = compared.turned.iter().map(|turned| turned.task).collect();
    assert_eq!(tasks, [0, 1, 2, 3]);
    let words = "task 1, seed 101 (cobot, sweep): better: right, false assurance, worse prediction";
    assert_eq!(compared.turned[1].words(), words);
    let text = compared.text();
    assert!(text.contains("4 trials of campaign 01234567 in both\n"), "{text}");
    assert!(text.contains("1 failed in the second, which is not right\n"), "{text}");
    assert!(text.lines().all(|line| line.chars().count() <= 120), "{text}");
    assert!(text.ends_with("worse: right, false assurance, worse prediction\n"), "{text}");
}

#[test]
fn what_cannot_be_compared_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let a = table(path, "a.parquet", &[trial(0, true, 1.0)]);
    let b = table(path, "b.parquet", &[trial(1, true, 1.0)]);
    let other = Record { campaign: "abcdefghij".to_owned(), ..trial(0, true, 1.0) };
    let c = table(path, "c.parquet", std::slice::from_ref(&other));
    let d = table(path, "d.parquet", &[trial(0, true, 1.0), Record { task: 1, ..other }]);
    let e = table(path, "e.parquet", &[trial(0, true, 1.0), trial(0, true, 2.0)]);
    let refused = |a: &Path, b: &Path| PairedComparison::read(a, b).unwrap_err().to_string();
    for (second, expected) in [
        (&b, "they have no trial in common"),
        (&c, "its trials are of another campaign (abcdefgh)"),
        (&d, "it holds trials of two campaigns"),
        (&e, "it holds task 0 twice"),
        (&path.join("none.parquet"), "trials.parquet of a campaign was expected"),
    ] {
        let said = refused(&a, second);
        assert!(said.contains(expected), "{expected} is missing in {said}");
    }
    assert!(refused(path, &a).contains("no campaign was planned here"));
}
