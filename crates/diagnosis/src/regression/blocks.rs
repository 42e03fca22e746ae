use std::collections::BTreeSet;
use std::ops::Range;

use crate::columns::design::Design;
use crate::thresholds::blocks::BlockThresholds;

/// A stretch of one run, the unit of replication.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Block {
    /// Index of the run.
    pub run: usize,
    /// Its samples.
    pub samples: Range<usize>,
}

impl Block {
    /// Residual of joint `j` in the block after the columns with `weights` (N·m or N).
    pub fn remaining(&self, design: &Design, j: usize, weights: &[f64]) -> Vec<f64> {
        design.remaining((self.run, &self.samples), j, weights)
    }
}

/// A part of the logs that is held out as a whole.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Fold {
    /// Blocks to predict.
    pub test: Vec<usize>,
    /// Blocks to fit on: all except the test blocks and their neighbours.
    pub train: Vec<usize>,
}

/// Cuts every run into blocks of at least five autocorrelation times.
///
/// Blocks are short enough for every joint to move in about 24 of them, in motions that differ. A joint that moves in
/// one log of six, or in three repeats of one motion, is thus cut as finely as in a single log. Where a joint moves
/// too briefly for that, blocks are shortened until it has sixteen.
pub(crate) fn blocks(design: &Design, autocorrelation: f64, t: &BlockThresholds) -> Vec<Block> {
    let lengths: Vec<usize> = design.runs.iter().map(|r| r.time.len()).collect();
    let total = lengths.iter().sum::<usize>() as f64;
    let least = fewest_informative(design).unwrap_or(total);
    let wanted = (least / t.wanted).max(t.autocorrelation_times * autocorrelation);
    let length = wanted.min(least / t.fewest as f64).max(t.fewest_samples);
    let length = length.max(total / t.most);
    let cut = |(run, &n): (usize, &usize)| {
        let count = ((n as f64 / length).round() as usize).max(1);
        let edge = move |k: usize| k * n / count;
        (0..count).map(move |k| Block { run, samples: edge(k)..edge(k + 1) })
    };
    lengths.iter().enumerate().flat_map(cut).filter(|b| !b.samples.is_empty()).collect()
}

/// The number of informative samples, in motions that differ, of the moved joint that has the fewest.
fn fewest_informative(design: &Design) -> Option<f64> {
    let is_first = |r: &usize| !design.motion[..*r].contains(&design.motion[*r]);
    let firsts: Vec<usize> = (0..design.runs.len()).filter(is_first).collect();
    let informative = |j: usize| {
        let of_run =
            |r: &usize| design.runs[*r].joints[j].is_informative.iter().filter(|t| **t).count();
        firsts.iter().map(of_run).sum::<usize>()
    };
    let moved = (0..design.joints()).filter(|j| design.moved[*j]);
    moved.map(informative).filter(|samples| *samples > 0).min().map(|samples| samples as f64)
}

/// How runs are held out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Folding {
    /// Each run by itself, even if another run repeats its motion: how well is the next run predicted?
    ByRun,
    /// All runs of one motion together: do the findings hold for another motion?
    ByMotion,
}

/// Folds over the blocks `of`.
///
/// Runs, or motions, are held out in turn where every joint moves in at least three of them. Otherwise each run is
/// cut into stretches, and the same stretches of every run are held out together, so that every motion of a joint is
/// in both test and fit. The blocks beside a stretch belong to neither.
pub(crate) fn folds(
    design: &Design,
    blocks: &[Block],
    of: &[usize],
    folding: Folding,
    t: &BlockThresholds,
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
    if moved.any(|j| moves_in(j) < t.fewest_motions) {
        return parts(design, blocks, of, t);
    }
    let keys: Vec<usize> = keys_of(&mut runs.iter().copied()).into_iter().collect();
    let count = keys.len().min(2 * t.folds);
    let part = |run: usize| keys.binary_search(&key(run)).unwrap_or(0) * count / keys.len();
    (0..count)
        .map(|p| {
            let (test, train) = of.iter().partition(|&&b| part(blocks[b].run) == p);
            Fold { test, train }
        })
        .collect()
}

/// Folds of stretches that are the same in every run.
///
/// The number of stretches is the smallest of 5, 10, 20, ... that leaves every fit half of each joint's informative
/// samples in either direction. Where none does, it is the number that withholds the least from the fits, summed over
/// the joints. A joint that moves in a single stretch then does not decide for the others.
fn parts(design: &Design, blocks: &[Block], of: &[usize], t: &BlockThresholds) -> Vec<Fold> {
    let mut runs: Vec<usize> = of.iter().map(|&b| blocks[b].run).collect();
    runs.dedup();
    let within: Vec<Vec<usize>> = runs
        .iter()
        .map(|&r| of.iter().copied().filter(|&b| blocks[b].run == r).collect())
        .collect();
    let longest = within.iter().map(Vec::len).max().unwrap_or(0);
    let count = t.folds.min(longest).max(2);
    let samples = InformativeSamples::new(design, blocks, of, t.least_direction);
    let mut best: Option<(f64, Vec<Fold>)> = None;
    let mut rounds = 1;
    loop {
        let folds = deal(&within, count, rounds);
        let kept = samples.largest_held_out_shares(&folds);
        let most = kept.iter().copied().fold(0.0, f64::max);
        let beyond = kept.iter().map(|kept| (kept - t.most_held_out).max(0.0)).sum();
        if best.as_ref().is_none_or(|(least, _)| beyond < *least) {
            best = Some((beyond, folds));
        }
        rounds *= 2;
        if most <= t.most_held_out || rounds * count * t.fewest_in_stretch > longest {
            break;
        }
    }
    best.map(|(_, folds)| folds).unwrap_or_default()
}

/// Deals stretches of the runs `within` to `count` folds in turn, `rounds` stretches to each fold.
fn deal(within: &[Vec<usize>], count: usize, rounds: usize) -> Vec<Fold> {
    let fold = |p: usize| {
        let (mut test, mut train) = (Vec::new(), Vec::new());
        for run in within {
            let is_held_out = |k: usize| k * count * rounds / run.len() % count == p;
            // One block on each side is left out: a gap against the memory of the noise.
            let is_near = |k: usize| (k.saturating_sub(1)..(k + 2).min(run.len())).any(is_held_out);
            test.extend((0..run.len()).filter(|k| is_held_out(*k)).map(|k| run[k]));
            train.extend((0..run.len()).filter(|k| !is_near(*k)).map(|k| run[k]));
        }
        Fold { test, train }
    };
    (0..count).map(fold).collect()
}

/// Number of informative samples of every joint in every block, by the direction of its motion.
struct InformativeSamples {
    /// `[joint and direction][block]`
    samples: Vec<Vec<usize>>,
    /// The same, summed over all blocks.
    all: Vec<usize>,
}

impl InformativeSamples {
    fn new(design: &Design, blocks: &[Block], of: &[usize], least_direction: f64) -> Self {
        let moved: Vec<usize> = (0..design.joints()).filter(|j| design.moved[*j]).collect();
        let in_block = |j: usize, forward: bool, block: &Block| {
            let joint = &design.runs[block.run].joints[j];
            let counts =
                |t: &usize| joint.is_informative[*t] && (joint.state[1][*t] > 0.0) == forward;
            block.samples.clone().filter(counts).count()
        };
        let (mut samples, mut all) = (Vec::new(), Vec::new());
        for j in moved {
            let ways = [false, true]
                .map(|way| blocks.iter().map(|b| in_block(j, way, b)).collect::<Vec<_>>());
            let sums = ways.each_ref().map(|way| of.iter().map(|&b| way[b]).sum::<usize>());
            let whole = (sums[0] + sums[1]) as f64;
            for (way, sum) in ways.into_iter().zip(sums) {
                if sum > 0 && sum as f64 >= least_direction * whole {
                    samples.push(way);
                    all.push(sum);
                }
            }
        }
        Self { samples, all }
    }

    /// The largest share of each joint's informative samples, in each direction, that a fold withholds from its fit.
    fn largest_held_out_shares(&self, folds: &[Fold]) -> Vec<f64> {
        let of = |(way, all): (&Vec<usize>, &usize)| {
            let share = |fold: &Fold| {
                1.0 - fold.train.iter().map(|&b| way[b]).sum::<usize>() as f64 / *all as f64
            };
            folds.iter().map(share).fold(0.0, f64::max)
        };
        self.samples.iter().zip(&self.all).map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two runs, of 60 and of 30 blocks.
    fn within() -> Vec<Vec<usize>> {
        vec![(0..60).collect(), (60..90).collect()]
    }

    #[test]
    fn stretches_are_held_out_once_and_next_to_none_that_is_fitted() {
        for rounds in [1, 2, 4] {
            let folds = deal(&within(), 5, rounds);
            let mut held_out: Vec<usize> = folds.iter().flat_map(|f| f.test.clone()).collect();
            held_out.sort_unstable();
            assert_eq!(held_out, (0..90).collect::<Vec<_>>());
            for fold in &folds {
                let is_near = |b: &usize| {
                    fold.test.iter().any(|t| t.abs_diff(*b) <= 1 && (*t < 60) == (*b < 60))
                };
                assert!(!fold.train.iter().any(is_near), "{rounds} rounds");
            }
        }
        // A fifth of every run, as one stretch, and the block next to it.
        let first = &deal(&within(), 5, 1)[0];
        assert_eq!(first.test, (0..12).chain(60..66).collect::<Vec<_>>());
        assert_eq!(first.train, (13..60).chain(67..90).collect::<Vec<_>>());
    }

    /// A joint that moves in blocks 12 to 23 of 60 alone moves in one fold of five, and in all of them
    /// when 10 or 20 stretches are dealt.
    #[test]
    fn a_brief_motion_is_on_both_sides_when_more_stretches_are_dealt() {
        let brief: Vec<usize> =
            (0..60).map(|b| if (12..24).contains(&b) { 10 } else { 0 }).collect();
        let samples = InformativeSamples { all: vec![brief.iter().sum()], samples: vec![brief] };
        let within = vec![(0..60).collect::<Vec<usize>>()];
        let held_out_share = |rounds| samples.largest_held_out_shares(&deal(&within, 5, rounds))[0];
        assert!((held_out_share(1) - 1.0).abs() < 1e-12);
        assert!(
            held_out_share(2) > 0.5 && held_out_share(4) <= 0.5,
            "{} {}",
            held_out_share(2),
            held_out_share(4)
        );
    }
}
