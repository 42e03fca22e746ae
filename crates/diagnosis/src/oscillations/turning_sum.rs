use nalgebra::Complex;

/// Terms that are summed side by side.
const LANES: usize = 8;

/// Terms of a sum over samples and the factor by which each turns from one value of the beat to the next, real and
/// imaginary parts apart.
pub(crate) struct TurningSum {
    now: [Vec<f64>; 2],
    turn: [Vec<f64>; 2],
}

impl TurningSum {
    pub fn new(
        now: impl Iterator<Item = Complex<f64>>,
        turn: impl Iterator<Item = Complex<f64>>,
    ) -> Self {
        let parts = |z: Vec<Complex<f64>>| {
            [z.iter().map(|z| z.re).collect(), z.iter().map(|z| z.im).collect()]
        };
        Self { now: parts(now.collect()), turn: parts(turn.collect()) }
    }

    /// The sum of the first `count` terms, which then turn on.
    pub fn sum_and_turn(&mut self, count: usize) -> Complex<f64> {
        let [re, im] = self.now.each_mut().map(|part| &mut part[..count]);
        let [cos, sin] = self.turn.each_ref().map(|part| &part[..count]);
        let mut sums = [[0.0; LANES]; 2];
        let terms = re.chunks_mut(LANES).zip(im.chunks_mut(LANES));
        for ((re, im), (cos, sin)) in terms.zip(cos.chunks(LANES).zip(sin.chunks(LANES))) {
            for (l, (re, im)) in re.iter_mut().zip(im).enumerate() {
                sums[0][l] += *re;
                sums[1][l] += *im;
                let turned = [*re * cos[l] - *im * sin[l], *re * sin[l] + *im * cos[l]];
                [*re, *im] = turned;
            }
        }
        let [re, im] = sums.map(|lanes| lanes.iter().sum());
        Complex::new(re, im)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `sum over t < count of exp(i (0.3 t + k 0.1 t))` at `k` = 0, 1, 2, with fewer terms each time.
    #[test]
    fn the_sum_is_that_of_the_terms_turned_on() {
        let of = |by: f64| (0..37).map(move |t| Complex::cis(by * f64::from(t)));
        let mut sum = TurningSum::new(of(0.3), of(0.1));
        for (k, count) in [(0_u32, 37), (1, 29), (2, 5)] {
            let expected: Complex<f64> = of(0.3 + 0.1 * f64::from(k)).take(count).sum();
            assert!((sum.sum_and_turn(count) - expected).norm() < 1e-12, "{k}");
        }
    }
}
