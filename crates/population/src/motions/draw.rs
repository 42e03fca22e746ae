//! Motions of an arm, kind by kind.

use motion::{Chirp, Growth, MotionSpec, Sinusoids};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::corner::MotionClass;
use crate::dice::{between, happens, one_of, round_to_digits};
use crate::error::PopulationError;
use crate::motions::ground::Ground;
use crate::motions::log_plan::LogPlan;
use crate::motions::{by_joint, postures};

/// Draws of a motion before an arm is rejected. Each infeasible motion makes the next one smaller.
const TRIES: usize = 20;
/// Tolerated excess over the wished length of a motion (s).
const LONGER_S: f64 = 0.05;

/// Draws a motion of a kind that the arm can follow; `None` where no draw was feasible.
pub(crate) fn draw(
    class: MotionClass,
    ground: &Ground<'_>,
    wished: LogPlan,
    random: &mut ChaCha8Rng,
) -> Result<Option<MotionSpec>, PopulationError> {
    // Moves between the parts of a sequence make it longer than its parts.
    let (mut moves_s, mut scale) = (0.0, 1.0);
    for _ in 0..TRIES {
        let ground = ground.smaller(scale);
        let place = LogPlan { length_s: (wished.length_s - moves_s).max(1.0), ..wished };
        let spec = match class {
            MotionClass::JointByJoint => by_joint::one_by_one(&ground, place, random),
            MotionClass::Sinusoids => sinusoids(&ground, place.length_s, random),
            MotionClass::PointToPoint => postures::point_to_point(&ground, place.length_s, random),
            MotionClass::PickAndPlace => postures::pick_and_place(&ground, place.length_s, random),
            MotionClass::Sweep => sweep(&ground, place.length_s, random),
            MotionClass::LedByHand => postures::lead_by_hand(&ground, place.length_s, random),
            MotionClass::SwingUp => by_joint::swing_up(&ground, place.length_s, random),
            MotionClass::Repeated => task(&ground, place.length_s, random),
        };
        match ground.feasible_length_s(&spec)? {
            Some(length_s) if length_s <= wished.length_s + LONGER_S => return Ok(Some(spec)),
            Some(length_s) => moves_s += length_s - wished.length_s,
            None => scale *= 0.88,
        }
    }
    Ok(None)
}

/// A task that is done again and again.
fn task(ground: &Ground<'_>, length_s: f64, random: &mut ChaCha8Rng) -> MotionSpec {
    match random.random_range(0..4) {
        0 | 1 => postures::pick_and_place(ground, length_s, random),
        2 => postures::point_to_point(ground, length_s, random),
        _ => sinusoids(ground, length_s, random),
    }
}

fn sinusoids(ground: &Ground<'_>, length_s: f64, random: &mut ChaCha8Rng) -> MotionSpec {
    let lowest_hz =
        round_to_digits(between(random, [0.05, 0.2]), 2).max(round_to_digits(1.0 / length_s, 2));
    // Amplitudes follow from speeds; the highest frequency sets the accelerations.
    let brisk = ground.acceleration.iter().zip(&ground.speed).map(|(a, v)| a / v);
    let highest_hz = brisk.fold(f64::INFINITY, f64::min) / std::f64::consts::TAU;
    let highest_hz = round_to_digits(between(random, [0.5, 1.0]) * highest_hz, 2);
    let amplitude = ground.half.iter().map(|half| half * between(random, [0.4, 1.0]));
    // Joints of different speed keep to the slower of way and speed.
    let of = |(a, v): (f64, &f64)| {
        let hz = 0.5 * (lowest_hz + highest_hz.max(1.2 * lowest_hz));
        round_to_digits(a.min(v / (std::f64::consts::TAU * hz)), 4)
    };
    let amplitude: Vec<f64> = amplitude.zip(&ground.speed).map(of).collect();
    MotionSpec::Sinusoids(Sinusoids {
        seed: u64::from(random.random::<u32>()),
        terms: random.random_range(2..=5),
        lowest_hz,
        highest_hz: highest_hz.max(1.2 * lowest_hz),
        duration_s: length_s,
        amplitude_rad: ground.names.iter().cloned().zip(amplitude).collect(),
        centre_rad: ground.names.iter().cloned().zip(ground.middle.iter().copied()).collect(),
        max_speed_rad_per_s: Default::default(),
        position_share: 0.8,
        velocity_share: 0.8,
        fade_s: (0.2 * length_s).min(2.0),
    })
}

/// Bands of a sweep (Hz). From one to the next the amplitude falls and the acceleration rises.
const BANDS: [[f64; 2]; 3] = [[0.2, 0.8], [0.8, 3.0], [3.0, 10.0]];
/// Acceleration of small fast swings over that of everyday motions.
const SHAKEN: f64 = 2.5;

/// Three chirps, each smaller and faster; about half of the joints swing, or all.
fn sweep(ground: &Ground<'_>, length_s: f64, random: &mut ChaCha8Rng) -> MotionSpec {
    let posture = ground.smaller(0.5).posture(random);
    let all = happens(random, 0.5);
    let first = random.random_range(0..ground.count());
    let swings: Vec<bool> =
        (0..ground.count()).map(|j| all || j == first || happens(random, 0.4)).collect();
    let named = |values: &[f64]| ground.names.iter().cloned().zip(values.iter().copied()).collect();
    let chirps = BANDS.iter().zip([0.4, 0.3, 0.3]).map(|(&[from_hz, to_hz], share)| {
        let w = std::f64::consts::TAU * to_hz;
        let amplitude = |(j, swings): (usize, &bool)| {
            let by_speed = ground.speed[j] / w;
            let by_acceleration = SHAKEN * ground.acceleration[j] / (w * w);
            let room = 0.5 * ground.half[j];
            let most = room.min(by_speed).min(by_acceleration);
            if *swings { round_to_digits(most * between(random, [0.5, 1.0]), 4) } else { 0.0 }
        };
        let amplitude: Vec<f64> = swings.iter().enumerate().map(amplitude).collect();
        let duration_s = share * length_s;
        MotionSpec::Chirp(Chirp {
            amplitude_rad: named(&amplitude),
            posture_rad: named(&posture),
            from_hz,
            to_hz,
            growth: one_of(random, [Growth::Linear, Growth::Logarithmic]),
            duration_s,
            fade_s: (0.2 * duration_s).min(1.0),
        })
    });
    MotionSpec::Sequence(chirps.collect())
}
