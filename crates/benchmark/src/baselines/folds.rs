#![allow(
    clippy::single_range_in_vec_init,
    reason = "one stretch of samples is held, not the numbers in it"
)]

use std::ops::Range;

/// Fewest and most runs of which each is a fold of its own.
const FEWEST: usize = 3;
const MOST: usize = 8;

/// Number of blocks of a run where there are fewer runs.
const BLOCKS: usize = 4;

/// Time between held-out and training samples inside a run (s).
const GAP_S: f64 = 0.5;

/// A held-out part of the samples.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct HeldOut {
    /// Held-out samples, which are predicted.
    pub held: Vec<Range<usize>>,
    /// Samples beside them in a run, which belong to neither side.
    pub near: Vec<Range<usize>>,
}

/// The folds of consecutive runs at one rate (Hz).
///
/// Whole runs are held out in turn, neighbours together where there are more than eight. Fewer than three runs are
/// cut into four blocks each. Half a second beside a block is then left out on each side, or an eighth of a block
/// where that is less.
pub(super) fn folds(runs: &[Range<usize>], rate_hz: f64) -> Vec<HeldOut> {
    if runs.len() >= FEWEST {
        let count = runs.len().min(MOST);
        let of = |fold: usize| {
            let [first, last] = [fold, fold + 1].map(|f| f * runs.len() / count);
            HeldOut { held: runs[first..last].to_vec(), near: Vec::new() }
        };
        return (0..count).map(of).collect();
    }
    runs.iter().flat_map(|run| blocks(run, rate_hz)).collect()
}

fn blocks(run: &Range<usize>, rate_hz: f64) -> Vec<HeldOut> {
    let at = |block: usize| run.start + block * run.len() / BLOCKS;
    let gap = ((GAP_S * rate_hz) as usize).min(run.len() / (8 * BLOCKS));
    let of = |block: usize| {
        let [start, end] = [at(block), at(block + 1)];
        let before = start.saturating_sub(gap).max(run.start)..start;
        let after = end..(end + gap).min(run.end);
        HeldOut { held: vec![start..end], near: vec![before, after] }
    };
    (0..BLOCKS).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_runs_take_turns_and_neighbours_share_a_turn_where_there_are_many() {
        let of_three = folds(&[0..5, 5..9, 9..20], 30.0);
        assert_eq!(of_three.len(), 3);
        assert_eq!(of_three[1], HeldOut { held: Vec::from([5..9]), near: Vec::new() });
        let many: Vec<_> = (0..20).map(|k| 10 * k..10 * k + 10).collect();
        let of_many = folds(&many, 30.0);
        assert_eq!(of_many.len(), MOST);
        let held: usize = of_many.iter().flat_map(|f| &f.held).map(ExactSizeIterator::len).sum();
        assert_eq!(held, 200);
    }

    #[test]
    fn one_run_is_held_out_in_blocks_with_what_is_beside_them_left_out() {
        let of_one = folds(&[100..1060], 30.0);
        assert_eq!(of_one.len(), BLOCKS);
        assert_eq!(of_one[0], HeldOut { held: vec![100..340], near: vec![100..100, 340..355] });
        assert_eq!(of_one[3].near, [805..820, 1060..1060]);
    }
}
