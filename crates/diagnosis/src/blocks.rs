use std::ops::Range;

use crate::design::Design;

/// Fewest blocks that a test can work with: `2^7` sign patterns.
pub(crate) const FEWEST_BLOCKS: usize = 8;

/// Number of blocks aimed at where the record allows.
const WANTED_BLOCKS: f64 = 24.0;

/// Least length of a block, in autocorrelation times.
const BLOCK_TIMES: f64 = 5.0;

/// Largest number of folds.
const FOLDS: usize = 5;

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
    /// What it is, in words.
    pub name: String,
    /// Blocks to predict.
    pub test: Vec<usize>,
    /// Blocks to fit on: all but the test blocks and their neighbours.
    pub train: Vec<usize>,
}

/// Cuts every run into blocks of at least five autocorrelation times, about 24 in all.
///
/// Where the record is too short for that, blocks are shortened until there are eight.
pub(crate) fn blocks(design: &Design, autocorrelation: f64) -> Vec<Block> {
    let lengths: Vec<usize> = design.runs.iter().map(|r| r.time.len()).collect();
    let total = lengths.iter().sum::<usize>() as f64;
    let wanted = (total / WANTED_BLOCKS).max(BLOCK_TIMES * autocorrelation);
    let length = wanted.min(total / FEWEST_BLOCKS as f64).max(2.0);
    let cut = |(run, &n): (usize, &usize)| {
        let count = ((n as f64 / length).round() as usize).max(1);
        let edge = move |k: usize| k * n / count;
        (0..count).map(move |k| Block { run, samples: edge(k)..edge(k + 1) })
    };
    lengths.iter().enumerate().flat_map(cut).filter(|b| !b.samples.is_empty()).collect()
}

/// Folds over the blocks `of`: by run where they span several runs, otherwise contiguous
/// parts of the one run with a block left out on either side.
pub(crate) fn folds(blocks: &[Block], of: &[usize], names: &[String]) -> Vec<Fold> {
    let mut runs: Vec<usize> = of.iter().map(|&b| blocks[b].run).collect();
    runs.dedup();
    if runs.len() > 1 {
        let parts = runs.len().min(2 * FOLDS);
        let part = |run: usize| {
            let at = runs.iter().position(|&r| r == run).unwrap_or(0);
            at * parts / runs.len()
        };
        return (0..parts)
            .map(|p| {
                let (test, train) = of.iter().partition(|&&b| part(blocks[b].run) == p);
                let held: Vec<&str> = runs
                    .iter()
                    .filter(|&&r| part(r) == p)
                    .filter_map(|&r| names.get(r).map(String::as_str))
                    .collect();
                Fold { name: held.join(" + "), test, train }
            })
            .collect();
    }
    let parts = FOLDS.min(of.len());
    (0..parts)
        .map(|p| {
            let (from, to) = (p * of.len() / parts, (p + 1) * of.len() / parts);
            // One block on each side is left out: a gap of at least four autocorrelation times.
            let gap = from.saturating_sub(1)..(to + 1).min(of.len());
            let train = (0..of.len()).filter(|k| !gap.contains(k)).map(|k| of[k]).collect();
            Fold { name: format!("part {} of {parts}", p + 1), test: of[from..to].to_vec(), train }
        })
        .collect()
}
