//! Time and memory of a whole diagnosis against the length of the log: WAM, 7 joints,
//! 500 Hz, one run, Coulomb friction at two joints and a payload hidden in it.
#![allow(missing_docs, reason = "criterion's macros make undocumented functions")]
#![allow(clippy::unwrap_used, reason = "a benchmark may stop")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

use checks::synthetic::{Noise, Truth, run_at, wam};
use diagnosis::{Settings, Silent, diagnose};

const RATE_HZ: f64 = 500.0;

fn lengths(c: &mut Criterion) {
    let robot = wam();
    let mut loaded = robot.clone();
    let palm = loaded.joint_count() - 1;
    loaded.link_mut(palm).unwrap().inertia.mass += 1.0;
    let friction = |j: usize, s: [f64; 3]| if j == 1 || j == 3 { 0.6 * s[1].signum() } else { 0.0 };
    let truth = Truth { robot: &loaded, torque: &friction, reading: &|_, effort| effort };
    let mut group = c.benchmark_group("diagnose");
    group.sample_size(10);
    for minutes in [1.0, 2.5, 5.0, 10.0] {
        let runs = [run_at(&truth, &Noise::of_a_wam(), [60.0 * minutes, RATE_HZ], 1)];
        group.throughput(Throughput::Elements(runs[0].time.len() as u64));
        group.bench_with_input(BenchmarkId::new("minutes", minutes), &runs, |b, runs| {
            b.iter(|| black_box(diagnose(&robot, runs, &Settings::default(), &Silent).unwrap()));
        });
    }
    group.finish();
    // Linux keeps the peak of the resident memory; elsewhere nothing is printed.
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    if let Some(peak) = status.lines().find(|l| l.starts_with("VmHWM")) {
        println!("peak memory of the whole benchmark, logs included: {peak}");
    }
}

criterion_group!(benches, lengths);
criterion_main!(benches);
