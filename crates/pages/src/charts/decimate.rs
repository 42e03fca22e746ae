/// Points that draw like all of them on so many pixel columns: of every column the lowest
/// and the highest, in the order of time. A spike of one sample survives.
///
/// `points` are `[x, y]` with ascending `x`; those that are not finite are left out.
pub fn column_extremes(points: &[[f64; 2]], columns: usize) -> Vec<[f64; 2]> {
    let finite: Vec<[f64; 2]> =
        points.iter().copied().filter(|p| p.iter().all(|v| v.is_finite())).collect();
    let (Some(first), Some(last)) = (finite.first(), finite.last()) else { return Vec::new() };
    if finite.len() <= 2 * columns || columns == 0 || last[0] <= first[0] {
        return finite;
    }
    let (start, width) = (first[0], (last[0] - first[0]) / columns as f64);
    let column_of = |p: &[f64; 2]| (((p[0] - start) / width) as usize).min(columns - 1);
    let mut kept = Vec::with_capacity(2 * columns);
    for column in finite.chunk_by(|a, b| column_of(a) == column_of(b)) {
        let by_y = |a: &&[f64; 2], b: &&[f64; 2]| a[1].total_cmp(&b[1]);
        let lowest = column.iter().min_by(by_y).copied();
        let highest = column.iter().max_by(by_y).copied();
        let mut pair: Vec<[f64; 2]> = lowest.into_iter().chain(highest).collect();
        pair.sort_by(|a, b| a[0].total_cmp(&b[0]));
        pair.dedup();
        kept.extend(pair);
    }
    kept
}

/// Fewest points of a slice of [`percentile_bands`].
const FEWEST: usize = 20;

/// Where `y` lies along `x`: `[x, low, middle, high]` per slice, with the median of `x` and
/// the 5th, 50th and 95th percentile of `y`.
///
/// There are at most so many slices, all of the same number of points, so that none is
/// sparse. Nothing when `x` is constant.
pub fn percentile_bands(x: &[f64], y: &[f64], slices: usize) -> Vec<[f64; 4]> {
    let pairs = x.iter().copied().zip(y.iter().copied());
    let mut points: Vec<(f64, f64)> =
        pairs.filter(|(x, y)| x.is_finite() && y.is_finite()).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Vec::new() };
    if last.0 <= first.0 {
        return Vec::new();
    }
    let members = points.len().div_ceil(slices.max(1)).max(FEWEST);
    points.chunks(members).filter(|c| 2 * c.len() >= FEWEST).map(band).collect()
}

fn band(slice: &[(f64, f64)]) -> [f64; 4] {
    let x: Vec<f64> = slice.iter().map(|p| p.0).collect();
    let mut y: Vec<f64> = slice.iter().map(|p| p.1).collect();
    y.sort_by(f64::total_cmp);
    let at = |ordered: &[f64], share| percentile(ordered, share).unwrap_or(f64::NAN);
    [at(&x, 0.5), at(&y, 0.05), at(&y, 0.5), at(&y, 0.95)]
}

/// The value below which `share` of the ordered values lie; none when there are none.
fn percentile(ordered: &[f64], share: f64) -> Option<f64> {
    let last = ordered.len().checked_sub(1)?;
    ordered.get((share * last as f64).round() as usize).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spike_of_one_sample_survives() {
        let mut points: Vec<[f64; 2]> = (0..10_000).map(|k| [f64::from(k), 0.0]).collect();
        points[5_003][1] = 7.0;
        points[5_004][1] = f64::NAN;
        let kept = column_extremes(&points, 100);
        assert!(kept.len() <= 200);
        assert!(kept.contains(&[5_003.0, 7.0]));
        assert!(kept.is_sorted_by(|a, b| a[0] <= b[0]));
    }

    #[test]
    fn a_band_follows_the_function_and_ignores_one_outlier() {
        let x: Vec<f64> = (0..1000).map(|k| f64::from(k) * 0.01).collect();
        let mut y: Vec<f64> = x.iter().map(|x| 2.0 * x).collect();
        y[500] = 1e6;
        for [x, low, middle, high] in percentile_bands(&x, &y, 20) {
            assert!((middle - 2.0 * x).abs() < 0.1, "{middle} at {x}");
            assert!(low >= 2.0 * x - 0.6 && high <= 2.0 * x + 0.6, "{low} {high} at {x}");
        }
    }

    #[test]
    fn a_constant_signal_has_no_bands() {
        assert!(percentile_bands(&[1.0; 50], &[0.0; 50], 10).is_empty());
        assert!(percentile_bands(&[], &[], 10).is_empty());
    }
}
