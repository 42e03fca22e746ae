use std::ops::Range;

use crate::design::Design;

/// Fewest blocks that a test can work with: `2^15` different sign patterns.
pub(crate) const FEWEST_BLOCKS: usize = 16;

/// Fewest samples of a block.
const FEWEST_SAMPLES: f64 = 4.0;

/// Number of blocks aimed at where the record allows.
const WANTED_BLOCKS: f64 = 24.0;

/// Least length of a block, in autocorrelation times.
const BLOCK_TIMES: f64 = 5.0;

/// Largest number of folds.
const FOLDS: usize = 5;

/// Fewest motions that are held out in turn: with two, each fit would know only one.
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

/// Cuts every run into blocks of at least five autocorrelation times, about 24 in all.
///
/// Where the record is too short for that, blocks are shortened until there are sixteen.
pub(crate) fn blocks(design: &Design, autocorrelation: f64) -> Vec<Block> {
    let lengths: Vec<usize> = design.runs.iter().map(|r| r.time.len()).collect();
    let total = lengths.iter().sum::<usize>() as f64;
    let wanted = (total / WANTED_BLOCKS).max(BLOCK_TIMES * autocorrelation);
    let length = wanted.min(total / FEWEST_BLOCKS as f64).max(FEWEST_SAMPLES);
    let cut = |(run, &n): (usize, &usize)| {
        let count = ((n as f64 / length).round() as usize).max(1);
        let edge = move |k: usize| k * n / count;
        (0..count).map(move |k| Block { run, samples: edge(k)..edge(k + 1) })
    };
    lengths.iter().enumerate().flat_map(cut).filter(|b| !b.samples.is_empty()).collect()
}

/// What is held out together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Folding {
    /// A run, even if another run repeats its motion: how well is the next run predicted?
    ByRun,
    /// All runs of one motion: does what was found carry over to another motion? With
    /// fewer than three motions, the same part of every run.
    ByMotion,
}

/// Folds over the blocks `of`.
///
/// `motion[run]` numbers the motions: runs that repeat one motion share a number. Where
/// the blocks span only one run (or one motion), each run is cut into contiguous parts,
/// the same part of every run is held out together, and the blocks next to it are left out.
pub(crate) fn folds(
    blocks: &[Block],
    of: &[usize],
    motion: &[usize],
    folding: Folding,
) -> Vec<Fold> {
    let key = |run: usize| match folding {
        Folding::ByRun => run,
        Folding::ByMotion => motion[run],
    };
    let mut keys: Vec<usize> = of.iter().map(|&b| key(blocks[b].run)).collect();
    keys.sort_unstable();
    keys.dedup();
    if keys.len() == 1 || (folding == Folding::ByMotion && keys.len() < FEWEST_MOTIONS) {
        return parts(blocks, of);
    }
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
    let shortest = within.iter().map(Vec::len).min().unwrap_or(0);
    let count = FOLDS.min(shortest).max(2);
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
