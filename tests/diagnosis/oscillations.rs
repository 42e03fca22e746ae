//! Tones that a diagnosis has to find: sines that are added to logs sample by sample, in the place of a model.

use std::f64::consts::TAU;

use catalogue::EffectKind;
use checks::synthetic::Noise;
use diagnosis::{Diagnosis, Finding};
use logs::Run;

use crate::world::{World, against_nominal, named};

/// The base yaw of the WAM.
const JOINT: usize = 0;

fn of_kind(diagnosis: &Diagnosis, effect: EffectKind) -> Vec<&Finding> {
    diagnosis.findings.iter().filter(|f| f.at.effect == effect).collect()
}

/// The run stopped at its end, where the joints rest, and held there for so many seconds with the noise of its last second.
fn held(mut run: Run, seconds: f64) -> Run {
    let period_s = run.time[1] - run.time[0];
    let (count, rest) = ((seconds / period_s) as usize, (0.9 / period_s) as usize);
    let last = run.time.len();
    for k in 0..count {
        let from = last - rest + k % rest;
        run.time.push((last + k) as f64 * period_s);
        for joint in &mut run.joints {
            joint.position.push(joint.position[from]);
            joint.effort.push(joint.effort[from]);
            let velocity = joint.velocity.as_mut().unwrap();
            velocity.push(velocity[from]);
        }
    }
    run
}

/// A ripple of .3 standard deviations of the noise, in four runs of 4 s. Its line has a power of some
///
/// ```text
/// n a^2 / (4 sigma^2) = 700 * .3^2 / 4 = 16 times that of the noise
/// ```
///
/// in one run, as noise has it at one of `exp(16)` values, and four times that in all. The amplitude has a relative standard
/// deviation of `1 / sqrt(2 * 64)`, of which three are .27.
#[test]
fn a_ripple_that_hides_in_the_noise_of_each_run_stands_out_of_all() {
    let mut noise = Noise::of_a_wam();
    noise.effort[JOINT] = 2.0;
    for seed in [3100, 3101] {
        let world = World::nominal().torque(JOINT, |[q, _, _]| 0.6 * (90.0 * q + 0.7).sin());
        let answer = against_nominal(&world.runs(4, 4.0, &noise, seed)).diagnosis;
        let found = of_kind(&answer, EffectKind::TorqueRipple);
        assert_eq!(found.len(), 1, "{:?}", named(&answer));
        let [amplitude, periods] = [0, 1].map(|k| found[0].parameters[k].value);
        assert!((amplitude / 0.6 - 1.0).abs() < 0.27, "{amplitude}");
        assert!((periods - 90.0).abs() < 0.3, "{periods}");
    }
}

/// A disturbance in the band of the motion, in runs of which the joint stands through the second half.
#[test]
fn a_slow_disturbance_is_told_by_the_part_in_which_the_joint_moves() {
    for seed in [3110, 3111] {
        let runs = World::nominal().runs(3, 12.0, &Noise::of_a_wam(), seed);
        let disturbed = |(r, run): (usize, Run)| {
            let mut run = held(run, 12.0);
            for (effort, t) in run.joints[JOINT].effort.iter_mut().zip(&run.time) {
                *effort += 1.5 * (TAU * 1.1 * t + 2.0 * r as f64).sin();
            }
            run
        };
        let runs: Vec<Run> = runs.into_iter().enumerate().map(disturbed).collect();
        let answer = against_nominal(&runs).diagnosis;
        let found = of_kind(&answer, EffectKind::ExternalDisturbance);
        assert_eq!(found.len(), 1, "{:?}", named(&answer));
        let [amplitude, hz] = [0, 1].map(|k| found[0].parameters[k].value);
        assert!((amplitude / 1.5 - 1.0).abs() < 0.1, "{amplitude}");
        assert!((hz - 1.1).abs() < 0.005, "{hz}");
    }
}
