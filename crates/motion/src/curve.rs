use crate::{harmonics::Harmonics, knots::Knots, rising_sine::RisingSine};

/// A closed form of the positions of all joints over the time of its clock.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Curve {
    Harmonics(Harmonics),
    RisingSine(RisingSine),
    Knots(Knots),
}

/// Instants in one period of the highest frequency.
const PER_PERIOD: f64 = 64.0;

/// Instants between two knots; a polynomial of degree five turns at most four times.
const PER_PIECE: usize = 8;

impl Curve {
    /// Position of a joint and its two derivatives at a time (s).
    pub(crate) fn at(&self, joint: usize, t: f64) -> [f64; 3] {
        match self {
            Self::Harmonics(curve) => curve.at(joint, t),
            Self::RisingSine(curve) => curve.at(joint, t),
            Self::Knots(curve) => curve.at(joint, t),
        }
    }

    /// Bounds of the magnitude of a joint's acceleration (rad/s² or m/s²) and of its derivative, where they are known.
    pub(crate) fn steepest(&self, joint: usize) -> Option<[f64; 2]> {
        match self {
            Self::Harmonics(curve) => Some(curve.steepest(joint)),
            Self::RisingSine(_) | Self::Knots(_) => None,
        }
    }

    /// Times from 0 to `until` (s), so dense that the curve hardly bends between two.
    pub(crate) fn instants(&self, until: f64) -> Box<dyn Iterator<Item = f64> + '_> {
        let even = |highest_hz: f64| {
            let count = (until * highest_hz * PER_PERIOD).ceil().max(1.0) as usize;
            (0..=count).map(move |k| until * k as f64 / count as f64)
        };
        match self {
            Self::Harmonics(curve) => Box::new(even(curve.highest_hz())),
            Self::RisingSine(curve) => Box::new(even(curve.highest_hz())),
            Self::Knots(curve) => Box::new(curve.instants(PER_PIECE)),
        }
    }
}
