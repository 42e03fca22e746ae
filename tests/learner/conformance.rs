//! What every model of the torque promises, asked of each.

use std::sync::OnceLock;

use gaussian_process::KernelSearch;
use learner::{
    LearnerError, Model, ModelKind, Regression, SampleState, Samples, SilentTraining, Spread,
    TorqueModel, TorqueScore, TrainSettings, TrainedModel, Training,
};
use logs::rest_speeds;
use robot::Robot;

use crate::arm;

const TRAINED: usize = 150;

/// Every model, trained on one run of the planar arm; the "named" robot has viscous friction.
fn fit_all() -> Vec<TrainedModel> {
    let robot = arm::robot();
    let prepared = arm::run(1.0, 400, 1.0);
    let samples = Samples::new(&prepared);
    let search = KernelSearch { starts: 1, start_points: 60, iterations: 200 };
    let settings =
        TrainSettings { points: TRAINED, inducing_points: 60, search, ..TrainSettings::default() };
    let mut regression = Regression::new(&robot, dynamics::ColumnSet::INERTIAL);
    regression.add(samples.stretch()).unwrap();
    let fit = regression.fit(None).unwrap();
    let named = named();
    let rest = rest_speeds(&prepared);
    let mut training = Training::new(&robot, &samples, rest, &settings, &SilentTraining)
        .unwrap()
        .with_regression(&fit)
        .with_named(&named);
    ModelKind::ALL.into_iter().map(|kind| training.fit(kind).unwrap()).collect()
}

fn named() -> Robot {
    let mut robot = arm::robot();
    for j in 0..2 {
        robot.link_mut(j).unwrap().actuator.viscous = 0.4;
    }
    robot
}

fn all() -> &'static [TrainedModel] {
    static ALL: OnceLock<Vec<TrainedModel>> = OnceLock::new();
    ALL.get_or_init(fit_all)
}

fn test_samples() -> Samples {
    Samples::new(&arm::run(2.0, 120, 1.0))
}

/// A state like those of training, and one that is far from all of them.
const NEAR: SampleState = SampleState { q: &[0.3, -0.4], qd: &[0.5, -0.2], qdd: &[1.0, 0.4] };
const FAR: SampleState =
    SampleState { q: &[400.0, -300.0], qd: &[900.0, -800.0], qdd: &[5e3, 4e3] };

fn torque(model: &Model, state: SampleState) -> Vec<f64> {
    let mut tau = vec![0.0; 2];
    model.torque_into(&mut model.workspace(), state, &mut tau);
    tau
}

fn variance(model: &Model, state: SampleState) -> Vec<f64> {
    let mut variance = vec![0.0; 2];
    model.variance_into(&mut model.workspace(), state, &mut variance);
    variance
}

#[test]
fn every_model_predicts_better_than_the_mean_torque_and_knows_its_error() {
    let test = test_samples();
    for fitted in all() {
        let score = TorqueScore::of(&fitted.model, &test);
        for k in 0..2 {
            let what = format!("{} joint {k}: {score:?}", fitted.model.kind);
            assert!(score.nmse[k] < 0.5, "{what}");
            assert!(score.coverage[k] > 0.5, "{what}");
        }
    }
}

#[test]
fn a_batch_is_the_single_queries_torques_bit_by_bit() {
    let test = test_samples();
    for TrainedModel { model, .. } in all() {
        let (together, spread) = (model.torque(&test), model.variance(&test));
        for i in 0..test.len() {
            assert_eq!(torque(model, test.state(i)), together[2 * i..2 * i + 2], "{}", model.kind);
            let state = test.state(i);
            for (k, one) in variance(model, state).into_iter().enumerate() {
                let (all, bound) = (spread[2 * i + k], rounding(model, k, state));
                assert!((one - all).abs() <= bound, "{}: {one} {all} {bound}", model.kind);
            }
        }
    }
}

/// What the order of its sums may change in a variance: 1e-10 of the signal variance, of which it is
/// what is left, or the rounding of `k' M k` itself where that is more,
///
/// ```text
/// 2 eps sqrt(2 n sum_ij (k_i M_ij k_j)²)
/// ```
///
/// of two sums, each term taking part in `2 n` roundings that know nothing of each other.
fn rounding(model: &Model, joint: usize, state: SampleState) -> f64 {
    let Some(process) = &model.process else { return 0.0 };
    let signals = process.sum.kernels().iter().map(|kernel| kernel.signal_variance);
    let usual = 1e-10 * signals.fold(0.0, f64::max);
    let Some(Spread::Exact { inverse, .. }) = &process.spread else { return usual };
    let (mut x, mut k_star) = (vec![0.0; process.inputs.width()], vec![0.0; process.sum.len()]);
    process.inputs.fill(state, &mut x);
    process.sum.covariances_into(joint, &x, &mut k_star);
    let term = |i: usize, j: usize| k_star[i] * inverse[joint].entry(i, j) * k_star[j];
    let n = k_star.len();
    let squares: f64 = (0..n).map(|i| (0..n).map(|j| term(i, j).powi(2)).sum::<f64>()).sum();
    usual.max(2.0 * f64::EPSILON * (2.0 * n as f64 * squares).sqrt())
}

#[test]
fn training_does_not_depend_on_the_number_of_threads() {
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let (one, three) = (pool(1).install(fit_all), pool(3).install(fit_all));
    for (a, b) in one.iter().zip(&three) {
        assert_eq!(torque(&a.model, NEAR), torque(&b.model, NEAR), "{}", a.model.kind);
        assert_eq!(variance(&a.model, NEAR), variance(&b.model, NEAR), "{}", a.model.kind);
        assert_eq!(a.joints, b.joints, "{}", a.model.kind);
    }
}

#[test]
fn a_query_allocates_nothing() {
    for TrainedModel { model, .. } in all() {
        let (mut ws, mut tau) = (model.workspace(), vec![0.0; 2]);
        let count = allocation_counter::measure(|| {
            model.torque_into(&mut ws, NEAR, &mut tau);
            model.variance_into(&mut ws, NEAR, &mut tau);
        });
        assert_eq!(count.count_total, 0, "{}", model.kind);
    }
}

#[test]
fn far_from_the_data_the_mean_is_left_and_the_prior_variance() {
    for TrainedModel { model, .. } in all() {
        let Some(process) = &model.process else { continue };
        let mut bare = model.clone();
        bare.process = None;
        assert_eq!(torque(model, FAR), torque(&bare, FAR), "{}", model.kind);
        let (found, linear) = (variance(model, FAR), variance(&bare, FAR));
        for k in 0..2 {
            let expected = process.sum.kernels()[k].signal_variance + linear[k];
            assert!((found[k] / expected - 1.0).abs() < 1e-12, "{} joint {k}", model.kind);
        }
    }
}

#[test]
fn near_the_data_the_variance_falls_well_below_the_prior() {
    for TrainedModel { model, .. } in all() {
        let Some(process) = &model.process else { continue };
        let found = variance(model, NEAR);
        for (k, kernel) in process.sum.kernels().iter().enumerate() {
            let noise = model.noise_variance[k];
            let latent = found[k] - noise;
            assert!(
                latent >= 0.0 && latent < 0.2 * kernel.signal_variance + noise,
                "{}",
                model.kind
            );
        }
    }
}

#[test]
fn a_model_that_is_saved_and_read_again_predicts_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let (robot, test) = (arm::robot(), test_samples());
    for TrainedModel { model, .. } in all() {
        let path = folder.path().join(format!("{}.parquet", model.kind));
        model.save(&path).unwrap();
        let read = Model::load(&path, &robot).unwrap().with_variance().unwrap();
        assert_eq!(read.words(), model.words());
        assert_eq!(read.torque(&test), model.torque(&test), "{}", model.kind);
        let pairs = read.variance(&test).into_iter().zip(model.variance(&test));
        for (found, expected) in pairs {
            assert!((found / expected - 1.0).abs() < 1e-9, "{}: {found} {expected}", model.kind);
        }
    }
}

/// Every key of a drive that its torque, or what undoes it, depends on.
#[test]
fn a_saved_model_keeps_all_that_the_extended_robot_says_of_its_drives() {
    let mut robot = named();
    checks::arms::put_in_everything(&mut robot.link_mut(1).unwrap().actuator);
    let torque = learner::RobotTorque::new(robot.clone(), vec![0.01; 2]);
    let mean = learner::Mean::Robot(Box::new(torque));
    let model = Model::new(ModelKind::Named, &arm::robot(), mean, vec![0.1; 2]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("named.parquet");
    model.save(&path).unwrap();
    let learner::Mean::Robot(read) = Model::load(&path, &arm::robot()).unwrap().mean else {
        panic!("the mean is a robot");
    };
    assert_eq!(read.robot().links()[1].actuator, robot.links()[1].actuator);
}

#[test]
fn a_joint_without_its_process_is_predicted_by_the_mean_with_the_given_noise() {
    let folder = tempfile::tempdir().unwrap();
    let whole = &all().iter().find(|f| f.model.kind == ModelKind::NamedGp).unwrap().model;
    let mut model = whole.clone();
    model.drop_process(1, 0.3).unwrap();
    let mut bare = whole.clone();
    bare.process = None;
    let path = folder.path().join("model.parquet");
    model.save(&path).unwrap();
    let read = Model::load(&path, &arm::robot()).unwrap().with_variance().unwrap();
    for model in [model, read] {
        let (found, expected) = (torque(&model, NEAR), torque(whole, NEAR));
        assert_eq!(found, [expected[0], torque(&bare, NEAR)[1]]);
        assert!((found[1] - expected[1]).abs() > 1e-6);
        let (found, expected) = (variance(&model, NEAR), variance(whole, NEAR));
        assert!((found[0] / expected[0] - 1.0).abs() < 1e-9 && (found[1] - 0.3).abs() < 1e-15);
    }
}

#[test]
fn a_file_that_is_no_model_of_this_robot_is_refused_in_one_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.parquet");
    let model = &all().iter().find(|f| f.model.kind == ModelKind::GpRbdPrior).unwrap().model;
    model.save(&path).unwrap();
    let refused = |path: &std::path::Path, robot: &Robot| match Model::load(path, robot) {
        Ok(_) => panic!("{} was read", path.display()),
        Err(error) => error,
    };
    let other = refused(&path, &checks::arms::wam());
    assert!(matches!(other, LearnerError::OtherRobot { .. }), "{other}");
    let bytes = std::fs::read(&path).unwrap();
    for cut in [0, 3, 100, bytes.len() / 2, bytes.len() - 1] {
        let short = folder.path().join("short.parquet");
        std::fs::write(&short, &bytes[..cut]).unwrap();
        let error = refused(&short, &arm::robot());
        assert!(matches!(error, LearnerError::NotAModel { .. }), "{cut}: {error}");
    }
    let absent = refused(&folder.path().join("absent.parquet"), &arm::robot());
    assert!(absent.to_string().contains("absent.parquet"), "{absent}");
}

#[test]
fn a_damaged_model_never_ends_the_program() {
    let folder = tempfile::tempdir().unwrap();
    let (path, robot) = (folder.path().join("model.parquet"), arm::robot());
    let model = &all().iter().find(|f| f.model.kind == ModelKind::GpInducing).unwrap().model;
    model.save(&path).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    for k in 0..200 {
        let mut damaged = bytes.clone();
        let at = (k * 7919 + 13) % damaged.len();
        damaged[at] ^= 0x55;
        std::fs::write(&path, &damaged).unwrap();
        // Numbers may be wrong; what is not whole is an error, not a panic.
        drop(Model::load(&path, &robot));
    }
}

#[test]
fn the_prior_on_the_parameters_is_the_kernel_of_the_columns() {
    // Rigid bodies describe this log, so the prior's and the kernel's way agree with them.
    let robot = arm::robot();
    let prepared = arm::run(1.0, 300, 0.0);
    let samples = Samples::new(&prepared);
    let mut regression = Regression::new(&robot, dynamics::ColumnSet::INERTIAL);
    regression.add(samples.stretch()).unwrap();
    let fit = regression.fit(None).unwrap();
    let search = KernelSearch { starts: 1, start_points: 60, iterations: 25 };
    let settings = TrainSettings { points: 100, search, ..TrainSettings::default() };
    let mut training =
        Training::new(&robot, &samples, rest_speeds(&prepared), &settings, &SilentTraining)
            .unwrap()
            .with_regression(&fit);
    let test = Samples::new(&arm::run(2.0, 120, 0.0));
    let kinds = [ModelKind::Rbd, ModelKind::GpRbd, ModelKind::GpRbdPrior, ModelKind::GpRbdShared];
    for kind in kinds.into_iter().chain([ModelKind::RbdKernel, ModelKind::RbdKernelJoint]) {
        let score = TorqueScore::of(&training.fit(kind).unwrap().model, &test);
        assert!(score.nmse.iter().all(|nmse| *nmse < 1e-3), "{kind}: {score:?}");
    }
    let gp = TorqueScore::of(&training.fit(ModelKind::Gp).unwrap().model, &test);
    let rbd = TorqueScore::of(&training.fit(ModelKind::Rbd).unwrap().model, &test);
    assert!(rbd.nmse.iter().zip(&gp.nmse).all(|(r, g)| *r < 0.2 * g), "{rbd:?} {gp:?}");
}

#[test]
fn what_cannot_be_trained_is_refused_by_name() {
    let robot = arm::robot();
    let prepared = arm::run(1.0, 50, 1.0);
    let samples = Samples::new(&prepared);
    let rest = rest_speeds(&prepared);
    let settings = TrainSettings { points: 20, ..TrainSettings::default() };
    let mut bare =
        Training::new(&robot, &samples, rest.clone(), &settings, &SilentTraining).unwrap();
    for kind in ModelKind::ALL {
        if kind.needs_regression() || kind.needs_named_effects() {
            let refused = bare.fit(kind).unwrap_err();
            assert!(matches!(refused, LearnerError::Missing { .. }), "{kind}: {refused}");
        }
    }
    let none = TrainSettings { points: 0, ..TrainSettings::default() };
    let zero = Training::new(&robot, &samples, rest.clone(), &none, &SilentTraining).err().unwrap();
    assert!(matches!(zero, LearnerError::Setting { name: "points", .. }), "{zero}");
    let wam = checks::arms::wam();
    let other =
        Training::new(&wam, &samples, rest.clone(), &settings, &SilentTraining).err().unwrap();
    assert!(matches!(other, LearnerError::WrongJoints { expected: 7, got: 2 }), "{other}");
    let mut broken = prepared.clone();
    broken.runs[0].joints[1].qdd[17] = f64::NAN;
    let nan = Samples::new(&broken);
    let refused = Training::new(&robot, &nan, rest, &settings, &SilentTraining).err().unwrap();
    let expected = "qdd of joint 1 in sample 17 is NaN, which no sensor reports";
    assert_eq!(refused.to_string(), expected);
}

/// Every model that can be trained without a regression or named effects.
fn bare_kinds() -> impl Iterator<Item = ModelKind> {
    ModelKind::ALL
        .into_iter()
        .filter(|kind| !kind.needs_regression() && !kind.needs_named_effects())
}

#[test]
fn logs_that_tell_nothing_still_train() {
    let robot = arm::robot();
    let search = KernelSearch { starts: 1, start_points: 20, iterations: 10 };
    let settings =
        TrainSettings { points: 30, inducing_points: 10, search, ..TrainSettings::default() };
    let mut still = arm::run(1.0, 40, 1.0);
    for joint in &mut still.runs[0].joints {
        for signal in [&mut joint.q, &mut joint.qd, &mut joint.qdd, &mut joint.wide.qd] {
            signal.fill(0.0);
        }
    }
    let mut silent = arm::run(1.0, 40, 1.0);
    silent.runs[0].joints.iter_mut().for_each(|joint| joint.effort.fill(0.0));
    for prepared in [still, silent, arm::run(1.0, 1, 1.0), arm::run(1.0, 2, 1.0)] {
        let samples = Samples::new(&prepared);
        let rest = rest_speeds(&prepared);
        let mut training =
            Training::new(&robot, &samples, rest, &settings, &SilentTraining).unwrap();
        for kind in bare_kinds() {
            let fitted = training.fit(kind).unwrap_or_else(|e| panic!("{kind}: {e}"));
            assert!(torque(&fitted.model, NEAR).iter().all(|t| t.is_finite()), "{kind}");
            assert!(variance(&fitted.model, NEAR).iter().all(|v| *v >= 0.0), "{kind}");
        }
    }
}
