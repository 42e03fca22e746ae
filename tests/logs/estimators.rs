//! Velocity and acceleration of coarse positions: the low-pass of the product, and others, on
//! motions that are known exactly.

use std::f64::consts::TAU;

use logs::{PrepareSettings, PreparedRun, prepare};

use crate::{
    smoother::Smoother,
    support::{clock, follows, run},
};

/// A motion in closed form: position, velocity and acceleration over time.
struct Motion {
    name: &'static str,
    at: fn(f64) -> [f64; 3],
}

const MOTIONS: [Motion; 4] = [
    Motion { name: "sinusoids", at: sinusoids },
    Motion { name: "sweep", at: sweep },
    Motion { name: "min. jerk", at: minimum_jerk },
    Motion { name: "trapezoids", at: trapezoids },
];

/// Three sinusoids of .15, .4 and 1.1 Hz.
fn sinusoids(t: f64) -> [f64; 3] {
    let mut x = [0.0; 3];
    for (a, hz, phase) in [(0.6, 0.15, 0.3), (0.3, 0.4, 1.1), (0.08, 1.1, 2.0)] {
        let (w, p) = (TAU * hz, TAU * hz * t + phase);
        x[0] += a * p.sin();
        x[1] += a * w * p.cos();
        x[2] -= a * w * w * p.sin();
    }
    x
}

/// From .1 to 3 Hz in 20 s, a twentieth of a radian about a slow swing.
fn sweep(t: f64) -> [f64; 3] {
    let (from, rate) = (TAU * 0.1, TAU * (3.0 - 0.1) / 20.0);
    let (p, w, a) = (from * t + 0.5 * rate * t * t, from + rate * t, 0.05);
    let (s, v) = (0.4 * TAU * 0.1, TAU * 0.1);
    [
        a * p.sin() + 0.4 * (v * t).sin(),
        a * w * p.cos() + s * (v * t).cos(),
        a * (rate * p.cos() - w * w * p.sin()) - s * v * (v * t).sin(),
    ]
}

/// To and fro between targets, each way in 1.2 s, then .4 s of rest.
fn minimum_jerk(t: f64) -> [f64; 3] {
    let (way, s, sign, from) = leg(t, 1.2, 1.6);
    let q = s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s);
    let qd = 30.0 * s * s * (1.0 - 2.0 * s + s * s) / 1.2;
    let qdd = 60.0 * s * (1.0 - 3.0 * s + 2.0 * s * s) / 1.44;
    [from + sign * way * q, sign * way * qd, sign * way * qdd]
}

/// The same by trapezoids of velocity: a third of the way's time each to speed up, go and stop.
fn trapezoids(t: f64) -> [f64; 3] {
    let (way, s, sign, from) = leg(t, 1.2, 1.6);
    let top = 1.5;
    let (q, v, a) = if s < 1.0 / 3.0 {
        (1.5 * top * s * s, 3.0 * top * s, 3.0 * top)
    } else if s < 2.0 / 3.0 {
        (top * (s - 1.0 / 6.0), top, 0.0)
    } else {
        let left = 1.0 - s;
        (1.0 - 1.5 * top * left * left, 3.0 * top * left, if s < 1.0 { -3.0 * top } else { 0.0 })
    };
    [from + sign * way * q, sign * way * v / 1.2, sign * way * a / 1.44]
}

/// Length of a way, the part of it that is done, its direction and where it starts.
fn leg(t: f64, duration: f64, period: f64) -> (f64, f64, f64, f64) {
    let number = (t / period).floor();
    let s = ((t - number * period) / duration).min(1.0);
    let forth = number.rem_euclid(2.0) < 1.0;
    (0.9, s, if forth { 1.0 } else { -1.0 }, if forth { -0.45 } else { 0.45 })
}

/// Errors of an estimate: RMS of velocity and acceleration over those of the motion, and the share
/// of the samples whose velocity has the wrong sign.
#[derive(Clone, Copy, Debug)]
struct Errors {
    qd: f64,
    qdd: f64,
    sign: f64,
}

fn errors(time: &[f64], qd: &[f64], qdd: &[f64], motion: &Motion) -> Errors {
    let truth: Vec<[f64; 3]> = time.iter().map(|&t| (motion.at)(t)).collect();
    let share = |x: &[f64], i: usize| {
        let off: f64 = x.iter().zip(&truth).map(|(x, t)| (x - t[i]).powi(2)).sum();
        (off / truth.iter().map(|t| t[i].powi(2)).sum::<f64>()).sqrt()
    };
    let moving = qd.iter().zip(&truth).filter(|(_, t)| t[1].abs() > 0.0);
    let wrong = moving.clone().filter(|(v, t)| **v * t[1] < 0.0).count();
    Errors { qd: share(qd, 1), qdd: share(qdd, 2), sign: wrong as f64 / moving.count() as f64 }
}

/// A motion as an encoder of so many bits a turn sees it.
struct Case<'m> {
    motion: &'m Motion,
    run: logs::Run,
    step: f64,
}

impl<'m> Case<'m> {
    fn new(motion: &'m Motion, bits: i32, rate_hz: f64) -> Self {
        let step = TAU / 2_f64.powi(bits);
        let time = clock((20.0 * rate_hz) as usize, rate_hz);
        // A third of a step away from where the motion is symmetric.
        let counted = |t: f64| step * (((motion.at)(t)[0] + 0.33 * step) / step).round();
        let run = run(time.clone(), vec![follows("j1", &time, counted)]);
        Self { motion, run, step }
    }

    fn prepared(&self, cutoff_hz: Option<f64>) -> (f64, PreparedRun) {
        let prepared = prepare(std::slice::from_ref(&self.run), &PrepareSettings { cutoff_hz });
        let mut prepared = prepared.unwrap();
        (prepared.cutoff_hz, prepared.runs.remove(0))
    }

    fn low_pass(&self, cutoff_hz: Option<f64>) -> (f64, Errors) {
        let (cutoff_hz, run) = self.prepared(cutoff_hz);
        let time = &run.time;
        let inside = |x: &[f64]| -> Vec<f64> {
            let kept = time.iter().zip(x).filter(|(t, _)| is_inside(**t));
            kept.map(|(_, x)| *x).collect()
        };
        let joint = &run.joints[0];
        let (qd, qdd) = (inside(&joint.qd), inside(&joint.qdd));
        (cutoff_hz, errors(&inside(time), &qd, &qdd, self.motion))
    }

    /// Noise of the acceleration behind a cut-off, RMS over that of the motion: the difference
    /// from what the same low-pass makes of exact positions.
    fn noise(&self, cutoff_hz: f64) -> f64 {
        let settings = PrepareSettings { cutoff_hz: Some(cutoff_hz) };
        let exact = follows("j1", &self.run.time, |t| (self.motion.at)(t)[0]);
        let exact = prepare(&[run(self.run.time.clone(), vec![exact])], &settings).unwrap();
        let (_, seen) = self.prepared(Some(cutoff_hz));
        let pairs = seen.time.iter().zip(&seen.joints[0].qdd).zip(&exact.runs[0].joints[0].qdd);
        let squares = pairs
            .filter(|((t, _), _)| is_inside(**t))
            .map(|((t, seen), exact)| ((seen - exact).powi(2), (self.motion.at)(*t)[2].powi(2)));
        let (off, all) = squares.fold((0.0, 0.0), |sum, x| (sum.0 + x.0, sum.1 + x.1));
        (off / all).sqrt()
    }

    /// The cut-off whose acceleration is nearest to the truth.
    fn best_low_pass(&self) -> (f64, Errors) {
        let highest = 0.2 / (self.run.time[1] - self.run.time[0]);
        let all = (0..).map(|k| 1.2 * 1.15_f64.powi(k)).take_while(|hz| *hz < highest);
        let of = |hz: f64| (hz, self.low_pass(Some(hz)).1);
        all.map(of).min_by(|a, b| a.1.qdd.total_cmp(&b.1.qdd)).unwrap()
    }

    fn smoother<const N: usize>(&self) -> Errors {
        let (time, q) = (&self.run.time, &self.run.joints[0].position);
        let period_s = time[1] - time[0];
        let smoother = Smoother::<N>::most_likely(period_s, self.step.powi(2) / 12.0, q);
        let states = smoother.smooth(q);
        let kept: Vec<usize> = (0..time.len()).filter(|&k| is_inside(time[k])).collect();
        let of = |i: usize| -> Vec<f64> { kept.iter().map(|&k| states[k][i]).collect() };
        let time: Vec<f64> = kept.iter().map(|&k| time[k]).collect();
        errors(&time, &of(1), &of(2), self.motion)
    }
}

/// Away from the ends, where every estimate is worse.
fn is_inside(t: f64) -> bool {
    (2.0..18.0).contains(&t)
}

/// A smoother weighs noise against a guess of how smooth the motion is, a low-pass by its cut-off:
/// at the right one it is as near to the truth. The one chosen keeps noise at its share.
#[test]
fn a_smoother_is_no_nearer_to_the_truth_than_a_low_pass_at_the_right_cutoff() {
    println!(
        "motion | bits | chosen: Hz, qd, qdd, sign; noise of qdd | best cut-off | white jerk | white snap (%)"
    );
    let show =
        |e: Errors| format!("{:.2} {:.1} {:.2}", 100.0 * e.qd, 100.0 * e.qdd, 100.0 * e.sign);
    for motion in &MOTIONS {
        for bits in [10, 12, 16] {
            let case = Case::new(motion, bits, 250.0);
            let (hz, chosen) = case.low_pass(None);
            let (best_hz, best) = case.best_low_pass();
            let (jerk, snap) = (case.smoother::<3>(), case.smoother::<4>());
            let (name, noise) = (motion.name, case.noise(hz));
            println!(
                "{name} | {bits} | {hz:.1}: {}; {:.1} | {best_hz:.1}: {} | {} | {}",
                show(chosen),
                100.0 * noise,
                show(best),
                show(jerk),
                show(snap)
            );
            assert!(best.qdd < 1.1 * jerk.qdd.min(snap.qdd), "{name}, {bits} bits");
            assert!(noise < 0.04, "{name}, {bits} bits: {noise}");
        }
    }
}
