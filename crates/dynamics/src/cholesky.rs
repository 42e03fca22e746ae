//! Cholesky in place on a row-major slice: no allocation, and the failing pivot is told.

/// Overwrites the lower triangle of the symmetric `a` (n x n) with `L`, `a = L L'`.
///
/// `Err((row, pivot))` when `a` is not positive definite.
pub(crate) fn factor(a: &mut [f64], n: usize) -> Result<(), (usize, f64)> {
    for i in 0..n {
        let (above, row) = a.split_at_mut(i * n);
        for j in 0..i {
            let other = &above[j * n..=j * n + j];
            row[j] = (row[j] - dot(&row[..j], &other[..j])) / other[j];
        }
        let pivot = row[i] - dot(&row[..i], &row[..i]);
        if pivot.is_nan() || pivot <= 0.0 {
            return Err((i, pivot));
        }
        row[i] = pivot.sqrt();
    }
    Ok(())
}

/// Solves `L L' x = b` with the factor in the lower triangle of `l`; `b` becomes `x`.
pub(crate) fn solve_factored(l: &[f64], b: &mut [f64]) {
    let n = b.len();
    for i in 0..n {
        b[i] = (b[i] - dot(&l[i * n..i * n + i], &b[..i])) / l[i * n + i];
    }
    for i in (0..n).rev() {
        b[i] /= l[i * n + i];
        let x = b[i];
        b[..i].iter_mut().zip(&l[i * n..]).for_each(|(b, l)| *b -= l * x);
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hand_made_system_is_solved() {
        let mut a = [4.0, 2.0, 0.0, 2.0, 5.0, 2.0, 0.0, 2.0, 5.0];
        let mut b = [8.0, 18.0, 19.0];
        factor(&mut a, 3).unwrap();
        solve_factored(&a, &mut b);
        for (x, expected) in b.iter().zip([1.0, 2.0, 3.0]) {
            assert!((x - expected).abs() < 1e-15);
        }
    }

    #[test]
    fn the_failing_pivot_of_an_indefinite_matrix_is_told() {
        assert_eq!(factor(&mut [1.0, 2.0, 2.0, 1.0], 2), Err((1, -3.0)));
    }
}
