use std::hint::black_box;
use std::path::Path;

use dynamics::{Dynamics, NormalEquations};
use effects::{Frame, RunMotion, hypotheses};
use gaussian_process::{GaussianKernel, KernelSum};
use robot::{Machine, Reading, Robot};
use simulator::{Sensors, Simulator, StepOrder, Stepping};

/// A loop and the instructions that it takes.
pub struct Loop {
    pub name: &'static str,
    /// What is counted, and how many of it make a round.
    pub unit: &'static str,
    pub units: usize,
    /// Instructions of one.
    pub figure: f64,
    /// Rounds of the shorter of the two counts.
    pub rounds: usize,
    /// Makes the input, and returns a round.
    pub prepare: fn() -> Round,
}

type Round = Box<dyn FnMut()>;

/// States of an arm that are gone through in a round.
const STATES: usize = 50;

/// Samples of the motion along which columns are evaluated.
const SAMPLES: usize = 100;

/// Points of a query.
const POINTS: usize = 3000;

/// Steps of 1 ms, two for each command.
const STEPS: usize = 200;

/// The likelihood is not among them: the threads that wait in it spin, which is 2 % of its instructions in one run and not in
/// the next.
pub const LOOPS: [Loop; 10] = [
    of("query_of_seven_outputs", "query", 1, 661_000.0, 5, query),
    of("covariances_of_one_output", "query", 1, 196_900.0, 10, covariances),
    of("inverse_dynamics", "state", STATES, 4_600.0, 40, inverse_dynamics),
    of("inverse_dynamics_derivatives", "state", STATES, 17_360.0, 10, derivatives),
    of("torque_regressor", "state", STATES, 14_960.0, 10, regressor),
    of("normal_equations", "state", STATES, 11_580.0, 10, normal_equations),
    of("motion_of_a_run", "sample", SAMPLES, 8_230.0, 20, motion_of_a_run),
    of("columns_of_all_hypotheses", "sample", SAMPLES, 153_500.0, 1, columns),
    of("simulated_wam", "step", STEPS, 15_090.0, 2, simulated),
    of("simulated_wam_with_friction", "step", STEPS, 15_500.0, 2, simulated_with_friction),
];

const fn of(
    name: &'static str,
    unit: &'static str,
    units: usize,
    figure: f64,
    rounds: usize,
    prepare: fn() -> Round,
) -> Loop {
    Loop { name, unit, units, figure, rounds, prepare }
}

fn sum() -> KernelSum {
    let points: Vec<f64> = (0..POINTS * 21).map(|i| (i as f64).sin()).collect();
    let kernel = GaussianKernel { signal_variance: 1.0, length_scales: vec![3.0; 21] };
    KernelSum::new(&points, 21, &vec![kernel; 7], &vec![vec![1.0; POINTS]; 7]).unwrap()
}

fn query() -> Round {
    let (sum, mut f) = (sum(), [0.0; 7]);
    Box::new(move || sum.evaluate_into(black_box(&[0.5; 21]), black_box(&mut f)))
}

fn covariances() -> Round {
    let (sum, mut k_star) = (sum(), vec![0.0; POINTS]);
    Box::new(move || sum.covariances_into(3, black_box(&[0.5; 21]), black_box(&mut k_star)))
}

fn wam() -> Robot {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots/wam7/robot.toml");
    Robot::load(&file).unwrap().robot
}

/// So many numbers between -`half` and `half`.
fn spread(count: usize, half: f64) -> Vec<f64> {
    (0..count).map(|i| half * (i as f64 * i as f64).sin()).collect()
}

/// Positions, velocities and accelerations of the WAM.
fn states() -> Vec<[Vec<f64>; 3]> {
    let all = [2.0, 2.0, 5.0].map(|half| spread(7 * STATES, half));
    (0..STATES).map(|s| all.each_ref().map(|signal| signal[7 * s..7 * s + 7].to_vec())).collect()
}

fn inverse_dynamics() -> Round {
    let (dynamics, states, mut tau) = (Dynamics::new(&wam()), states(), [0.0; 7]);
    let mut ws = dynamics.workspace();
    Box::new(move || {
        for [q, qd, qdd] in &states {
            dynamics.inverse_dynamics_into(&mut ws, q, qd, qdd, black_box(&mut tau));
        }
    })
}

fn derivatives() -> Round {
    let (dynamics, states) = (Dynamics::new(&wam()), states());
    let (mut ws, mut matrices) = (dynamics.workspace(), [[0.0; 49]; 3]);
    Box::new(move || {
        for state in &states {
            let [dq, dqd, dqdd] = &mut matrices;
            let state = state.each_ref().map(Vec::as_slice);
            dynamics.inverse_dynamics_derivatives_into(&mut ws, state, [dq, dqd, dqdd]);
            black_box(&mut matrices);
        }
    })
}

fn regressor() -> Round {
    let (dynamics, states, mut rows) = (Dynamics::new(&wam()), states(), vec![0.0; 490]);
    let mut ws = dynamics.workspace();
    Box::new(move || {
        for [q, qd, qdd] in &states {
            dynamics.torque_regressor_into(&mut ws, q, qd, qdd, black_box(&mut rows));
        }
    })
}

/// `X'X` of seven rows of 70 numbers a state.
fn normal_equations() -> Round {
    let (rows, tau) = (spread(STATES * 490, 1.0), spread(STATES * 7, 1.0));
    let mut equations = NormalEquations::new(70);
    Box::new(move || equations.add(black_box(&rows), &tau).unwrap())
}

/// A nominal robot, and the states `[signal][joint][sample]` that its encoders report.
fn reported() -> (Robot, Frame, [Vec<Vec<f64>>; 3]) {
    let signal = |amplitude: f64, phase: f64| -> Vec<Vec<f64>> {
        let at = |j: usize, t: usize| {
            amplitude * (0.02 * t as f64 * (1.0 + 0.1 * j as f64) + phase + j as f64).sin()
        };
        (0..7).map(|j| (0..SAMPLES).map(|t| at(j, t)).collect()).collect()
    };
    let frame = Frame {
        rest_speed: vec![0.01; 7],
        centre: vec![0.1; 7],
        reach: vec![1.0; 7],
        resolution: vec![1e-5; 7],
        trial_gaps: vec![0.0; 7],
        trial_springs: vec![None; 7],
        trial_lateness_s: 0.0,
    };
    (wam(), frame, [signal(0.8, 0.0), signal(1.0, 1.3), signal(2.0, 0.7)])
}

fn motion_of_a_run() -> Round {
    let (robot, frame, reported) = reported();
    Box::new(move || {
        black_box(RunMotion::new(&robot, &frame, reported.clone(), 4e-3));
    })
}

/// The columns of everything that could be wrong with a WAM, with the motion that they are functions of.
fn columns() -> Round {
    let (robot, frame, reported) = reported();
    let all = hypotheses(&robot);
    Box::new(move || {
        let motion = RunMotion::new(&robot, &frame, reported.clone(), 4e-3);
        all.iter().for_each(|hypothesis| {
            black_box(hypothesis.columns(&motion));
        });
    })
}

fn simulated() -> Round {
    simulation([0.0; 7])
}

fn simulated_with_friction() -> Round {
    simulation([1.6, 0.53, 0.37, 0.64, 0.036, 0.071, 0.0125])
}

/// A lively motion under sampled feedback, in steps of second order, with dry friction (N m).
fn simulation(dry: [f64; 7]) -> Round {
    const KP: [f64; 7] = [200.0, 300.0, 100.0, 100.0, 10.0, 10.0, 2.5];
    const KD: [f64; 7] = [7.0, 15.0, 5.0, 2.5, 0.3, 0.3, 0.05];
    let mut robot = wam();
    for (j, level) in dry.into_iter().enumerate() {
        let actuator = &mut robot.link_mut(j).unwrap().actuator;
        (actuator.coulomb_forward, actuator.coulomb_backward, actuator.viscous) =
            (level, level, 0.0);
    }
    let stepping =
        Stepping { step_s: 1e-3, steps_per_period: 2, stops: false, order: StepOrder::Second };
    let mut arm = Simulator::new(&robot, Vec::new(), Sensors::perfect(7), stepping).unwrap();
    let (mut reading, mut tau) = (Reading::zero(7), [0.0; 7]);
    Box::new(move || {
        arm.start(&[-0.5, -0.2, 0.4, 0.8, 0.3, -0.4, 0.5]);
        for tick in 0..STEPS / 2 {
            arm.read(&mut reading).unwrap();
            let wanted = 0.5 * (1.0 - (3.0 * tick as f64 * 2e-3).cos());
            for (i, tau) in tau.iter_mut().enumerate() {
                *tau = KP[i] * (wanted - reading.q[i]) - KD[i] * reading.qd[i];
            }
            arm.actuate(&tau).unwrap();
        }
    })
}
