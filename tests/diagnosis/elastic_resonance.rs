//! Joints that move near the resonance of their link on the spring of the transmission, or beyond it.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use checks::arms::data;
use diagnosis::{Diagnosis, Settings, Silent, diagnose};
use logs::{ReadOptions, Run, read_run, run_of_columns};
use robot::Robot;

use crate::world::{finding, named};

/// A link of 1.5 kg, .2 m from its axis.
const MASS_KG: f64 = 1.5;
const ARM_M: f64 = 0.2;
const ABOUT_COM: f64 = 0.01;

/// What the description does not have.
const ROTOR: f64 = 0.03;
const COULOMB: f64 = 0.3;
const VISCOUS: f64 = 0.1;

const RATE_HZ: f64 = 250.0;
const SECONDS: f64 = 16.0;

/// Steps of the integration in a sample: a hundredth of a period of the stiffest spring and less.
const STEPS: usize = 16;

fn robot(axis: &str) -> Robot {
    let urdf = format!(
        "<robot name='bench'><link name='base'/><joint name='j' type='revolute'><parent link='base'/>\
         <child link='arm'/><axis xyz='{axis}'/><limit lower='-3' upper='3' effort='60' velocity='20'/></joint>\
         <link name='arm'><inertial><origin xyz='{ARM_M} 0 0'/><mass value='{MASS_KG}'/><inertia ixx='0.002' \
         ixy='0' ixz='0' iyy='{ABOUT_COM}' iyz='0' izz='{ABOUT_COM}'/></inertial></link></robot>"
    );
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("robot.urdf");
    std::fs::write(&file, urdf).unwrap();
    Robot::load(&file).unwrap().robot
}

/// The bench: a motor, a damped spring, and a link about an axis that is level or upright.
#[derive(Clone, Copy)]
struct Bench {
    stiffness: f64,
    damping: f64,
    weight_nm: f64,
}

impl Bench {
    /// Derivatives of the position and velocity of the motor and of the link under the effort of the motor:
    ///
    /// ```text
    /// rotor thetadd = effort - friction - spring,   spring = stiffness (theta - q) + damping (thetad - qd)
    /// inertia qdd   = spring + weight cos(q)
    /// ```
    fn slopes(&self, [theta, thetad, q, qd]: [f64; 4], effort: f64) -> [f64; 4] {
        let spring = self.stiffness * (theta - q) + self.damping * (thetad - qd);
        let friction = COULOMB * (thetad / 0.01).tanh() + VISCOUS * thetad;
        let inertia = ABOUT_COM + MASS_KG * ARM_M * ARM_M;
        let qdd = (spring + self.weight_nm * q.cos()) / inertia;
        [thetad, (effort - friction - spring) / ROTOR, qd, qdd]
    }

    /// The state after `h` seconds, by the rule of Runge and Kutta of fourth order.
    fn after(&self, state: [f64; 4], effort: f64, h: f64) -> [f64; 4] {
        let ahead = |k: [f64; 4], h: f64| [0, 1, 2, 3].map(|i| state[i] + h * k[i]);
        let first = self.slopes(state, effort);
        let second = self.slopes(ahead(first, 0.5 * h), effort);
        let third = self.slopes(ahead(second, 0.5 * h), effort);
        let last = self.slopes(ahead(third, h), effort);
        let mean = [0, 1, 2, 3].map(|i| first[i] + 2.0 * (second[i] + third[i]) + last[i]);
        ahead(mean, h / 6.0)
    }

    /// A motor that follows six sines up to 3 Hz, one log a number, from rest. Efforts have noise of .02 N m.
    fn log(&self, robot: &Robot, number: usize) -> Run {
        let mut drawn = Uniform(1 + number as u64);
        let sines: Vec<[f64; 3]> = (0..6)
            .map(|_| {
                let (hz, phase) = (0.2 + 2.8 * drawn.next(), TAU * drawn.next());
                [0.25 / hz.max(0.7), TAU * hz, phase]
            })
            .collect();
        let goal = |t: f64| {
            let begin = t.min(1.0);
            let position = |[a, w, p]: &[f64; 3]| a * ((w * t + p).sin() - p.sin());
            let velocity = |[a, w, p]: &[f64; 3]| a * w * (w * t + p).cos();
            let sum = |of: &dyn Fn(&[f64; 3]) -> f64| begin * sines.iter().map(of).sum::<f64>();
            (sum(&position), sum(&velocity))
        };
        let mut state = [0.0, 0.0, self.weight_nm / self.stiffness, 0.0];
        let mut columns: [Vec<f64>; 4] = Default::default();
        for sample in 0..(RATE_HZ * SECONDS) as usize {
            let t = sample as f64 / RATE_HZ;
            let [theta, thetad, ..] = state;
            let (position, velocity) = goal(t);
            let effort = 60.0 * (position - theta) + 2.0 * (velocity - thetad)
                - self.weight_nm * theta.cos();
            let noise = 0.02 * (0..12).map(|_| drawn.next() - 0.5).sum::<f64>();
            let row = [t, theta, thetad, effort + noise];
            columns.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
            for _ in 0..STEPS {
                state = self.after(state, effort, 1.0 / RATE_HZ / STEPS as f64);
            }
        }
        let names = ["time", "j.position", "j.velocity", "j.effort"].map(str::to_owned);
        let columns: BTreeMap<String, Vec<f64>> = names.into_iter().zip(columns).collect();
        run_of_columns(&format!("run {number}"), columns, robot, &ReadOptions::default()).unwrap()
    }
}

/// Numbers from 0 to 1: a linear congruential generator, with the factors of Knuth.
struct Uniform(u64);

impl Uniform {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A share of the truth by which a size may be off: that of the issue is a fifth, the logs tell more.
const OFF: f64 = 0.1;

#[track_caller]
fn has(found: &Diagnosis, name: &str, truth: f64, off: f64) {
    let words = format!("{name} at j");
    let sizes = finding(found, &words).unwrap_or_else(|| panic!("no {words}: {:?}", named(found)));
    let size = sizes.parameters[0].value;
    assert!((size / truth - 1.0).abs() < off, "{words} {size}, not {truth}: {:?}", named(found));
}

/// The links ring at 4.7, 8.5 and, about an upright axis, 4.7 Hz; the motors move up to 3 Hz and at what rings.
#[test]
fn a_spring_near_its_resonance_is_named_with_rotor_and_friction() {
    let weight_nm = 9.81 * MASS_KG * ARM_M;
    for (axis, stiffness, damping, weight_nm) in [
        ("0 1 0", 60.0, 0.15, weight_nm),
        ("0 1 0", 200.0, 0.3, weight_nm),
        ("0 0 1", 60.0, 0.15, 0.0),
    ] {
        let robot = robot(axis);
        let bench = Bench { stiffness, damping, weight_nm };
        let runs: Vec<Run> = (0..3).map(|number| bench.log(&robot, number)).collect();
        let answer = diagnose(&robot, &runs, &Settings::default(), &Silent).unwrap().diagnosis;
        has(&answer, "TR02 joint elasticity", stiffness, OFF);
        has(&answer, "IN03 rotor inertia", ROTOR, OFF);
        has(&answer, "FR01 viscous friction", VISCOUS, OFF);
        has(&answer, "FR02 Coulomb friction", COULOMB, OFF);
    }
}

/// Three logs of a bench with the same errors that begin at full speed, the spring twisted by thirty times what it
/// carries at rest: the dry friction of .3 N m is less than what the begin leaves.
#[test]
fn recorded_resonance_is_a_spring_of_sixty_newton_metres() {
    let Some(folder) = data("field_bugs/pace_resonance") else { return };
    let robot = Robot::load(&folder.join("robot.urdf")).unwrap().robot;
    let read = |k: usize| {
        read_run(&folder.join(format!("run_{k}.csv.gz")), &robot, &ReadOptions::default()).unwrap()
    };
    let runs: Vec<Run> = (1..=3).map(read).collect();
    let answer = diagnose(&robot, &runs, &Settings::default(), &Silent).unwrap().diagnosis;
    has(&answer, "TR02 joint elasticity", 60.0, 0.02);
    has(&answer, "IN03 rotor inertia", ROTOR, OFF);
    has(&answer, "FR01 viscous friction", VISCOUS, 0.2);
    let joint = &answer.joints[0];
    assert!(joint.remaining_rms_nm < 0.3 * joint.residual_rms_nm, "{joint:?}");
}
