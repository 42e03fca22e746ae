use std::collections::BTreeSet;
use std::ops::Range;

use crate::design::Design;

/// Fewest blocks that a test can work with: `2^15` different sign patterns.
pub(crate) const FEWEST_BLOCKS: usize = 16;

/// Fewest samples of a block.
const FEWEST_SAMPLES: f64 = 2.0;

/// Number of blocks in which each joint moves that is aimed at where the record allows.
const WANTED_BLOCKS: f64 = 24.0;

/// Most blocks of a record: each costs the memory of a matrix for every joint.
const MOST_BLOCKS: f64 = 240.0;

/// Least length of a block, in autocorrelation times.
const BLOCK_TIMES: f64 = 5.0;

/// Largest number of folds.
const FOLDS: usize = 5;

/// Fewest motions of every joint that are held out in turn: with two, each fit would know only one.
const FEWEST_MOTIONS: usize = 3;

/// A stretch of one run: the unit of replication.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Block {
    /// Index of the run.
    pub run: usize,
    /// Its samples.
    pub samples: Range<usize>,
}

/// A part of the record that is held out together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Fold {
    /// Blocks to predict.
    pub test: Vec<usize>,
    /// Blocks to fit on: all but the test blocks and their neighbours.
    pub train: Vec<usize>,
}

/// Cuts every run into blocks of at least five autocorrelation times.
///
/// They are so short that every joint has about 24 of them in which it moves, in motions that differ:
/// what a joint does in one log of six, or in three repeats of one motion, is cut as finely as one log
/// of that alone would be. Where a joint moves too briefly for that, blocks are shortened until it has
/// sixteen.
pub(crate) fn blocks(design: &Design, autocorrelation: f64) -> Vec<Block> {
    let lengths: Vec<usize> = design.runs.iter().map(|r| r.time.len()).collect();
    let total = lengths.iter().sum::<usize>() as f64;
    let least = least_told(design).unwrap_or(total);
    let wanted = (least / WANTED_BLOCKS).max(BLOCK_TIMES * autocorrelation);
    let length = wanted.min(least / FEWEST_BLOCKS as f64).max(FEWEST_SAMPLES);
    let length = length.max(total / MOST_BLOCKS);
    let cut = |(run, &n): (usize, &usize)| {
        let count = ((n as f64 / length).round() as usize).max(1);
        let edge = move |k: usize| k * n / count;
        (0..count).map(move |k| Block { run, samples: edge(k)..edge(k + 1) })
    };
    lengths.iter().enumerate().flat_map(cut).filter(|b| !b.samples.is_empty()).collect()
}

/// The fewest samples that tell of the effort of a joint that moved, in motions that differ.
fn least_told(design: &Design) -> Option<f64> {
    let is_first = |r: &usize| !design.motion[..*r].contains(&design.motion[*r]);
    let firsts: Vec<usize> = (0..design.runs.len()).filter(is_first).collect();
    let told = |j: usize| {
        let of_run = |r: &usize| design.runs[*r].joints[j].tells.iter().filter(|t| **t).count();
        firsts.iter().map(of_run).sum::<usize>()
    };
    let moved = (0..design.joints()).filter(|j| design.moved[*j]);
    moved.map(told).filter(|told| *told > 0).min().map(|told| told as f64)
}

/// What is held out together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Folding {
    /// A run, even if another run repeats its motion: how well is the next run predicted?
    ByRun,
    /// All runs of one motion: does what was found carry over to another motion?
    ByMotion,
}

/// Folds over the blocks `of`.
///
/// Runs, or motions, are held out in turn where every joint moves in three of them or more. Otherwise
/// each run is cut into contiguous parts, the same part of every run is held out together, and the
/// blocks next to it are left out: every motion of a joint is then on both sides.
pub(crate) fn folds(
    design: &Design,
    blocks: &[Block],
    of: &[usize],
    folding: Folding,
) -> Vec<Fold> {
    let key = |run: usize| match folding {
        Folding::ByRun => run,
        Folding::ByMotion => design.motion[run],
    };
    let mut runs: Vec<usize> = of.iter().map(|&b| blocks[b].run).collect();
    runs.dedup();
    let keys_of =
        |runs: &mut dyn Iterator<Item = usize>| -> BTreeSet<usize> { runs.map(key).collect() };
    let moves_in =
        |j: usize| keys_of(&mut runs.iter().copied().filter(|r| design.moves[*r][j])).len();
    let mut moved = (0..design.joints()).filter(|j| design.moved[*j]);
    if moved.any(|j| moves_in(j) < FEWEST_MOTIONS) {
        return parts(blocks, of);
    }
    let keys: Vec<usize> = keys_of(&mut runs.iter().copied()).into_iter().collect();
    let count = keys.len().min(2 * FOLDS);
    let part = |run: usize| keys.binary_search(&key(run)).unwrap_or(0) * count / keys.len();
    (0..count)
        .map(|p| {
            let (test, train) = of.iter().partition(|&&b| part(blocks[b].run) == p);
            Fold { test, train }
        })
        .collect()
}

fn parts(blocks: &[Block], of: &[usize]) -> Vec<Fold> {
    let mut runs: Vec<usize> = of.iter().map(|&b| blocks[b].run).collect();
    runs.dedup();
    let within: Vec<Vec<usize>> = runs
        .iter()
        .map(|&r| of.iter().copied().filter(|&b| blocks[b].run == r).collect())
        .collect();
    let longest = within.iter().map(Vec::len).max().unwrap_or(0);
    let count = FOLDS.min(longest).max(2);
    (0..count)
        .map(|p| {
            let (mut test, mut train) = (Vec::new(), Vec::new());
            for run in &within {
                let (from, to) = (p * run.len() / count, (p + 1) * run.len() / count);
                // One block on each side is left out: a gap against the memory of the noise.
                let gap = from.saturating_sub(1)..(to + 1).min(run.len());
                test.extend(&run[from..to]);
                train.extend((0..run.len()).filter(|k| !gap.contains(k)).map(|k| run[k]));
            }
            Fold { test, train }
        })
        .collect()
}
