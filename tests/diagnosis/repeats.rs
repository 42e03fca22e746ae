//! One motion that is recorded again and again: what differs from run to run is noise, and knowledge grows.

use checks::synthetic::{Noise, Truth, run, wam};
use diagnosis::Finding;
use logs::Run;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::world::{against_nominal, finding, named, sign};

/// Friction of the elbow: level (N m) and viscous (N m s/rad).
const FRICTION: [f64; 2] = [2.0, 0.5];
const NAMES: [&str; 2] =
    ["FR02 Coulomb friction at j4_elbow_pitch", "FR01 viscous friction at j4_elbow_pitch"];

/// `count` runs of 20 s of one motion of the WAM, each with noise of its own on every effort, evenly spread
/// over two standard deviations and more.
fn repeated(count: u64) -> Vec<Run> {
    let robot = wam();
    let torque = |joint: usize, [_, qd, _]: [f64; 3]| match joint {
        3 => FRICTION[0] * sign(qd) + FRICTION[1] * qd,
        _ => 0.0,
    };
    let truth = Truth { torque: &torque, ..Truth::of(&robot) };
    let silent = Noise { effort: vec![0.0; 7], ..Noise::of_a_wam() };
    let motion = run(&truth, &silent, 20.0, 4100);
    let one = |k: u64| {
        let mut one = motion.clone();
        one.name = format!("run {k}");
        let mut random = ChaCha8Rng::seed_from_u64(k);
        for (joint, deviation) in one.joints.iter_mut().zip(Noise::of_a_wam().effort) {
            let half = 3.0_f64.sqrt() * deviation;
            joint.effort.iter_mut().for_each(|e| *e += random.random_range(-half..half));
        }
        one
    };
    (0..count).map(one).collect()
}

fn half_width(found: &Finding) -> f64 {
    0.5 * (found.parameters[0].noise95[1] - found.parameters[0].noise95[0])
}

/// Both are named each time, with intervals that hold them and never grow by more than a twentieth.
#[test]
fn repeats_of_a_motion_name_what_one_does_and_narrow_it() {
    let mut before = [f64::INFINITY; 2];
    for count in [1, 2, 3, 4, 8] {
        let answer = against_nominal(&repeated(count)).diagnosis;
        let found = NAMES.map(|name| finding(&answer, name));
        let [Some(level), Some(viscous)] = found else {
            panic!("{count} runs: {:?}", named(&answer));
        };
        let now = [level, viscous].map(half_width);
        println!("{count} runs: {:?} {now:?}", [level, viscous].map(|f| f.parameters[0].value));
        for ((found, truth), (now, before)) in
            [level, viscous].iter().zip(FRICTION).zip(now.iter().zip(before))
        {
            assert!(*now < 1.05 * before, "{count} runs: {now} after {before}");
            let off = (found.parameters[0].value - truth).abs();
            assert!(off < 0.03 * truth, "{count} runs: {off} of {truth}");
        }
        assert_eq!(answer.findings.len(), 2, "{count} runs: {:?}", named(&answer));
        before = now;
    }
}
