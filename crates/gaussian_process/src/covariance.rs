use crate::error::{GpError, check};
use crate::exp::exp;
use crate::kernel::GaussianKernel;
use pulp::{Arch, Simd, WithSimd};

/// Points held side by side: two vectors of AVX-512, four of AVX2.
const LANES: usize = 16;

/// Samples whose covariances are computed at once, so that a point loaded serves all of them.
const COLUMNS: usize = 4;

/// The number of points in a row-major slice, `d` finite numbers each.
pub(crate) fn check_points(
    vector: &'static str,
    values: &[f64],
    d: usize,
) -> Result<usize, GpError> {
    if d == 0 || values.is_empty() {
        return Err(GpError::NoPoints);
    }
    let n = values.len().div_ceil(d);
    check(vector, values, n * d)?;
    Ok(n)
}

/// Sum of products in eight lanes.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; 8];
    let (a, b) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f64 = a.remainder().iter().zip(b.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a.zip(b) {
        (0..8).for_each(|i| lanes[i] += x[i] * y[i]);
    }
    lanes.iter().sum::<f64>() + rest
}

/// Points divided by the length scales, input by input in groups of [`LANES`] points.
pub(crate) struct ScaledPoints {
    kernel: GaussianKernel,
    points: usize,
    groups: Vec<f64>,
}

impl ScaledPoints {
    /// `points` is row-major and checked.
    pub(crate) fn new(points: &[f64], kernel: &GaussianKernel) -> Self {
        let d = kernel.inputs();
        let n = points.len() / d;
        let mut groups = vec![0.0; n.div_ceil(LANES) * LANES * d];
        for (i, point) in points.chunks_exact(d).enumerate() {
            let start = i / LANES * LANES * d + i % LANES;
            for (j, (x, l)) in point.iter().zip(&kernel.length_scales).enumerate() {
                groups[start + j * LANES] = x / l;
            }
        }
        Self { kernel: kernel.clone(), points: n, groups }
    }

    pub(crate) fn len(&self) -> usize {
        self.points
    }

    pub(crate) fn kernel(&self) -> &GaussianKernel {
        &self.kernel
    }

    /// Covariances with samples (row-major, not scaled), one column each:
    ///
    /// ```text
    /// out[i + c stride] = k(z_i, x_c)
    /// ```
    pub(crate) fn covariances(&self, samples: &[f64], out: &mut [f64], stride: usize) {
        let l = &self.kernel.length_scales;
        let scaled: Vec<f64> = samples.iter().zip(l.iter().cycle()).map(|(x, l)| x / l).collect();
        Arch::new().dispatch(Covariances { points: self, scaled: &scaled, out, stride });
    }
}

struct Covariances<'a> {
    points: &'a ScaledPoints,
    scaled: &'a [f64],
    out: &'a mut [f64],
    stride: usize,
}

impl WithSimd for Covariances<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let d = self.points.kernel.inputs();
        let blocks = self.scaled.chunks(COLUMNS * d);
        for (block, out) in blocks.zip(self.out.chunks_mut(COLUMNS * self.stride)) {
            if block.len() == COLUMNS * d {
                columns::<S, COLUMNS>(simd, self.points, block, (out, self.stride));
            } else {
                let singles = block.chunks_exact(d).zip(out.chunks_mut(self.stride));
                singles.for_each(|(x, out)| columns::<S, 1>(simd, self.points, x, (out, 0)));
            }
        }
    }
}

/// The covariances of all points with `C` samples; `out` comes with its stride.
#[inline(always)]
fn columns<S: Simd, const C: usize>(
    simd: S,
    points: &ScaledPoints,
    samples: &[f64],
    (out, stride): (&mut [f64], usize),
) {
    let d = points.kernel.inputs();
    let signal_variance = simd.splat_f64s(points.kernel.signal_variance);
    let vectors = LANES / S::F64_LANES;
    let (groups, _) = S::as_simd_f64s(&points.groups);
    for (g, group) in groups.chunks_exact(d * vectors).enumerate() {
        for pair in (0..vectors).step_by(2) {
            let mut square = [[simd.splat_f64s(0.0); 2]; C];
            for (f, z) in group.chunks_exact(vectors).enumerate() {
                for (c, square) in square.iter_mut().enumerate() {
                    let x = simd.splat_f64s(samples[c * d + f]);
                    for (v, square) in square.iter_mut().enumerate() {
                        let distance = simd.sub_f64s(z[pair + v], x);
                        *square = simd.mul_add_e_f64s(distance, distance, *square);
                    }
                }
            }
            for (c, square) in square.iter().enumerate() {
                for (v, &square) in square.iter().enumerate() {
                    let exponent = simd.mul_f64s(simd.splat_f64s(-0.5), square);
                    let k = simd.mul_f64s(signal_variance, exp(simd, exponent));
                    let first = g * LANES + (pair + v) * S::F64_LANES;
                    let end = points.points.min(first + S::F64_LANES);
                    if first < end {
                        simd.partial_store_f64s(&mut out[c * stride..][first..end], k);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn covariances_are_those_of_the_plain_kernel_for_any_number_of_points_and_samples() {
        for (n, samples, d) in [(1, 1, 1), (2, 4, 3), (15, 5, 21), (16, 3, 2), (33, 9, 28)] {
            let number = |i: usize| (1.0 + i as f64 * 0.7).sin() * 2.0;
            let x: Vec<f64> = (0..n * d).map(number).collect();
            let s: Vec<f64> = (0..samples * d).map(|i| number(3 * i + 1)).collect();
            let length_scales = (0..d).map(|i| 0.5 + i as f64).collect();
            let kernel = GaussianKernel { signal_variance: 2.5, length_scales };
            let stride = n + 2;
            let mut out = vec![-7.0; stride * samples];
            ScaledPoints::new(&x, &kernel).covariances(&s, &mut out, stride);
            for (sample, column) in s.chunks_exact(d).zip(out.chunks_exact(stride)) {
                for (point, &k) in x.chunks_exact(d).zip(column) {
                    let expected = kernel.value(point, sample);
                    assert!((k - expected).abs() <= 1e-14 * expected.max(1e-3), "{k} {expected}");
                }
                assert_eq!(column[n..], [-7.0, -7.0]);
            }
        }
    }
}
