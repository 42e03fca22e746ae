use crate::columns::run_design::JointDesign;
use crate::regression::blocks::{Block, Fold};
use crate::regression::fitted_model::FittedModel;
use crate::regression::problem::Problem;
use crate::result::{FoldGain, InverseGain};
use crate::search::dataset::Dataset;

/// Torque prediction on held-out parts of the logs, which neither selection nor fit has seen.
#[derive(Debug)]
pub(crate) struct HeldOutGain {
    /// The gain as the diagnosis reports it.
    pub inverse: InverseGain,
    /// The model found without each fold.
    pub folds: Vec<FittedModel>,
}

impl HeldOutGain {
    /// The gain of the models that were found without each fold of `whole`.
    pub fn new(dataset: &Dataset, whole: &Problem, folds: Vec<FittedModel>) -> Self {
        Self { inverse: inverse(dataset, whole, &folds), folds }
    }

    /// Residuals in every fold of `whole`, by the model found without it, `[joint][run][sample]` (N·m or N).
    pub fn held_out_residuals(&self, whole: &Problem) -> Vec<Vec<Vec<f64>>> {
        whole.held_out_residuals(|f, block, j| self.folds[f].remaining(whole.design, block, j))
    }
}

fn inverse(dataset: &Dataset, whole: &Problem, fitted: &[FittedModel]) -> InverseGain {
    let joints = dataset.design.joints();
    let before =
        |blocks: &[usize]| -> Vec<f64> { (0..joints).map(|j| gap(dataset, blocks, j)).collect() };
    let rms = |(sum, n): (f64, usize)| (sum / n.max(1) as f64).sqrt();
    let remaining_squares = |(fold, fitted): (&Fold, &FittedModel)| -> Vec<(f64, usize)> {
        (0..joints).map(|j| squares(whole, fold, fitted, j)).collect()
    };
    let left: Vec<Vec<(f64, usize)>> =
        whole.folds.iter().zip(fitted).map(remaining_squares).collect();
    let fold = |(f, fold): (usize, &Fold)| FoldGain {
        name: name(whole, f),
        torque_rms_nm: (0..joints)
            .map(|j| effort_rms_and_variance(dataset, &fold.test, j).0)
            .collect(),
        rms_before_nm: before(&fold.test),
        rms_after_nm: left[f].iter().copied().map(rms).collect(),
    };
    let folds: Vec<FoldGain> = whole.folds.iter().enumerate().map(fold).collect();
    let all = |j: usize| left.iter().fold((0.0, 0), |(s, n), of| (s + of[j].0, n + of[j].1));
    let rms_after: Vec<f64> = (0..joints).map(|j| rms(all(j))).collect();
    let rms_before = before(&whole.of);
    let nmse = |rms: &[f64]| {
        let of = |j: usize| {
            let variance = effort_rms_and_variance(dataset, &whole.of, j).1;
            if variance > 0.0 { rms[j].powi(2) / variance } else { 0.0 }
        };
        (0..joints).map(of).collect()
    };
    InverseGain {
        nmse_before: nmse(&rms_before),
        nmse_after: nmse(&rms_after),
        rms_before_nm: rms_before,
        rms_after_nm: rms_after,
        held_out: describe_folds(whole),
        folds,
    }
}

/// Sum of squares and number of the informative residuals of joint `j` in the test blocks of a fold.
fn squares(whole: &Problem, fold: &Fold, fitted: &FittedModel, j: usize) -> (f64, usize) {
    let sum = |(sum, n): (f64, usize), block: &Block| {
        let left = fitted.remaining(whole.design, block, j);
        let is_informative = &whole.design.runs[block.run].joints[j].is_informative;
        let of = left.iter().zip(&is_informative[block.samples.clone()]);
        of.filter(|(_, is)| **is).fold((sum, n), |(sum, n), (x, _)| (sum + x * x, n + 1))
    };
    fold.test.iter().map(|&b| &whole.blocks[b]).fold((0.0, 0), sum)
}

fn name(whole: &Problem, f: usize) -> String {
    let runs = &whole.design.runs;
    if is_in_parts(whole) {
        let of = if runs.len() == 1 { "" } else { " of every run" };
        return format!("part {} of {}{of}", f + 1, whole.folds.len());
    }
    let mut held: Vec<usize> = whole.folds[f].test.iter().map(|&b| whole.blocks[b].run).collect();
    held.dedup();
    held.iter().map(|&r| runs[r].name.as_str()).collect::<Vec<_>>().join(" + ")
}

/// Whether parts of runs are held out rather than whole runs.
fn is_in_parts(whole: &Problem) -> bool {
    let run = |b: &usize| whole.blocks[*b].run;
    let is_torn =
        |f: &Fold| f.test.iter().any(|b| f.train.iter().any(|other| run(other) == run(b)));
    whole.folds.iter().any(is_torn)
}

fn describe_folds(whole: &Problem) -> String {
    let runs = whole.design.runs.len();
    let count = whole.folds.len();
    if is_in_parts(whole) {
        let of = if runs == 1 { "the run" } else { "every run" };
        format!(
            "each of {count} parts of {of} in turn, with a gap on either side; causes and sizes found on the others"
        )
    } else if count == runs {
        "each run in turn; causes and sizes found on the others".to_owned()
    } else {
        format!("each of {count} groups of runs in turn; causes and sizes found on the others")
    }
}

/// RMS of the informative samples of measured minus nominal effort of joint `j` over some blocks.
fn gap(dataset: &Dataset, blocks: &[usize], j: usize) -> f64 {
    let gaps = informative(dataset, blocks, j, |joint| joint.gap().collect());
    let (n, sum) = gaps.iter().fold((0_usize, 0.0), |(n, sum), gap| (n + 1, sum + gap * gap));
    (sum / n.max(1) as f64).sqrt()
}

/// RMS and variance of the informative samples of the measured effort of joint `j` over some blocks.
pub(crate) fn effort_rms_and_variance(dataset: &Dataset, blocks: &[usize], j: usize) -> (f64, f64) {
    let efforts = informative(dataset, blocks, j, |joint| joint.measured.clone());
    let count = efforts.len().max(1) as f64;
    let mean = efforts.iter().sum::<f64>() / count;
    let square = efforts.iter().map(|v| v * v).sum::<f64>() / count;
    (square.sqrt(), (square - mean * mean).max(0.0))
}

/// The informative samples of a signal of joint `j` over some blocks.
fn informative(
    dataset: &Dataset,
    blocks: &[usize],
    j: usize,
    signal: impl Fn(&JointDesign) -> Vec<f64>,
) -> Vec<f64> {
    let joints = dataset.design.runs.iter().map(|run| &run.joints[j]);
    let signals: Vec<(Vec<f64>, &[bool])> =
        joints.map(|joint| (signal(joint), joint.is_informative.as_slice())).collect();
    let of_block = |b: &usize| {
        let Block { run, samples } = &dataset.blocks[*b];
        let (signal, is_informative) = &signals[*run];
        let all = signal[samples.clone()].iter().zip(&is_informative[samples.clone()]);
        all.filter(|(_, is)| **is).map(|(value, _)| *value)
    };
    blocks.iter().flat_map(of_block).collect()
}
