/// One plot: what was simulated, and what the closed form says.
pub struct Panel {
    pub name: &'static str,
    /// What there is to see, with the size that was put in.
    pub note: String,
    pub x: Axis,
    pub y: Axis,
    /// With the effect.
    pub with: Series,
    /// Without it, where that is not zero or one.
    pub without: Vec<[f64; 2]>,
    /// What the closed form says.
    pub expected: Vec<Vec<[f64; 2]>>,
}

/// Quantity, unit and scale.
pub struct Axis {
    pub label: &'static str,
    pub scale: Scale,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    Linear,
    Logarithmic,
}

pub enum Series {
    Dots(Vec<[f64; 2]>),
    Line(Vec<[f64; 2]>),
}

impl Series {
    pub fn points(&self) -> &[[f64; 2]] {
        match self {
            Self::Dots(points) | Self::Line(points) => points,
        }
    }
}

pub fn linear(label: &'static str) -> Axis {
    Axis { label, scale: Scale::Linear }
}

pub fn logarithmic(label: &'static str) -> Axis {
    Axis { label, scale: Scale::Logarithmic }
}

/// Points of two signals in the given rows, scaled.
pub fn points(rows: &[usize], x: (&[f64], f64), y: &[f64]) -> Vec<[f64; 2]> {
    rows.iter().map(|&i| [x.0[i] * x.1, y[i]]).collect()
}

/// `count` steps from `from` to `to`, ends included.
pub fn steps(from: f64, to: f64, count: u32) -> Vec<f64> {
    (0..=count).map(|k| from + (to - from) * f64::from(k) / f64::from(count)).collect()
}

/// The points of a curve over `at`.
pub fn curve(at: &[f64], of: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    at.iter().map(|&x| [x, of(x)]).collect()
}

/// Least and largest of some values.
pub fn range(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    values.into_iter().fold(start, |(low, high), x| (low.min(x), high.max(x)))
}
