//! Noise that remembers is not taken for a cause.

use checks::synthetic::Noise;
use logs::Run;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

use crate::world::{World, against_nominal, named};

const LOGS: u64 = 40;

/// Time after which the noise has forgotten all but 1/e of itself (s).
const MEMORY_S: f64 = 0.3;

/// Logs with any finding: two were expected at a probability of 5 %, and more than four are seen once in
/// a hundred times then.
const MOST: usize = 4;

/// Adds to the effort of every joint noise of the same RMS as the white noise of
/// [`Noise::of_a_wam`], all of it slow: `x_t = a x_{t-1} + sqrt(1 - a^2) sd z_t`.
fn coloured(runs: &mut [Run], seed: u64) {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let a = (-1.0 / (250.0 * MEMORY_S)).exp();
    for run in runs {
        for (joint, sd) in run.joints.iter_mut().zip(Noise::of_a_wam().effort) {
            let mut draw = || -> f64 { StandardNormal.sample(&mut rng) };
            let mut x = draw();
            for effort in &mut joint.effort {
                *effort += sd * x;
                x = a * x + (1.0 - a * a).sqrt() * draw();
            }
        }
    }
}

#[test]
fn slow_noise_is_called_a_cause_in_at_most_a_tenth_of_the_logs() {
    let world = World::nominal();
    let still = Noise { effort: vec![0.0; 7], ..Noise::of_a_wam() };
    let alarms: Vec<(u64, Vec<String>)> = (0..LOGS)
        .into_par_iter()
        .map(|seed| {
            let mut runs = world.runs(3, 20.0, &still, 6000 + seed);
            coloured(&mut runs, seed);
            (seed, named(&against_nominal(&runs).diagnosis))
        })
        .filter(|(_, findings)| !findings.is_empty())
        .collect();
    println!("findings in {} of {LOGS} logs of slow noise: {alarms:?}", alarms.len());
    assert!(alarms.len() <= MOST, "{alarms:?}");
}
