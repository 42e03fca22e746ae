//! Worlds that differ from the nominal WAM by formulas written down in the tests.

use checks::synthetic::{Noise, State, Truth, run, run_paced, wam};
use diagnosis::{Diagnosis, DiagnosisRun, Finding, Settings, Silent, diagnose};
use logs::Run;
use robot::Robot;

/// Torque (N m) at a joint for its state.
pub type Torque = fn(State) -> f64;

/// Reported effort (N m) for the true one.
pub type Reading = fn(f64) -> f64;

/// The WAM with effects that are formulas: never those of the crate under test.
#[derive(Clone)]
pub struct World {
    /// The robot whose bodies and rotors move.
    pub robot: Robot,
    torque: Vec<(usize, Torque)>,
    reading: Vec<(usize, Reading)>,
}

impl World {
    /// The WAM as it is described.
    pub fn nominal() -> Self {
        Self { robot: wam(), torque: Vec::new(), reading: Vec::new() }
    }

    /// With a torque (N m) besides, at `joint`, for its state.
    pub fn torque(mut self, joint: usize, formula: Torque) -> Self {
        self.torque.push((joint, formula));
        self
    }

    /// With a reported effort (N m) for the true one, at `joint`.
    pub fn reading(mut self, joint: usize, formula: Reading) -> Self {
        self.reading.push((joint, formula));
        self
    }

    /// With another body.
    pub fn body(mut self, change: fn(Robot) -> Robot) -> Self {
        self.robot = change(self.robot);
        self
    }

    /// `count` runs of `seconds` with different motions; every number follows from the seed.
    pub fn runs(&self, count: u64, seconds: f64, noise: &Noise, seed: u64) -> Vec<Run> {
        self.paced(&vec![1.0; count as usize], seconds, noise, seed)
    }

    /// A run for each of `paces`, whose motion is so many times as fast.
    pub fn paced(&self, paces: &[f64], seconds: f64, noise: &Noise, seed: u64) -> Vec<Run> {
        let torque = |joint: usize, state: State| -> f64 {
            self.torque.iter().filter(|(j, _)| *j == joint).map(|(_, f)| f(state)).sum()
        };
        let reading = |joint: usize, effort: f64| -> f64 {
            let here = self.reading.iter().filter(|(j, _)| *j == joint);
            here.fold(effort, |e, (_, f)| f(e))
        };
        let truth = Truth { robot: &self.robot, torque: &torque, reading: &reading };
        let numbered = paces.iter().zip(10 * seed..);
        numbered.map(|(p, seed)| run_paced(&truth, noise, [seconds, 250.0, *p], seed)).collect()
    }

    /// Three runs of 12 s, as in [`checks::synthetic::log`].
    pub fn log(&self, seed: u64) -> Vec<Run> {
        self.runs(3, 12.0, &Noise::of_a_wam(), seed)
    }
}

/// Share of the gap, RMS over RMS at each joint, that `extended` leaves on a motion which
/// is in no log: what it predicts and the world does there, without noise.
pub fn left_on_a_new_motion(world: &World, extended: &Robot, seed: u64) -> Vec<f64> {
    let silent = Noise { effort: vec![0.0; 7], ..Noise::of_a_wam() };
    let truth = &world.runs(1, 20.0, &silent, seed)[0];
    let gap = |robot: &Robot| -> Vec<f64> {
        let predicted = predicted(robot, &silent, seed);
        let joints = truth.joints.iter().zip(&predicted.joints);
        let rms = |(a, b): (&logs::Channels, &logs::Channels)| {
            let off = a.effort.iter().zip(&b.effort).map(|(a, b)| (a - b).powi(2));
            (off.sum::<f64>() / a.effort.len() as f64).sqrt()
        };
        joints.map(rms).collect()
    };
    gap(extended).iter().zip(gap(&wam())).map(|(after, before)| after / before).collect()
}

/// The first run of a seed as `robot` says, with what [`robot::Actuator`] says of its drives.
fn predicted(robot: &Robot, noise: &Noise, seed: u64) -> Run {
    let torque = |joint: usize, [q, qd, _]: State| {
        let a = &robot.links()[joint].actuator;
        let level = if qd > 0.0 { a.coulomb_forward } else { a.coulomb_backward };
        let balance = a.counterbalance.map_or(0.0, |c| c.amplitude * (q + c.phase).sin());
        a.viscous * qd + level * sign(qd) + a.spring_stiffness * (q - a.spring_rest) + balance
    };
    let reading = |joint: usize, effort: f64| {
        let a = &robot.links()[joint].actuator;
        a.torque_gain * effort + a.torque_offset
    };
    run(&Truth { robot, torque: &torque, reading: &reading }, noise, 20.0, 10 * seed)
}

/// What the nominal WAM gets wrong in `runs`.
pub fn against_nominal(runs: &[Run]) -> DiagnosisRun {
    diagnose(&wam(), runs, &Settings::default(), &Silent).unwrap()
}

/// Sign of a velocity, zero at rest.
pub fn sign(qd: f64) -> f64 {
    if qd > 0.0 {
        1.0
    } else if qd < 0.0 {
        -1.0
    } else {
        0.0
    }
}

/// The finding named `words`, such as `DR03 torque offset at j3_shoulder_yaw`.
pub fn finding<'a>(diagnosis: &'a Diagnosis, words: &str) -> Option<&'a Finding> {
    diagnosis.findings.iter().find(|f| f.at.words() == words)
}

/// The findings in words, for messages.
pub fn named(diagnosis: &Diagnosis) -> Vec<String> {
    diagnosis.findings.iter().map(|f| f.at.words()).collect()
}
