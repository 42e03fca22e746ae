//! Standard errors of a whole arm under noise with a long memory.

use checks::arms::{generator, wam};
use dynamics::{ColumnSet, Dynamics};
use learner::{Regression, SampleSlices};
use rand_distr::{Distribution, StandardNormal};

const SECONDS: usize = 60;
const RATE: usize = 200;
/// As many as `(1 + MEMORY) / (1 - MEMORY) = 199` samples count as one.
const MEMORY: f64 = 0.99;
const RECORDS: u64 = 12;

/// Position, velocity and acceleration of joint `joint` at `t`: five sinusoids.
fn motion(joint: usize, t: f64) -> [f64; 3] {
    (1..=5).fold([0.0; 3], |[q, qd, qdd], k| {
        let w = 0.9 * k as f64 + 0.13 * joint as f64;
        let phase = w * t + (3 * k * k + 5 * joint * k) as f64;
        let a = 0.5 / k as f64;
        [q + a * phase.sin(), qd + a * w * phase.cos(), qdd - a * w * w * phase.sin()]
    })
}

#[test]
fn intervals_of_every_base_parameter_of_the_wam_hold_what_was_put_in() {
    let robot = wam();
    let dynamics = Dynamics::new(&robot);
    let samples = SECONDS * RATE;
    let states: Vec<[f64; 3]> =
        (0..7 * samples).map(|i| motion(i % 7, (i / 7) as f64 / RATE as f64)).collect();
    let [q, qd, qdd] = [0, 1, 2].map(|k| states.iter().map(|s| s[k]).collect::<Vec<f64>>());
    let exact: Vec<f64> = (0..samples)
        .flat_map(|k| {
            let at = 7 * k..7 * k + 7;
            let (q, qd, qdd) = (&q[at.clone()], &qd[at.clone()], &qdd[at]);
            let mut tau = dynamics.inverse_dynamics(q, qd, qdd).unwrap();
            dynamics.add_rotor_torque(qdd, tau.as_mut_slice()).unwrap();
            tau.iter().copied().collect::<Vec<f64>>()
        })
        .collect();
    let noise_sd = [1.0, 1.0, 0.5, 0.4, 0.05, 0.04, 0.02];
    let (mut inside, mut white, mut all) = (0.0, 0.0, 0.0);
    for seed in 0..RECORDS {
        let mut rng = generator(seed);
        let mut draw = || -> f64 { StandardNormal.sample(&mut rng) };
        let mut state = [(); 7].map(|()| draw());
        let fresh = (1.0 - MEMORY * MEMORY).sqrt();
        let noisy = exact.iter().enumerate().map(|(i, tau)| {
            state[i % 7] = MEMORY * state[i % 7] + fresh * draw();
            tau + noise_sd[i % 7] * state[i % 7]
        });
        let tau: Vec<f64> = noisy.collect();
        let mut regression = Regression::new(&robot, ColumnSet::ALL);
        regression.add(SampleSlices { q: &q, qd: &qd, qdd: &qdd, tau: &tau }).unwrap();
        let fit = regression.fit(None).unwrap();
        let bodies = robot.links().iter().flat_map(|link| link.inertia.parameters());
        let rotors = robot.links().iter().map(|link| link.actuator.rotor_inertia);
        let pi: Vec<f64> = bodies.chain(rotors).chain([0.0; 21]).collect();
        let truth = fit.base.project(&pi).unwrap();
        let (found, covariance) = fit.base_parameters();
        // Quantile 0.975 of Student's t.
        let nu = (fit.groups - 1) as f64;
        let t = 1.96 + 2.37 / nu + 2.82 / (nu * nu);
        for i in 0..truth.len() {
            let off = (found[i] - truth[i]).abs() / covariance[(i, i)].sqrt();
            all += 1.0;
            inside += f64::from(off < t);
            white += f64::from(off < t / 199.0_f64.sqrt());
        }
    }
    assert!((0.88..0.99).contains(&(inside / all)), "{}", inside / all);
    assert!(white / all < 0.25, "{}", white / all);
}
