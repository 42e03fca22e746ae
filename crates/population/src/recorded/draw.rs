use std::f64::consts::PI;

use logs::Run;
use rand::{Rng, RngExt};
use rand_chacha::ChaCha8Rng;
use robot::Robot;

use crate::recorded::cut::rate_hz;
use crate::recorded::law::{AddedLaw, most_periods};
use crate::recorded::point_mass::PointMass;
use crate::recorded::size::Measured;
use crate::recorded::transplant::Transplant;

/// Least and largest RMS of the torque added to a joint, over the RMS of its effort.
const SHARES: [f64; 2] = [0.03, 0.5];

/// Number of laws, equally likely.
const LAWS: usize = 12;

/// Periods in a turn of the ripples that are drawn, where the log resolves them.
const PERIODS: [f64; 2] = [20.0, 200.0];

/// Largest mass of a payload (kg).
const HEAVIEST: f64 = 50.0;

/// Largest time by which efforts come later or earlier (s).
const LATEST_S: f64 = 0.05;

/// Trial skew from which the size of a skew is scaled (s).
const SOME_SKEW_S: f64 = 0.002;

/// Draws a transplant: a joint that moves, a law and a size. The size is log-uniform from .03 to .5 of the RMS
/// effort of the joint; for a payload and a skew, of the joint where that share is largest. `None` where no joint
/// moves.
pub(super) fn draw(robot: &Robot, runs: &[Run], random: &mut ChaCha8Rng) -> Option<Transplant> {
    let measured = Measured::new(robot, runs);
    if measured.moving.is_empty() {
        return None;
    }
    let joint = measured.moving[random.random_range(0..measured.moving.len())];
    let law = some_law(&measured, joint, random);
    let share = log_uniform(SHARES, random);
    let unit = Transplant { law, joint };
    let of_unit = measured.share(&unit.added_torque(robot, runs));
    let factor = if of_unit > 0.0 { share / of_unit } else { 1.0 };
    Some(Transplant { law: within_bounds(law.times(factor)), joint })
}

/// A law of some size.
fn some_law(measured: &Measured, joint: usize, random: &mut ChaCha8Rng) -> AddedLaw {
    let (low, high) = measured.range(joint);
    let side = |random: &mut ChaCha8Rng| if random.random_bool(0.5) { 1.0 } else { -1.0 };
    let inside = |random: &mut ChaCha8Rng| low + (high - low) * random.random_range(0.25..0.75);
    match random.random_range(0..LAWS) {
        0 => AddedLaw::Coulomb { level: 1.0 },
        1 => AddedLaw::Viscous { viscous: 1.0 },
        2 => {
            let shift = side(random) * random.random_range(0.3..1.0);
            AddedLaw::Asymmetric { forward: 1.0 + shift, backward: 1.0 - shift }
        }
        3 => AddedLaw::Offset { offset: side(random) },
        4 => AddedLaw::Gain { gain: 1.0 + side(random) },
        5 => AddedLaw::Spring { stiffness: 1.0, rest: inside(random) },
        6 => AddedLaw::Load { coefficient: 1.0 },
        7 => {
            let rate_hz = measured.runs.first().map_or(0.0, rate_hz);
            let most = most_periods(rate_hz, measured.speed_rms(joint)).min(PERIODS[1]);
            let periods = log_uniform([PERIODS[0].min(0.5 * most), most], random).round().max(1.0);
            AddedLaw::Ripple { amplitude: 1.0, periods, phase: random.random_range(-PI..PI) }
        }
        8 => AddedLaw::Drag { coefficient: 1.0 },
        9 => {
            let width = (high - low) * random.random_range(0.03..0.1);
            AddedLaw::Well { peak: 1.0, centre: inside(random), width }
        }
        10 => AddedLaw::PointMass(PointMass { mass: 1.0, com: somewhere(random) }),
        _ => AddedLaw::Late { skew: side(random) * SOME_SKEW_S },
    }
}

/// A place .05 to .15 m from the origin of a link, in any direction (m).
fn somewhere(random: &mut ChaCha8Rng) -> [f64; 3] {
    let height: f64 = random.random_range(-1.0..1.0);
    let turn: f64 = random.random_range(-PI..PI);
    let [radius, level] = [random.random_range(0.05..0.15), (1.0 - height * height).sqrt()];
    [radius * level * turn.cos(), radius * level * turn.sin(), radius * height]
}

/// Limits a law to sizes that arms have.
fn within_bounds(law: AddedLaw) -> AddedLaw {
    match law {
        AddedLaw::PointMass(body) => {
            AddedLaw::PointMass(PointMass { mass: body.mass.min(HEAVIEST), ..body })
        }
        AddedLaw::Late { skew } => AddedLaw::Late { skew: skew.clamp(-LATEST_S, LATEST_S) },
        _ => law,
    }
}

/// A log-uniform number.
fn log_uniform([low, high]: [f64; 2], random: &mut impl Rng) -> f64 {
    (low.ln() + (high / low).ln() * random.random::<f64>()).exp()
}
