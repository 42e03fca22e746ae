use std::ops::Range;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// The last share of so many rows; all of them where no share is given.
pub(crate) fn last_rows(count: usize, share: Option<f64>) -> Range<usize> {
    let share = share.unwrap_or(1.0).clamp(0.0, 1.0);
    ((1.0 - share) * count as f64).round() as usize..count
}

/// Rows at random, each as likely as a share; one at least. Another `stream` of a seed gives others.
pub(crate) fn random_rows(count: usize, share: f64, (seed, stream): (u64, u64)) -> Vec<usize> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(stream);
    let mut rows: Vec<usize> = (0..count).filter(|_| random.random::<f64>() < share).collect();
    if rows.is_empty() && count > 0 {
        rows.push(random.random_range(0..count));
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_of_the_rows_is_taken() {
        assert_eq!(last_rows(200, Some(0.25)), 150..200);
        assert_eq!(last_rows(200, None), 0..200);
        let rows = random_rows(10_000, 0.3, (7, 0));
        // Four deviations of a binomial count.
        assert!((rows.len() as f64 - 3000.0).abs() < 4.0 * 2100_f64.sqrt(), "{}", rows.len());
        assert_ne!(rows, random_rows(10_000, 0.3, (7, 1)));
        assert_eq!(random_rows(100, 1e-9, (7, 0)).len(), 1);
    }
}
