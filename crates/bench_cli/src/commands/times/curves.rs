use std::hint::black_box;

use benchmark::{Maker, TimeCurve, TimePoint};
use cli::{Watch, median_query_us, median_us};
use dynamics::ColumnSet;
use gaussian_process::{GaussianKernel, KernelSum};
use learner::{LearnerError, Mean, Model, ModelKind, Process, ProcessInputs, Samples, TorqueModel};
use logs::{Prepared, PreparedJoint, PreparedRun};
use robot::Robot;

use crate::commands::times::regressor_kernel::RegressorKernel;

/// States that predictions are asked for.
const STATES: usize = 1000;

/// The curve of the rigid-body kernel that is evaluated for every training point.
pub const AS_WRITTEN: &str = "rbd-kernel as in eq. 10";

/// Models of made-up points that are timed, by the name of their curve.
const MODELS: [ModelKind; 4] =
    [ModelKind::Rbd, ModelKind::Gp, ModelKind::GpRbd, ModelKind::RbdKernel];

/// The training points that models are made of.
#[derive(Clone, Copy)]
pub struct MadeUp<'a> {
    /// How many, rising.
    pub points: &'a [usize],
    /// Where their sequence begins.
    pub seed: u64,
}

/// Our own curves, as far as they are not stopped.
pub fn curves(
    robot: &Robot,
    made_up: MadeUp,
    watch: &Watch,
) -> Result<Vec<TimeCurve>, LearnerError> {
    let curve = |name: &str| TimeCurve {
        name: name.to_owned(),
        maker: Maker::Plumbline,
        points: Vec::new(),
    };
    let mut curves: Vec<TimeCurve> = MODELS.iter().map(|kind| curve(kind.name())).collect();
    let mut as_written = curve(AS_WRITTEN);
    let states = samples(robot, STATES, made_up.seed);
    for &n in made_up.points {
        for (kind, curve) in MODELS.into_iter().zip(&mut curves) {
            if watch.is_stopped() {
                break;
            }
            watch.begin(&format!("{kind}: {n} points"));
            let microseconds = median_query_us(&model(robot, kind, (n, made_up.seed))?, &states);
            curve.points.push(TimePoint { n, microseconds });
        }
        if !watch.is_stopped() {
            watch.begin(&format!("{}: {n} points", as_written.name));
            let microseconds = equation_10_us(robot, (n, made_up.seed), &states)?;
            as_written.points.push(TimePoint { n, microseconds });
        }
    }
    curves.push(as_written);
    Ok(curves)
}

/// A model of `n` made-up points. The rigid-body kernel sums up to a mean, so it is one.
fn model(robot: &Robot, kind: ModelKind, points: (usize, u64)) -> Result<Model, LearnerError> {
    let joints = robot.joint_count();
    let beta: Vec<f64> = robot.links().iter().flat_map(|l| l.inertia.parameters()).collect();
    let mean = match kind {
        ModelKind::Gp => Mean::Zero,
        _ => Mean::Columns { set: ColumnSet::INERTIAL, beta: vec![beta; joints] },
    };
    let mut model = Model::new(kind, robot, mean, vec![1.0; joints]);
    if kind != ModelKind::Rbd {
        model.process = Some(process(robot, points)?);
    }
    Ok(model)
}

/// A process over `n` made-up points.
fn process(robot: &Robot, (n, seed): (usize, u64)) -> Result<Process, LearnerError> {
    let joints = robot.joint_count();
    let samples = samples(robot, n, seed);
    let inputs = ProcessInputs::new(&samples, Vec::new());
    let width = inputs.width();
    let kernel = |joint: usize| GaussianKernel {
        signal_variance: 1.0,
        length_scales: (0..width).map(|d| 2.0 + 3.0 * spread(joint, d)).collect(),
    };
    let kernels: Vec<GaussianKernel> = (0..joints).map(kernel).collect();
    let sum = KernelSum::new(&inputs.points(&samples), width, &kernels, &weights(joints, n))?;
    Ok(Process { inputs, sum, spread: None })
}

/// Weights of every point for every joint.
fn weights(joints: usize, n: usize) -> Vec<Vec<f64>> {
    let of = |joint: usize| (0..n).map(|i| 2.0 * spread(i, joint) - 1.0).collect();
    (0..joints).map(of).collect()
}

/// Median time of one prediction by equation 10 as it is written (us).
fn equation_10_us(
    robot: &Robot,
    (n, seed): (usize, u64),
    states: &Samples,
) -> Result<f64, LearnerError> {
    let model = model(robot, ModelKind::Gp, (n, seed))?;
    let mut kernel = RegressorKernel::new(robot, &samples(robot, n, seed));
    let alpha = weights(robot.joint_count(), n);
    let (mut ws, mut tau) = (model.workspace(), vec![0.0; robot.joint_count()]);
    Ok(median_us(|index| {
        let state = states.state(index % states.len());
        model.torque_into(&mut ws, state, &mut tau);
        kernel.add_torque(state, &alpha, &mut tau);
        black_box(&mut tau);
    }))
}

/// `n` states between -2 and 2, without torque, of the sequence that `seed` begins.
fn samples(robot: &Robot, n: usize, seed: u64) -> Samples {
    // Beyond 2^20 numbers of the sequence, rounding would leave little of their fractions.
    let first = (seed % (1 << 20)) as usize;
    let signal = |d: usize| (0..n).map(|i| 4.0 * spread(first + i, d) - 2.0).collect::<Vec<f64>>();
    let joints = (0..robot.joint_count()).map(|j| {
        let state = [signal(3 * j), signal(3 * j + 1), signal(3 * j + 2)];
        PreparedJoint::exact(state, vec![0.0; n])
    });
    let run = PreparedRun {
        name: "made up".to_owned(),
        rate_hz: 1.0,
        time: (0..n).map(|i| i as f64).collect(),
        session_start_s: 0.0,
        joints: joints.collect(),
    };
    Samples::new(&Prepared::exact(vec![run], f64::INFINITY))
}

/// A number from 0 to 1, spread evenly over `i` in another way for every `d`.
fn spread(i: usize, d: usize) -> f64 {
    let golden = 0.618_033_988_749_894_9;
    ((i + 1) as f64 * golden * (d + 1) as f64).fract()
}

/// The processor and how many of its threads there are.
pub fn machine() -> String {
    let cpus = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = cpus.lines().find(|line| line.starts_with("model name"));
    let model = model.and_then(|line| line.split_once(": ")).map(|(_, name)| name);
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    format!(
        "{}, {threads} threads; one prediction runs on one",
        model.unwrap_or(std::env::consts::ARCH)
    )
}
