use std::ops::Range;

use dynamics::{
    BaseParameters, ColumnSet, Dynamics, DynamicsError, RegressorColumn, base_parameters,
};
use rayon::prelude::*;
use robot::Robot;

use crate::block_sums::{BlockSums, JointSums, Sums};
use crate::error::LearnerError;
use crate::sample_source::SampleSource;
use crate::samples::{SampleSlices, Samples};

/// Samples that one thread sums at a time: their rows stay in its cache.
const PIECE: usize = 256;

/// Pieces that are summed side by side before they are added up in order.
const BATCH: usize = 64;

/// The largest number that is accepted in a signal: sums of its sixth power are finite.
const LARGEST: f64 = 1e30;

/// Linear regression of the inertial parameters and drives of a robot, from any number of samples.
/// Its memory is that of some Gram matrices.
///
/// ```text
/// tau = Y(q, qd, qdd) pi + noise
/// ```
///
/// Samples are given in the order of time, a stretch or a run after the other
/// ([`Regression::add`]); [`Regression::fit`] solves for the samples so far. For every joint and
/// each of at most 64 blocks of consecutive samples it keeps the sums `X'X`, `X'tau` and `tau'tau`
/// over the base columns `X` that the joint sees.
///
/// # Examples
///
/// A point of 2 kg swings on a hinge, 0.5 m from it: `tau = m l² qdd + m l g cos q`. The hinge
/// sees the sum `m l²` and the moment `m l`, so the mass alone stays as described:
///
/// ```
/// use dynamics::ColumnSet;
/// use learner::{Regression, SampleSlices};
///
/// let described = robot::Robot::from_urdf(r#"<robot name="pendulum">
///   <link name="base"/>
///   <link name="arm"><inertial><origin xyz="0.4 0 0"/><mass value="3"/>
///     <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
///   <joint name="hinge" type="continuous"><parent link="base"/><child link="arm"/>
///     <axis xyz="0 -1 0"/></joint>
/// </robot>"#)?;
/// let time = (0..400).map(|k| 0.01 * f64::from(k));
/// let q: Vec<f64> = time.clone().map(|t| (3.0 * t).sin()).collect();
/// let qd: Vec<f64> = time.clone().map(|t| 3.0 * (3.0 * t).cos()).collect();
/// let qdd: Vec<f64> = q.iter().map(|q| -9.0 * q).collect();
/// let tau: Vec<f64> =
///     q.iter().zip(&qdd).map(|(q, qdd)| 0.5 * qdd + 9.81 * q.cos()).collect();
///
/// let mut regression = Regression::new(&described, ColumnSet::INERTIAL);
/// regression.add(SampleSlices { q: &q, qd: &qd, qdd: &qdd, tau: &tau })?;
/// let fit = regression.fit(None)?;
/// let [mass, mx, iyy] = [0, 1, 6].map(|i| fit.parameters[i]);
/// assert!((mass - 3.0).abs() < 1e-9 && (mx - 1.0).abs() < 1e-9 && (iyy - 0.5).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Regression {
    pub(crate) robot: Robot,
    dynamics: Dynamics,
    set: ColumnSet,
    pub(crate) base: BaseParameters,
    /// Which base parameters each joint sees, by their position among the base parameters.
    pub(crate) seen: Vec<Vec<usize>>,
    pub(crate) sums: BlockSums,
}

impl Regression {
    /// A regression without samples, of the columns `set` of a robot.
    pub fn new(robot: &Robot, set: ColumnSet) -> Self {
        let base = base_parameters(robot, set);
        let sees = |joint: usize| {
            let of = |&i: &usize| is_seen(robot, joint, base.columns[base.independent[i]]);
            (0..base.rank()).filter(of).collect()
        };
        Self {
            robot: robot.clone(),
            dynamics: Dynamics::new(robot),
            set,
            seen: (0..robot.joint_count()).map(sees).collect(),
            base,
            sums: BlockSums::new(),
        }
    }

    /// Number of samples so far.
    pub fn samples(&self) -> usize {
        self.sums.samples()
    }

    /// Adds the next samples. The result is the same for any number of threads, and to rounding for
    /// any way of cutting a record into stretches.
    ///
    /// # Errors
    ///
    /// [`DynamicsError::WrongLength`] when the signals do not have the same whole number of
    /// samples of all joints, and [`LearnerError::BadSample`]. Nothing is added then.
    pub fn add(&mut self, stretch: SampleSlices) -> Result<(), LearnerError> {
        let rows = self.check(&stretch)?;
        let before = self.samples();
        let mut start = 0;
        while start < rows {
            let mut pieces = Vec::with_capacity(BATCH);
            while start < rows && pieces.len() < BATCH {
                let at = before + start;
                let end = self.sums.cut_after(at).min((at / PIECE + 1) * PIECE) - before;
                pieces.push(start..end.min(rows));
                start = end;
            }
            let of = |piece: Range<usize>| self.sums_of(&stretch, piece);
            let summed: Vec<Sums> = pieces.into_par_iter().map(of).collect();
            summed.into_iter().for_each(|sums| self.sums.push(sums));
        }
        Ok(())
    }

    /// Adds all runs of `samples`.
    ///
    /// # Errors
    ///
    /// [`LearnerError::WrongJoints`] and those of [`Regression::add`].
    pub fn add_samples(&mut self, samples: &Samples) -> Result<(), LearnerError> {
        let (expected, got) = (self.robot.joint_count(), samples.joints());
        if got != expected && !samples.is_empty() {
            return Err(LearnerError::WrongJoints { expected, got });
        }
        self.add(samples.stretch())
    }

    /// Adds the samples of a source, a block at a time.
    ///
    /// # Errors
    ///
    /// [`LearnerError::WrongJoints`], those of [`Regression::add`] and those of reading. What comes before is added then.
    pub fn add_source(&mut self, source: &dyn SampleSource) -> Result<(), LearnerError> {
        source.blocks(&mut |block| self.add_samples(block))
    }

    /// Number of samples of a stretch that can be used.
    fn check(&self, stretch: &SampleSlices) -> Result<usize, LearnerError> {
        let joints = self.robot.joint_count();
        let rows = stretch.q.len() / joints;
        let SampleSlices { q, qd, qdd, tau } = *stretch;
        for (name, signal) in [("q", q), ("qd", qd), ("qdd", qdd), ("tau", tau)] {
            let (expected, got) = (rows * joints, signal.len());
            if got != expected {
                return Err(DynamicsError::WrongLength { vector: name, expected, got }.into());
            }
            let usable = |value: &f64| value.abs() <= LARGEST;
            if let Some(at) = signal.iter().position(|value| !usable(value)) {
                let (sample, joint, value) = (at / joints, at % joints, signal[at]);
                return Err(LearnerError::BadSample { signal: name, sample, joint, value });
            }
        }
        Ok(rows)
    }

    /// The sums over the samples `piece`.
    fn sums_of(&self, stretch: &SampleSlices, piece: Range<usize>) -> Sums {
        let joints = self.robot.joint_count();
        let width = self.base.columns.len();
        let mut ws = self.dynamics.workspace();
        let mut y = vec![0.0; joints * width];
        let rows = |seen: &Vec<usize>| Vec::with_capacity(piece.len() * (seen.len() + 1));
        let mut designs: Vec<Vec<f64>> = self.seen.iter().map(rows).collect();
        for sample in piece.clone() {
            let at = sample * joints..(sample + 1) * joints;
            let state = [&stretch.q[at.clone()], &stretch.qd[at.clone()], &stretch.qdd[at.clone()]];
            self.dynamics.columns_into(&mut ws, state, self.set, &mut y);
            for (joint, row) in y.chunks_exact(width).enumerate() {
                let design = &mut designs[joint];
                design.extend(self.seen[joint].iter().map(|&i| row[self.base.independent[i]]));
                design.push(stretch.tau[at.start + joint]);
            }
        }
        let sums = designs.iter().zip(&self.seen).map(|(rows, s)| JointSums::of(rows, s.len() + 1));
        Sums { samples: piece.len(), joints: sums.collect() }
    }
}

/// Whether `column` can differ from zero in the row of `joint`: what it carries, and its drive.
fn is_seen(robot: &Robot, joint: usize, column: RegressorColumn) -> bool {
    match column {
        RegressorColumn::Inertial { link, .. } => {
            let parents = std::iter::successors(Some(link), |&l| robot.links()[l].parent);
            parents.into_iter().any(|l| l == joint)
        }
        RegressorColumn::Rotor { joint: own }
        | RegressorColumn::Viscous { joint: own }
        | RegressorColumn::Coulomb { joint: own }
        | RegressorColumn::Offset { joint: own } => own == joint,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planar::{PlanarRecord, arm, generator, normal};

    const THETA: [f64; 6] = [2.2, 3.1, 0.2, 0.6, 1.4, -0.1];

    fn record(samples: usize) -> PlanarRecord {
        let mut rng = generator(3);
        let motion = PlanarRecord::motion(2, samples);
        let noise: Vec<f64> = motion.q.iter().map(|_| 0.1 * normal(&mut rng)).collect();
        let columns = motion.arm_columns();
        motion.with(&columns, &THETA, &noise)
    }

    fn part(record: &PlanarRecord, samples: Range<usize>) -> SampleSlices<'_> {
        let at = 2 * samples.start..2 * samples.end;
        SampleSlices {
            q: &record.q[at.clone()],
            qd: &record.qd[at.clone()],
            qdd: &record.qdd[at.clone()],
            tau: &record.tau[at],
        }
    }

    #[test]
    fn stretches_of_any_size_give_the_same_fit_to_rounding() {
        let record = record(5000);
        let mut whole = Regression::new(&arm(), ColumnSet::ALL);
        whole.add(record.stretch()).unwrap();
        let whole_fit = whole.fit(None).unwrap();
        for size in [1, 17, 700, 4999] {
            let mut parts = Regression::new(&arm(), ColumnSet::ALL);
            for start in (0..5000).step_by(size) {
                parts.add(part(&record, start..(start + size).min(5000))).unwrap();
            }
            let fit = parts.fit(None).unwrap();
            assert_eq!((fit.samples, fit.groups), (5000, whole_fit.groups));
            for i in 0..fit.columns.len() {
                let (a, b) = (fit.parameters[i], whole_fit.parameters[i]);
                assert!((a - b).abs() < 1e-10, "{}: {a} and {b}", fit.columns[i]);
                let (a, b) = (fit.standard_errors[i], whole_fit.standard_errors[i]);
                assert!((a / b - 1.0).abs() < 1e-6, "{}: {a} and {b}", fit.columns[i]);
            }
        }
    }

    #[test]
    fn the_number_of_threads_changes_no_bit() {
        let record = record(20_000);
        let empty = Regression::new(&arm(), ColumnSet::ALL);
        let fit = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut regression = empty.clone();
                regression.add(record.stretch()).unwrap();
                regression.fit(None).unwrap()
            })
        };
        assert!(fit(1) == fit(3));
    }

    #[test]
    fn memory_is_that_of_64_blocks_however_many_samples_there_are() {
        let record = record(16 * 64 + 1);
        let mut regression = Regression::new(&arm(), ColumnSet::INERTIAL);
        regression.add(part(&record, 0..16 * 64)).unwrap();
        assert_eq!(regression.sums.blocks().len(), 64);
        regression.add(part(&record, 16 * 64..16 * 64 + 1)).unwrap();
        let lengths: Vec<usize> = regression.sums.blocks().iter().map(|b| b.samples).collect();
        assert_eq!((&lengths[..32], &lengths[32..]), (&[32; 32][..], &[1][..]));
    }

    #[test]
    fn what_is_no_signal_is_named_and_nothing_is_added() {
        let mut record = record(40);
        let mut regression = Regression::new(&arm(), ColumnSet::INERTIAL);
        assert_eq!(regression.fit(None), Err(LearnerError::NoSamples));
        record.qdd[2 * 17 + 1] = f64::NAN;
        let error = regression.add(record.stretch()).unwrap_err();
        let place = (17, 1);
        assert!(
            matches!(error, LearnerError::BadSample { signal: "qdd", sample, joint, .. } if (sample, joint) == place),
            "{error}"
        );
        record.qdd[2 * 17 + 1] = 0.0;
        record.tau.pop();
        let error = regression.add(record.stretch()).unwrap_err();
        let wrong = DynamicsError::WrongLength { vector: "tau", expected: 80, got: 79 };
        assert_eq!(error, LearnerError::Dynamics(wrong));
        assert_eq!(regression.samples(), 0);
    }

    #[test]
    fn samples_of_another_arm_are_refused() {
        let state = [vec![0.0], vec![0.0], vec![0.0]];
        let joint = logs::PreparedJoint::exact(state, vec![1.0]);
        let run = logs::PreparedRun {
            name: "run".to_owned(),
            rate_hz: 500.0,
            time: vec![0.0],
            session_start_s: 0.0,
            joints: vec![joint; 3],
        };
        let samples = Samples::new(&logs::Prepared::exact(vec![run], 10.0));
        let mut regression = Regression::new(&arm(), ColumnSet::INERTIAL);
        let error = regression.add_samples(&samples).unwrap_err();
        assert_eq!(error, LearnerError::WrongJoints { expected: 2, got: 3 });
    }
}
