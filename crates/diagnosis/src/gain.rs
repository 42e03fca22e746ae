use logs::LogError;
use rayon::prelude::*;
use robot::Robot;

use crate::blocks::Fold;
use crate::held_out::{HeldOut, spans};
use crate::problem::{Model, Problem};
use crate::progress::Progress;
use crate::result::{FoldGain, InverseGain};
use crate::search::Record;
use crate::settle::settle;

/// Torque prediction on parts of the record that took no part in selection or fit.
#[derive(Debug, Clone)]
pub(crate) struct HeldOutGain {
    /// For the user.
    pub inverse: InverseGain,
    /// Weights selected and fitted without each fold of the whole record's problem.
    pub weights: Vec<Vec<f64>>,
    /// The folds, each with the robot that its weights make, where it was asked for.
    pub parts: Vec<HeldOut>,
}

/// Makes the robot of what a search came to.
pub(crate) type Make<'a> = &'a (dyn Fn(&Problem, &Model) -> Result<Robot, LogError> + Sync);

impl HeldOutGain {
    /// Searches anew without each fold of `whole`, predicts that fold, and makes the robot of
    /// each search where it is told how.
    pub fn new(
        record: &Record,
        whole: &Problem,
        make: Option<Make>,
        progress: &dyn Progress,
    ) -> Result<Self, LogError> {
        progress.stage("testing on held-out data", whole.folds.len());
        let without = |fold: &Fold| {
            let (problem, model) = record.search(&fold.train);
            let weights = settle(&problem, &model, &problem.info, record.robot);
            let part = make.map(|make| {
                let spans = |of: &[usize]| spans(record.design, record.blocks, of);
                let extended = make(&problem, &model)?;
                Ok(HeldOut { test: spans(&fold.test), train: spans(&fold.train), extended })
            });
            progress.step();
            Ok((weights, part.transpose()?))
        };
        let found: Vec<(Vec<f64>, Option<HeldOut>)> =
            whole.folds.par_iter().map(without).collect::<Result<_, LogError>>()?;
        let (weights, parts): (Vec<Vec<f64>>, Vec<Option<HeldOut>>) = found.into_iter().unzip();
        let parts = parts.into_iter().flatten().collect();
        Ok(Self { inverse: inverse(record, whole, &weights), weights, parts })
    }
}

fn inverse(record: &Record, whole: &Problem, weights: &[Vec<f64>]) -> InverseGain {
    let joints = record.design.joints();
    let rms = |blocks: &[usize], w: &[f64]| -> Vec<f64> {
        let of = |j| {
            let (sum, n) = record.grams.remaining(j, blocks, w);
            (sum / n.max(1) as f64).sqrt()
        };
        (0..joints).map(of).collect()
    };
    let before =
        |blocks: &[usize]| -> Vec<f64> { (0..joints).map(|j| gap(record, blocks, j)).collect() };
    let fold = |(f, fold): (usize, &Fold)| FoldGain {
        name: name(whole, f),
        torque_rms_nm: (0..joints).map(|j| measured(record, &fold.test, j).0).collect(),
        rms_before_nm: before(&fold.test),
        rms_after_nm: rms(&fold.test, &weights[f]),
    };
    let folds: Vec<FoldGain> = whole.folds.iter().enumerate().map(fold).collect();
    let after = whole.held_out_with(|f| weights[f].clone()).mean_square;
    let before: Vec<f64> = before(&whole.of).iter().map(|rms| rms * rms).collect();
    let nmse = |mean_square: &[f64]| {
        (0..joints).map(|j| mean_square[j] / measured(record, &whole.of, j).1).collect()
    };
    InverseGain {
        nmse_before: nmse(&before),
        nmse_after: nmse(&after),
        rms_before_nm: before.iter().map(|v| v.sqrt()).collect(),
        rms_after_nm: after.iter().map(|v| v.sqrt()).collect(),
        held_out: held_out(whole),
        folds,
    }
}

fn name(whole: &Problem, f: usize) -> String {
    let runs = &whole.design.runs;
    if runs.len() == 1 {
        return format!("part {} of {}", f + 1, whole.folds.len());
    }
    let mut held: Vec<usize> = whole.folds[f].test.iter().map(|&b| whole.blocks[b].run).collect();
    held.dedup();
    held.iter().map(|&r| runs[r].name.as_str()).collect::<Vec<_>>().join(" + ")
}

fn held_out(whole: &Problem) -> String {
    let runs = whole.design.runs.len();
    let count = whole.folds.len();
    if runs == 1 {
        format!(
            "each of {count} parts of the run in turn, with a gap on either side; causes and sizes found on the others"
        )
    } else if count == runs {
        "each run in turn; causes and sizes found on the others".to_owned()
    } else {
        format!("each of {count} groups of runs in turn; causes and sizes found on the others")
    }
}

/// RMS of measured minus nominal effort of joint `j` over some blocks.
fn gap(record: &Record, blocks: &[usize], j: usize) -> f64 {
    let joint =
        |b: &usize| (&record.blocks[*b], &record.design.runs[record.blocks[*b].run].joints[j]);
    let gaps = blocks
        .iter()
        .map(joint)
        .flat_map(|(block, joint)| joint.gap().skip(block.samples.start).take(block.samples.len()));
    let (n, sum) = gaps.fold((0_usize, 0.0), |(n, sum), gap| (n + 1, sum + gap * gap));
    (sum / n.max(1) as f64).sqrt()
}

/// RMS and variance of the measured effort of joint `j` over some blocks.
pub(crate) fn measured(record: &Record, blocks: &[usize], j: usize) -> (f64, f64) {
    let (mut n, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for &b in blocks {
        let block = &record.blocks[b];
        for v in &record.design.runs[block.run].joints[j].measured[block.samples.clone()] {
            n += 1.0;
            sum += v;
            squares += v * v;
        }
    }
    let count = f64::max(n, 1.0);
    let mean = sum / count;
    ((squares / count).sqrt(), (squares / count - mean * mean).max(0.0))
}
