//! Logs that the model describes: nothing may be found.

use checks::synthetic::{Noise, Truth, log, run, run_at, wam};
use diagnosis::{Settings, Silent, Verdict, diagnose};
use logs::Run;
use robot::Robot;

use crate::world::named;

/// Three runs of 20 s of the arm as it is described.
fn logs_of_20_s(robot: &Robot, seed: u64) -> Vec<Run> {
    let of = |k| run(&Truth::of(robot), &Noise::of_a_wam(), 20.0, 10 * seed + k);
    (0..3).map(of).collect()
}

/// A log of the model itself plus noise is called consistent at every joint in at least 95
/// of 100 seeds.
#[test]
fn same_model_logs_are_consistent_at_every_joint() {
    let robot = wam();
    let mut bad = Vec::new();
    for seed in 0..100 {
        let runs = logs_of_20_s(&robot, seed);
        let answer = diagnose(&robot, &runs, &Settings::default(), &Silent).unwrap().diagnosis;
        if answer.joints.iter().any(|j| j.verdict != Verdict::Consistent) {
            let findings: Vec<_> = answer.findings.iter().map(|f| f.at.words()).collect();
            let joints: Vec<_> = answer
                .joints
                .iter()
                .filter(|j| j.verdict != Verdict::Consistent)
                .map(|j| {
                    format!(
                        "{}: effort {:.4} residual {:.4} floor {:.4} {:?} memory {:.2} s",
                        j.name,
                        j.torque_rms_nm,
                        j.residual_rms_nm,
                        j.noise_floor_rms_nm,
                        j.noise_floor_from,
                        j.autocorrelation_time_s
                    )
                })
                .collect();
            let data = (answer.data.cutoff_hz, answer.data.regression_rate_hz);
            bad.push(format!("seed {seed} {data:?}: {findings:?} {joints:?}"));
        }
    }
    println!("{} of 100 logs are consistent at every joint", 100 - bad.len());
    assert!(bad.len() <= 5, "{} of 100 logs are not consistent:\n{}", bad.len(), bad.join("\n"));
}

/// The low-pass is reflected about the first reading and keeps all of its noise, at 1 kHz some ten times what it leaves
/// of the others. At a wrist whose efforts are mostly noise the first samples of ten short runs would be more than all others
/// together.
#[test]
fn first_readings_that_are_mostly_noise_are_no_structure() {
    let robot = wam();
    let noise = Noise { effort: vec![0.3, 0.3, 0.15, 0.12, 0.3, 0.3, 0.1], ..Noise::of_a_wam() };
    for seed in [1_u64, 2] {
        let of = |k| run_at(&Truth::of(&robot), &noise, [5.0, 1000.0], 100 * seed + k);
        let runs: Vec<Run> = (0..10).map(of).collect();
        let answer = diagnose(&robot, &runs, &Settings::default(), &Silent).unwrap().diagnosis;
        assert_eq!(named(&answer), Vec::<String>::new(), "seed {seed}");
        for joint in &answer.joints[4..] {
            let (left, floor) = (joint.residual_rms_nm, joint.noise_floor_rms_nm);
            assert!(left < 1.2 * floor, "seed {seed}, {}: {left} of {floor} N m", joint.name);
        }
    }
}

/// With a cut-off in the midst of the motion, which goes up to 1 Hz and beyond: what the model makes
/// of the motion and what was measured are weakened alike, and no cause makes up for a difference.
#[test]
fn a_motion_as_fast_as_the_cutoff_is_weakened_alike_on_both_sides() {
    const CUTOFF_HZ: f64 = 1.5;
    let (robot, noise) = (wam(), Noise::of_a_wam());
    for seed in 200..203 {
        let settings = Settings { cutoff_hz: Some(CUTOFF_HZ), ..Settings::default() };
        let runs = logs_of_20_s(&robot, seed);
        let answer = diagnose(&robot, &runs, &settings, &Silent).unwrap();
        assert_eq!(named(&answer.diagnosis), Vec::<String>::new(), "seed {seed}");
        // Of the wrist most is noise.
        let left = &answer.diagnosis.gain.inverse.rms_before_nm;
        let joints = answer.diagnosis.joints.iter().zip(left);
        for ((joint, left), sd) in joints.zip(&noise.effort).take(4) {
            // The share of white noise, logged at 250 Hz, that lies below the cut-off.
            let floor = sd * (CUTOFF_HZ / 125.0).sqrt();
            assert!(
                *left < 2.0 * floor,
                "seed {seed}, {}: {left} N m, {floor} is noise",
                joint.name
            );
        }
    }
}

/// Described friction holds a joint that stands with any torque up to its level: a constant for every
/// stand, through which a sine over position goes as well as one does through any few values.
#[test]
fn what_holds_a_standing_joint_is_no_tone() {
    const LEVELS_NM: [f64; 7] = [1.5, 1.5, 1.0, 1.0, 0.2, 0.2, 0.05];
    let mut robot = wam();
    for (j, level) in LEVELS_NM.into_iter().enumerate() {
        let drive = &mut robot.link_mut(j).unwrap().actuator;
        (drive.coulomb_forward, drive.coulomb_backward) = (level, level);
    }
    let friction = |j: usize, [q, qd, _]: [f64; 3]| {
        // The path stands to the last digit; where it does the torque follows from the place alone.
        let held = (1e5 * q).sin();
        LEVELS_NM[j] * if qd.abs() < 1e-9 { held } else { qd.signum() }
    };
    let truth = Truth { torque: &friction, ..Truth::of(&robot) };
    let mut tones = Vec::new();
    for seed in 300..308 {
        let run = [run(&truth, &Noise::of_a_wam(), 8.0, seed)];
        let answer = diagnose(&robot, &run, &Settings::default(), &Silent).unwrap().diagnosis;
        let is_tone = |name: &String| name.contains("ripple") || name.contains("disturbance");
        tones.extend(named(&answer).into_iter().filter(is_tone));
    }
    assert_eq!(tones, Vec::<String>::new());
}

/// Described friction that turns more slowly than its model: while a joint changes its direction, dry friction may have
/// any value up to its level, and nothing is called late for it, nor another level or a damping put in its place.
#[test]
fn described_friction_that_turns_slowly_is_not_late() {
    const LEVELS_NM: [f64; 7] = [3.0, 3.0, 2.0, 2.0, 0.4, 0.4, 0.1];
    const SLOW_RAD_PER_S: f64 = 0.05;
    const OTHERS: [&str; 5] = ["delay", "lag", "skew", "viscous", "Coulomb"];
    let mut robot = wam();
    for (j, level) in LEVELS_NM.into_iter().enumerate() {
        let drive = &mut robot.link_mut(j).unwrap().actuator;
        (drive.coulomb_forward, drive.coulomb_backward) = (level, level);
    }
    let friction = |j: usize, [_, qd, _]: [f64; 3]| LEVELS_NM[j] * (qd / SLOW_RAD_PER_S).tanh();
    let truth = Truth { torque: &friction, ..Truth::of(&robot) };
    let mut names = Vec::new();
    for seed in 310..314 {
        let runs = log(&truth, seed);
        let answer = diagnose(&robot, &runs, &Settings::default(), &Silent).unwrap().diagnosis;
        let is_other = |name: &String| OTHERS.iter().any(|other| name.contains(other));
        names.extend(named(&answer).into_iter().filter(is_other));
    }
    assert_eq!(names, Vec::<String>::new());
}
