//! A Kalman smoother that makes velocity and acceleration of positions, for comparison.

use nalgebra::SMatrix;

/// A signal whose `N - 1`-th derivative is driven by white noise, seen through white noise of the
/// variance `measured`.
///
/// ```text
/// x = (q, qd, qdd, ...),   F_ij = T^(j-i) / (j-i)!
/// Q_ij = density T^(a+b+1) / ((a+b+1) a! b!),   a = N-1-i, b = N-1-j
/// ```
#[derive(Clone, Copy)]
pub struct Smoother<const N: usize> {
    pub period_s: f64,
    pub density: f64,
    pub measured: f64,
}

type Square<const N: usize> = SMatrix<f64, N, N>;
type Column<const N: usize> = SMatrix<f64, N, 1>;

/// What the forward pass leaves: predicted and updated states, and the log-likelihood.
struct Pass<const N: usize> {
    predicted: Vec<(Column<N>, Square<N>)>,
    updated: Vec<(Column<N>, Square<N>)>,
    log_likelihood: f64,
}

fn factorial(n: usize) -> f64 {
    (1..=n).map(|k| k as f64).product()
}

impl<const N: usize> Smoother<N> {
    fn transition(&self) -> Square<N> {
        Square::from_fn(|i, j| match j.checked_sub(i) {
            Some(n) => self.period_s.powi(n as i32) / factorial(n),
            None => 0.0,
        })
    }

    fn driven(&self) -> Square<N> {
        Square::from_fn(|i, j| {
            let (a, b) = (N - 1 - i, N - 1 - j);
            let n = a + b + 1;
            self.density * self.period_s.powi(n as i32) / (n as f64 * factorial(a) * factorial(b))
        })
    }

    fn forward(&self, q: &[f64]) -> Pass<N> {
        let (f, driven) = (self.transition(), self.driven());
        let mut x = Column::<N>::zeros();
        x[0] = q[0];
        // Wide at first: 1e3 rad/s and so on.
        let mut p = Square::<N>::from_diagonal_element(1e6);
        let mut pass = Pass { predicted: vec![], updated: vec![], log_likelihood: 0.0 };
        for (k, measured) in q.iter().enumerate() {
            if k > 0 {
                x = f * x;
                p = f * p * f.transpose() + driven;
            }
            pass.predicted.push((x, p));
            let (innovation, variance) = (measured - x[0], p[(0, 0)] + self.measured);
            let gain = p.column(0) / variance;
            x += gain * innovation;
            // Joseph's form keeps it positive.
            let mut keep = Square::<N>::identity();
            keep.column_mut(0).axpy(-1.0, &gain, 1.0);
            p = keep * p * keep.transpose() + gain * gain.transpose() * self.measured;
            pass.updated.push((x, p));
            if k > N {
                pass.log_likelihood -= 0.5 * (innovation.powi(2) / variance + variance.ln());
            }
        }
        pass
    }

    /// The states at every sample, given all of them (Rauch, Tung & Striebel).
    pub fn smooth(&self, q: &[f64]) -> Vec<Column<N>> {
        let pass = self.forward(q);
        let f = self.transition();
        let last = q.len() - 1;
        let (mut x, mut p) = pass.updated[last];
        let mut states = vec![x; q.len()];
        for k in (0..last).rev() {
            let ((updated, pu), (predicted, pp)) = (pass.updated[k], pass.predicted[k + 1]);
            let Some(inverse) = pp.try_inverse() else { continue };
            let gain = pu * f.transpose() * inverse;
            x = updated + gain * (x - predicted);
            p = pu + gain * (p - pp) * gain.transpose();
            states[k] = x;
        }
        states
    }

    /// The same with the density that makes the positions most likely, to a tenth of a decade.
    pub fn most_likely(period_s: f64, measured: f64, q: &[f64]) -> Self {
        let of = |decades: f64| Self { period_s, density: 10_f64.powf(decades), measured };
        let best = |from: f64, to: f64, step: f64| {
            let count = ((to - from) / step) as usize;
            (0..=count)
                .map(|k| from + step * k as f64)
                .map(|d| (d, of(d).forward(q).log_likelihood))
                .max_by(|a, b| a.1.total_cmp(&b.1))
                .map_or(from, |(d, _)| d)
        };
        let coarse = best(-3.0, 9.0, 1.0);
        of(best(coarse - 1.0, coarse + 1.0, 0.1))
    }
}
