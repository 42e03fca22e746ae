//! Learning from a file that is read block by block, beside the same samples in memory.

use std::path::Path;

use dynamics::ColumnSet;
use gaussian_process::KernelSearch;
use learner::{
    LearnerError, Model, ModelKind, Regression, SampleFile, SampleSource, Samples, SilentTraining,
    Spread, TorqueModel, TrainSettings, Training,
};
use logs::Prepared;

use crate::arm;

/// Samples of the long record: three blocks of the reader, and a part of a fourth.
const SAMPLES: usize = 27_000;

/// Largest difference of a weight or a torque, as a share of the largest one. `(n m eps)` of sums in another order is 1e-10.
const AGREEMENT: f64 = 1e-10;

fn record(samples: usize) -> Prepared {
    arm::run(1.0, samples, 1.0)
}

fn settings() -> TrainSettings {
    let search = KernelSearch { starts: 1, start_points: 60, iterations: 20 };
    TrainSettings { points: 150, inducing_points: 40, search, ..TrainSettings::default() }
}

/// The samples in a file, written in stretches of a length of their own.
fn file(path: &Path, samples: &Samples) -> SampleFile {
    SampleFile::write(path, 2, |writer| {
        let all = samples.stretch();
        let pieces = all.q.chunks(1998).zip(all.qd.chunks(1998));
        let pieces = pieces.zip(all.qdd.chunks(1998).zip(all.tau.chunks(1998)));
        for ((q, qd), (qdd, tau)) in pieces {
            writer.add(learner::SampleSlices { q, qd, qdd, tau })?;
        }
        Ok(())
    })
    .unwrap()
}

/// The processes through inducing points, about nothing and about rigid bodies.
fn learned(source: &dyn SampleSource) -> Vec<Model> {
    let (robot, settings) = (arm::robot(), settings());
    let mut regression = Regression::new(&robot, ColumnSet::INERTIAL);
    regression.add_source(source).unwrap();
    let fit = regression.fit(None).unwrap();
    let mut training =
        Training::new(&robot, source, vec![0.01; 2], &settings, &SilentTraining).unwrap();
    training = training.with_regression(&fit);
    let kinds = [ModelKind::GpInducing, ModelKind::GpRbdInducing];
    kinds.map(|kind| training.fit(kind).unwrap().model).into()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, v| most.max(v.abs()))
}

fn assert_near(found: &[f64], expected: &[f64], what: &str) {
    let apart: Vec<f64> = found.iter().zip(expected).map(|(a, b)| a - b).collect();
    assert_eq!(found.len(), expected.len(), "{what}");
    assert!(largest(&apart) <= AGREEMENT * largest(expected), "{what}: {:e}", largest(&apart));
}

#[test]
fn what_is_learned_from_a_file_is_what_is_learned_from_memory() {
    let folder = tempfile::tempdir().unwrap();
    let samples = Samples::new(&record(SAMPLES));
    let streamed = file(&folder.path().join("samples.parquet"), &samples);
    assert_eq!((streamed.len(), streamed.joints()), (SAMPLES, 2));
    let unseen = Samples::new(&arm::run(2.0, 200, 1.0));
    for (found, expected) in learned(&streamed).iter().zip(&learned(&samples)) {
        let kind = expected.kind;
        let [found_process, process] = [found, expected].map(|m| m.process.as_ref().unwrap());
        assert_near(&found_process.sum.points(), &process.sum.points(), &format!("{kind} points"));
        for joint in 0..2 {
            let alpha = process.sum.alpha(joint);
            assert_near(&found_process.sum.alpha(joint), &alpha, &format!("{kind} weights"));
        }
        let Some(Spread::Inducing(posteriors)) = &process.spread else { unreachable!("{kind}") };
        assert!(posteriors.iter().all(|posterior| posterior.samples == SAMPLES), "{kind}");
        assert_near(&found.torque(&unseen), &expected.torque(&unseen), &format!("{kind} torque"));
    }
}

#[test]
fn a_record_that_is_four_times_as_long_takes_no_more_memory() {
    let folder = tempfile::tempdir().unwrap();
    let peak = |samples: usize| {
        let name = folder.path().join(format!("{samples}.parquet"));
        let streamed = file(&name, &Samples::new(&record(samples)));
        allocation_counter::measure(|| drop(learned(&streamed))).bytes_max
    };
    // The first learning of a process sets aside what the products of matrices work in.
    peak(1000);
    let [short, long] = [SAMPLES, 4 * SAMPLES].map(peak);
    println!("{short} bytes at {SAMPLES} samples, {long} at {}", 4 * SAMPLES);
    // In memory the long record is 4 signals of 2 joints in 8 bytes, 7 MB.
    let held = 4 * SAMPLES as u64 * 64;
    assert!(long < short + held / 50, "{long} after {short}, the record has {held}");
}

#[test]
fn what_is_no_file_of_samples_is_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("samples.parquet");
    let refused = |path: &Path| SampleFile::open(path).unwrap_err();
    assert!(matches!(refused(&path), LearnerError::NotSamples { .. }), "{}", refused(&path));
    let columns = |names: [&str; 4]| names.map(|name| (name.to_owned(), vec![1.0, 2.0]));
    logs::write_columns(&path, &columns(["q_1", "qd_1", "tau_1", "qdd_1"])).unwrap();
    let said = refused(&path).to_string();
    assert!(said.ends_with("column tau_1 was found, qdd_1 expected"), "{said}");
    std::fs::write(&path, "q_1,qd_1,qdd_1,tau_1\n1,2,3,4\n").unwrap();
    assert!(matches!(refused(&path), LearnerError::NotSamples { .. }), "{}", refused(&path));

    let broken = SampleFile::write(&path, 2, |writer| {
        let q = &[1.0, 2.0, 3.0];
        writer.add(learner::SampleSlices { q, qd: q, qdd: q, tau: q })
    });
    let said = broken.unwrap_err().to_string();
    assert_eq!(said, "q has 3 entries, 2 were expected");

    let nan = |at: usize| if at == 9001 { f64::NAN } else { 0.5 };
    let values: Vec<f64> = (0..10_000).map(nan).collect();
    let all = ["q_1", "q_2", "qd_1", "qd_2", "qdd_1", "qdd_2", "tau_1", "tau_2"];
    let columns = all.map(|name| (name.to_owned(), values.clone()));
    logs::write_columns(&path, &columns).unwrap();
    let (source, robot, settings) = (SampleFile::open(&path).unwrap(), arm::robot(), settings());
    let training = Training::new(&robot, &source, vec![0.01; 2], &settings, &SilentTraining);
    let said = training.err().unwrap().to_string();
    assert_eq!(said, "q of joint 0 in sample 9001 is NaN, which no sensor reports");
}

/// Bytes of a file of samples turned over, some at a time: its samples come, or a refusal that names it.
#[test]
fn a_damaged_file_of_samples_is_read_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("samples.parquet");
    let signal: Vec<f64> = (0..600).map(|i| f64::from(i % 37).sin()).collect();
    let columns = ["q_1", "qd_1", "qdd_1", "tau_1"].map(|name| (name.to_owned(), signal.clone()));
    logs::write_columns(&path, &columns).unwrap();
    let whole = std::fs::read(&path).unwrap();
    let mut refusals = 0;
    for place in 0..whole.len() {
        let mut damaged = whole.clone();
        damaged[place] ^= 1 << (place % 8);
        std::fs::write(&path, damaged).unwrap();
        let read = SampleFile::open(&path).and_then(|file| file.blocks(&mut |_| Ok(())));
        if let Err(error) = read {
            assert!(matches!(error, LearnerError::NotSamples { .. }), "byte {place}: {error}");
            refusals += 1;
        }
    }
    assert!(refusals > whole.len() / 10, "{refusals} of {}", whole.len());
}
