//! Prints the time of one inverse dynamics of the WAM (ns) and a checksum, and the same of its
//! derivatives, for the comparison with Pinocchio: `pinocchio.cpp` does the same with the same states. Of whole arrays
//! it prints the time of a sample too. `tests/benches/compare_peers.sh` runs both.

#![allow(clippy::unwrap_used, reason = "a benchmark that cannot build its input has failed")]

use std::path::Path;
use std::time::Instant;

use dynamics::Dynamics;
use robot::Robot;

const STATES: usize = 1000;
const ROUNDS: usize = 300;
/// Samples of whole arrays, and how often they are gone through.
const SAMPLES: usize = 100_000;
const ARRAY_ROUNDS: usize = 10;

fn main() {
    let wam = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/wam7/robot.urdf");
    let dynamics = Dynamics::new(&Robot::load(&wam).unwrap().robot);
    let (n, mut ws) = (dynamics.joint_count(), dynamics.workspace());
    // The linear congruential generator of Knuth's MMIX, as in pinocchio.cpp.
    let mut seed = 1_u64;
    let mut draw = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        4.0 * ((seed >> 11) as f64 / (1_u64 << 53) as f64) - 2.0
    };
    let states: Vec<Vec<f64>> = (0..STATES).map(|_| (0..3 * n).map(|_| draw()).collect()).collect();
    let mut tau = vec![0.0; n];
    let mut inverse_dynamics = |[q, qd, qdd]: [&[f64]; 3]| {
        dynamics.inverse_dynamics_into(&mut ws, q, qd, qdd, &mut tau);
        tau[0] + tau[n - 1]
    };
    time("rnea", &states, &mut inverse_dynamics);
    let (mut ws, mut matrices) = (dynamics.workspace(), [(); 3].map(|()| vec![0.0; n * n]));
    let mut derivatives = |state: [&[f64]; 3]| {
        let [dq, dqd, dqdd] = &mut matrices;
        dynamics.inverse_dynamics_derivatives_into(&mut ws, state, [dq, dqd, dqdd]);
        dq[n - 1] + dqd[n - 1] + dqdd[n - 1]
    };
    time("derivatives", &states, &mut derivatives);
    let arrays = [(); 3].map(|()| (0..SAMPLES * n).map(|_| draw()).collect::<Vec<f64>>());
    time_arrays(&dynamics, &arrays);
}

/// Prints the least time of a sample where the torque of all samples becomes an array, row by row, and its sum.
fn time_arrays(dynamics: &Dynamics, arrays: &[Vec<f64>; 3]) {
    let (n, mut fastest, mut checksum) = (dynamics.joint_count(), f64::INFINITY, 0.0);
    for _ in 0..ARRAY_ROUNDS {
        let start = Instant::now();
        let (mut ws, mut tau) = (dynamics.workspace(), vec![0.0; SAMPLES * n]);
        let [q, qd, qdd] = arrays.each_ref().map(|all| all.chunks_exact(n));
        for (((tau, q), qd), qdd) in tau.chunks_exact_mut(n).zip(q).zip(qd).zip(qdd) {
            dynamics.inverse_dynamics_into(&mut ws, q, qd, qdd, tau);
        }
        fastest = fastest.min(start.elapsed().as_nanos() as f64 / SAMPLES as f64);
        checksum = tau.iter().sum();
    }
    println!("arrays {fastest:.1} {checksum:.6}");
}

/// Prints the least time of one `evaluate` over all rounds, and the sum of what it returns.
fn time(what: &str, states: &[Vec<f64>], evaluate: &mut dyn FnMut([&[f64]; 3]) -> f64) {
    let (mut fastest, mut checksum) = (f64::INFINITY, 0.0);
    for _ in 0..ROUNDS {
        checksum = 0.0;
        let start = Instant::now();
        for state in states {
            let (q, rates) = state.split_at(state.len() / 3);
            let (qd, qdd) = rates.split_at(q.len());
            checksum += evaluate([q, qd, qdd]);
        }
        fastest = fastest.min(start.elapsed().as_nanos() as f64 / STATES as f64);
    }
    println!("{what} {fastest:.1} {checksum:.6}");
}
