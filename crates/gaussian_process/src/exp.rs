use pulp::{Simd, bytemuck};

/// Below this `e^x` is smaller than the smallest normal number; `n = -1023`, whose power of two is
/// stored as zero, is the nearest integer to `FLOOR log2(e)`.
const FLOOR: f64 = -1023.0 * std::f64::consts::LN_2;

/// `1.5 2^52`: a number below 2^51 added to it is rounded to an integer, and stays as one in the
/// low bits; the exponent bias 1023 is added in the same step.
const ROUND: f64 = 6_755_399_441_055_744.0 + 1023.0;

/// `ln 2` in two parts: the first has 32 bits, so that its product with an integer is exact
/// (Cody & Waite 1980).
const LN_2_HIGH: f64 = 6.931_471_803_691_238e-1;
const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// Coefficients, from r^11 down, of the polynomial `1 + r + ...` of degree 11 whose largest relative
/// distance from `e^r` on `|r| <= ln(2) / 2` is the smallest, 3.6e-18 (Remez exchange).
const COEFFICIENTS: [f64; 12] = [
    2.500_005_660_451_325_7e-8,
    2.763_024_833_611_640_6e-7,
    2.755_758_638_842_914e-6,
    2.480_149_309_903_041_7e-5,
    1.984_126_950_656_4e-4,
    1.388_888_894_362_999e-3,
    8.333_333_333_494_468e-3,
    4.166_666_666_653_016e-2,
    1.666_666_666_666_641_3e-1,
    5.000_000_000_000_011e-1,
    1.0,
    1.0,
];

/// `e^x` of every lane, for `x <= 709`:
///
/// ```text
/// n = round(x / ln 2),   r = x - n ln 2,   e^x = 2^n e^r,   |r| <= ln(2) / 2
/// ```
///
/// within 3e-16 of its value, relatively, where that is a normal number (x >= -708.3); below
/// -708.8 it is zero. NaN stays NaN.
#[inline(always)]
pub(crate) fn exp<S: Simd>(simd: S, x: S::f64s) -> S::f64s {
    let [value] = exp_each(simd, [x]);
    value
}

/// [`exp`] of `N` vectors, step by step together: one alone waits for each of its steps.
#[inline(always)]
pub(crate) fn exp_each<S: Simd, const N: usize>(simd: S, x: [S::f64s; N]) -> [S::f64s; N] {
    let splat = |value: f64| simd.splat_f64s(value);

    // n, held as an integer in the low bits of `shifted`, and r.
    let (mut r, mut shifted) = (x, x);
    for (r, shifted) in r.iter_mut().zip(&mut shifted) {
        // A comparison with NaN is false, so that NaN passes.
        let x = simd.select_f64s(simd.less_than_f64s(*r, splat(FLOOR)), splat(FLOOR), *r);
        *shifted = simd.mul_add_e_f64s(x, splat(std::f64::consts::LOG2_E), splat(ROUND));
        let n = simd.sub_f64s(*shifted, splat(ROUND));
        *r = simd.negate_mul_add_e_f64s(n, splat(LN_2_HIGH), x);
        *r = simd.negate_mul_add_e_f64s(n, splat(LN_2_LOW), *r);
    }

    // e^r by Horner's rule.
    let mut p = [splat(COEFFICIENTS[0]); N];
    for &coefficient in &COEFFICIENTS[1..] {
        for (p, r) in p.iter_mut().zip(&r) {
            *p = simd.mul_add_e_f64s(*p, *r, splat(coefficient));
        }
    }

    // 2^n: the biased exponent moved from the low bits to its place.
    for bits in bytemuck::cast_slice_mut::<_, u64>(&mut shifted) {
        *bits <<= 52;
    }
    for (p, power) in p.iter_mut().zip(&shifted) {
        *p = simd.mul_f64s(*p, *power);
    }
    p
}

#[cfg(test)]
mod tests {
    use super::exp;
    use pulp::{Arch, Scalar, Simd, WithSimd};

    /// `e^x` of every entry, in place.
    struct InPlace<'a>(&'a mut [f64]);

    impl WithSimd for InPlace<'_> {
        type Output = ();

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) {
            let (vectors, tail) = S::as_mut_simd_f64s(self.0);
            assert!(tail.is_empty());
            for x in vectors {
                *x = exp(simd, *x);
            }
        }
    }

    /// One name and result for every instruction set of this machine.
    fn on_every_instruction_set(x: &[f64]) -> Vec<(&'static str, Vec<f64>)> {
        let mut results = Vec::new();
        let mut run = |name, evaluate: &dyn Fn(InPlace)| {
            let mut values = x.to_vec();
            evaluate(InPlace(&mut values));
            results.push((name, values));
        };
        run("scalar", &|x| x.with_simd(Scalar));
        #[cfg(target_arch = "x86_64")]
        if let Some(simd) = pulp::x86::V3::try_new() {
            run("AVX2", &|x| Simd::vectorize(simd, x));
        }
        run("best", &|x| Arch::new().dispatch(x));
        results
    }

    #[test]
    fn exponential_is_within_3e_16_of_the_standard_library() {
        let x: Vec<f64> =
            (0..1 << 20).map(|i| 2.0 - f64::from(i) * (710.4 / 1_048_576.0)).collect();
        for (name, values) in on_every_instruction_set(&x) {
            let error = |(x, value): (&f64, &f64)| (value / x.exp() - 1.0).abs();
            let worst = x.iter().zip(&values).map(error).fold(0.0, f64::max);
            assert!(worst <= 3e-16, "{name}: {worst:e}");
        }
    }

    #[test]
    fn exponential_ends_in_zero_and_passes_nan() {
        let x = [0.0, -0.0, 709.0, -708.8, -745.0, -746.0, -1e300, f64::NEG_INFINITY];
        let expected = [1.0, 1.0, 709f64.exp(), 0.0, 0.0, 0.0, 0.0, 0.0];
        for (name, values) in on_every_instruction_set(&x) {
            for ((x, value), expected) in x.iter().zip(&values).zip(&expected) {
                let distance = (value - expected).abs();
                assert!(distance <= 3e-16 * expected, "{name}: exp({x}) = {value:e}");
            }
        }
        let payload = f64::from_bits(f64::NAN.to_bits() | 0x8_0000_0123);
        let no_numbers = [payload, -payload, f64::NAN, -f64::NAN].repeat(2);
        for (name, values) in on_every_instruction_set(&no_numbers) {
            assert!(values.iter().all(|v| v.is_nan()), "{name}: {values:?}");
        }
    }
}
