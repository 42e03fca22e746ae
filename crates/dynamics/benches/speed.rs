//! The loops of the dynamics on the Barrett WAM, and a whole regression.

#![allow(clippy::unwrap_used, reason = "a benchmark that cannot build its input has failed")]

use std::path::Path;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use dynamics::{ColumnSet, Dynamics, NormalEquations, Rotors, base_parameters};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use robot::Robot;

const SAMPLES: usize = 130_000;

/// Samples whose regressor is held at once by a thread: 64 x 7 rows of 70 numbers, 250 kB.
const BLOCK: usize = 64;

struct State {
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
}

fn wam() -> Robot {
    let urdf = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/wam7/robot.urdf");
    Robot::load(&urdf).unwrap().robot
}

fn states(count: usize, n: usize) -> Vec<State> {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut draw = |range: f64| (0..n).map(|_| rng.random_range(-range..range)).collect();
    (0..count).map(|_| State { q: draw(2.0), qd: draw(2.0), qdd: draw(5.0) }).collect()
}

fn loops(c: &mut Criterion) {
    let dynamics = Dynamics::new(&wam());
    let (n, mut ws) = (dynamics.joint_count(), dynamics.workspace());
    let states = states(1000, n);
    let mut turn = states.iter().cycle();
    let mut next = move || turn.next().unwrap();
    let (mut tau, mut m, mut y) = (vec![0.0; n], vec![0.0; n * n], vec![0.0; 10 * n * n]);
    let mut group = c.benchmark_group("wam");
    group.bench_function("inverse_dynamics", |b| {
        b.iter_batched(
            &mut next,
            |s| dynamics.inverse_dynamics_into(&mut ws, &s.q, &s.qd, &s.qdd, &mut tau),
            BatchSize::SmallInput,
        );
    });
    let mut derivatives = [(); 3].map(|()| vec![0.0; n * n]);
    group.bench_function("inverse_dynamics_derivatives", |b| {
        b.iter_batched(
            &mut next,
            |s| {
                let [dq, dqd, dqdd] = &mut derivatives;
                let state = [s.q.as_slice(), &s.qd, &s.qdd];
                dynamics.inverse_dynamics_derivatives_into(&mut ws, state, [dq, dqd, dqdd]);
            },
            BatchSize::SmallInput,
        );
    });
    group.bench_function("mass_matrix", |b| {
        b.iter_batched(
            &mut next,
            |s| dynamics.mass_matrix_into(&mut ws, &s.q, &mut m),
            BatchSize::SmallInput,
        );
    });
    group.bench_function("forward_dynamics", |b| {
        b.iter_batched(
            &mut next,
            |s| {
                tau.copy_from_slice(&s.qdd);
                dynamics.forward_dynamics_into(&mut ws, &s.q, &s.qd, Rotors::Excluded, &mut tau)
            },
            BatchSize::SmallInput,
        );
    });
    group.bench_function("torque_regressor", |b| {
        b.iter_batched(
            &mut next,
            |s| dynamics.torque_regressor_into(&mut ws, &s.q, &s.qd, &s.qdd, &mut y),
            BatchSize::SmallInput,
        );
    });
}

/// Regressor rows of all samples and the base parameters that fit `tau` best.
fn regression(dynamics: &Dynamics, states: &[State], tau: &[f64], base: &[usize]) -> Vec<f64> {
    let n = dynamics.joint_count();
    let start =
        || (dynamics.workspace(), vec![0.0; 10 * n * n * BLOCK], NormalEquations::new(10 * n));
    let equations = states
        .par_chunks(BLOCK)
        .zip(tau.par_chunks(BLOCK * n))
        .fold(start, |(mut ws, mut rows, mut equations), (states, tau)| {
            for (s, y) in states.iter().zip(rows.chunks_exact_mut(10 * n * n)) {
                dynamics.torque_regressor_into(&mut ws, &s.q, &s.qd, &s.qdd, y);
            }
            equations.add(&rows[..10 * n * tau.len()], tau).unwrap();
            (ws, rows, equations)
        })
        .map(|(_, _, equations)| equations)
        .reduce(
            || NormalEquations::new(10 * n),
            |mut sum, part| {
                sum.merge(&part).unwrap();
                sum
            },
        );
    equations.solve(base).unwrap().as_slice().to_vec()
}

fn whole_regression(c: &mut Criterion) {
    let robot = wam();
    let (dynamics, n) = (Dynamics::new(&robot), robot.joint_count());
    let states = states(SAMPLES, n);
    let tau: Vec<f64> = states
        .iter()
        .flat_map(|s| dynamics.inverse_dynamics(&s.q, &s.qd, &s.qdd).unwrap().as_slice().to_vec())
        .collect();
    let base = base_parameters(&robot, ColumnSet::INERTIAL);
    let pi: Vec<f64> = robot.links().iter().flat_map(|l| l.inertia.parameters()).collect();
    let expected = base.project(&pi).unwrap();
    let found = regression(&dynamics, &states, &tau, &base.independent);
    let worst = expected.iter().zip(&found).map(|(e, f)| (e - f).abs()).fold(0.0, f64::max);
    assert!(worst < 1e-8, "the regression misses the parameters by {worst}");
    let mut group = c.benchmark_group("regression");
    group.sample_size(10);
    group.bench_function("130000 samples x 7 joints", |b| {
        b.iter(|| regression(&dynamics, &states, &tau, &base.independent));
    });
    group.finish();
    if let Ok(status) = std::fs::read_to_string("/proc/self/status") {
        status.lines().filter(|l| l.starts_with("VmHWM")).for_each(|l| println!("peak memory {l}"));
    }
}

criterion_group!(benches, loops, whole_regression);
criterion_main!(benches);
