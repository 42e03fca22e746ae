use effects::{Frame, Hypothesis, Scale, hypotheses};
use logs::LogError;
use nalgebra::{DMatrix, DVector};
use robot::Robot;

use crate::evaluate::{Along, Evaluated};
use crate::fit::Beliefs;
use crate::log::{Log, Look};
use crate::repeats::motions;

/// A hypothesis and its columns in the design.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Group {
    /// The hypothesis.
    pub hypothesis: Hypothesis,
    /// Indices of its columns; two hypotheses may share a column.
    pub columns: Vec<usize>,
    /// Joints that its columns reach.
    pub joints: Vec<usize>,
}

/// The regression problem of all runs: which columns reach which joint, and their values.
#[derive(Debug, Clone)]
pub(crate) struct Design {
    /// The hypotheses.
    pub groups: Vec<Group>,
    /// Number of columns.
    pub width: usize,
    /// Standard deviation of each weight before any data.
    pub prior: Vec<f64>,
    /// Lowest and highest physically possible value of each weight.
    pub bounds: Vec<(f64, f64)>,
    /// The columns that reach each joint, in order.
    pub local: Vec<Vec<usize>>,
    /// One entry a run.
    pub runs: Vec<RunDesign>,
    /// Rate of the samples (Hz).
    pub rate_hz: f64,
    /// What the columns were made in.
    pub frame: Frame,
    /// Joints that moved; the rows of others take no part.
    pub moved: Vec<bool>,
    /// Which joints move in which run, `[run][joint]`.
    pub moves: Vec<Vec<bool>>,
    /// Number of the motion of each run: runs that repeat a motion share it.
    pub motion: Vec<usize>,
    /// What it explains.
    pub look: Look,
}

/// One run of a [`Design`].
#[derive(Debug, Clone)]
pub(crate) struct RunDesign {
    /// Name of the run.
    pub name: String,
    /// Time (s).
    pub time: Vec<f64>,
    /// One entry a joint.
    pub joints: Vec<JointDesign>,
}

/// One joint of a [`RunDesign`], all signals low-passed alike; efforts, columns and what is known of
/// efforts are those of the joint while it moves, and none while it stands.
#[derive(Debug, Clone)]
pub(crate) struct JointDesign {
    /// Samples by local columns.
    pub x: DMatrix<f64>,
    /// Measured effort (N·m or N); or what the first encoder reports beyond the position of the
    /// link (rad or m), in a design of that.
    pub measured: Vec<f64>,
    /// What tones may have in it, what became no torque and what second encoders have shown of it
    /// (N·m or N); empty where there is none of these.
    pub known: Vec<f64>,
    /// The same as the nominal robot has it.
    pub nominal: Vec<f64>,
    /// Position, velocity and acceleration.
    pub state: [Vec<f64>; 3],
    /// Whether a sample tells of the effort: two thirds of what the low-pass takes into it, or more, are of
    /// the joint while it moves. One that stands is held by any part of its dry friction.
    pub tells: Vec<bool>,
    /// Whether the joint slides: where it turns, dry friction is anything up to its level, and what is
    /// left there is nobody's fault.
    pub slides: Vec<bool>,
}

/// Least share of a run's samples in which a joint moves that moves in it.
const MOVES: f64 = 0.05;

impl RunDesign {
    fn moves(&self) -> Vec<bool> {
        let moves = |joint: &JointDesign| {
            let tells = joint.tells.iter().filter(|t| **t).count();
            tells as f64 > MOVES * joint.tells.len() as f64
        };
        self.joints.iter().map(moves).collect()
    }
}

impl JointDesign {
    /// Of a signal of the joint, the samples that tell of its effort.
    pub fn told<'a, T: Copy>(
        &'a self,
        signal: impl IntoIterator<Item = T> + 'a,
    ) -> impl Iterator<Item = T> + 'a {
        signal.into_iter().zip(&self.tells).filter(|(_, tells)| **tells).map(|(value, _)| value)
    }

    /// Measured minus nominal effort (N·m or N).
    pub fn gap(&self) -> impl Iterator<Item = f64> + '_ {
        self.measured.iter().zip(&self.nominal).map(|(m, n)| m - n)
    }

    /// The same without the tones and without what became no torque.
    pub fn residual(&self) -> impl Iterator<Item = f64> + '_ {
        let known = self.known.iter().copied().chain(std::iter::repeat(0.0));
        self.gap().zip(known).map(|(gap, known)| gap - known)
    }
}

impl Design {
    /// Evaluates every hypothesis about `robot` along the prepared runs.
    pub fn new(robot: &Robot, log: &Log) -> Result<Self, LogError> {
        let all: Vec<_> = hypotheses(robot).into_iter().filter(|h| log.asks(*h)).collect();
        Self::of(robot, log, &all)
    }

    /// Evaluates some hypotheses about `robot` along the prepared runs.
    pub fn of(robot: &Robot, log: &Log, hypotheses: &[Hypothesis]) -> Result<Self, LogError> {
        let (frame, scale) = (Frame::of_logs(log.prepared), Scale::of_logs(robot, log.prepared));
        let along = log.along(robot, &frame)?;
        let evaluated = |along: &Along| Evaluated::new(along, hypotheses, log.look);
        let mut evaluated: Vec<Evaluated> =
            along.iter().map(evaluated).collect::<Result<_, LogError>>()?;
        if let Some(described) = log.described {
            let described = log.along(described, &frame)?;
            evaluated.iter_mut().zip(&described).for_each(|(e, along)| e.measure_from(along));
        }
        let mut design = Self {
            groups: Vec::new(),
            width: 0,
            prior: Vec::new(),
            bounds: Vec::new(),
            local: vec![Vec::new(); robot.joint_count()],
            runs: Vec::new(),
            rate_hz: evaluated.first().map_or(0.0, |e| e.rate_hz),
            frame,
            moved: log.rows(),
            look: log.look,
            moves: Vec::new(),
            motion: Vec::new(),
        };
        let origins = design.lay_out(robot, hypotheses, &scale, &evaluated);
        design.runs = evaluated.iter().map(|e| e.to_run(&design.local, &origins)).collect();
        design.moves = design.runs.iter().map(RunDesign::moves).collect();
        design.motion = motions(&design);
        Ok(design)
    }

    /// Gives every distinct column an index and every hypothesis its columns; returns the
    /// hypothesis and weight that each column comes from.
    fn lay_out(
        &mut self,
        robot: &Robot,
        hypotheses: &[Hypothesis],
        scale: &Scale,
        runs: &[Evaluated],
    ) -> Vec<(usize, usize)> {
        let mut origins: Vec<(usize, usize)> = Vec::new();
        for (h, &hypothesis) in hypotheses.iter().enumerate() {
            let prior = hypothesis.prior(robot, scale);
            let bounds = hypothesis.bounds(robot);
            let mut group = Group { hypothesis, columns: Vec::new(), joints: Vec::new() };
            for (k, &sd) in prior.iter().enumerate() {
                let reached =
                    || runs.iter().take(1).flat_map(|r| &r.columns[h][k]).map(|p| p.joint);
                let same = |&(a, b): &(usize, usize)| {
                    runs.iter().all(|r| r.columns[a][b] == r.columns[h][k])
                };
                let index = origins.iter().position(same).unwrap_or(origins.len());
                if index == origins.len() {
                    origins.push((h, k));
                    self.prior.push(sd);
                    self.bounds.push(bounds[k]);
                    reached().for_each(|j| self.local[j].push(index));
                }
                group.columns.push(index);
                group.joints.extend(reached().filter(|&j| self.moved[j]));
            }
            group.joints.sort_unstable();
            group.joints.dedup();
            // What reaches no joint that moved, or has no prior spread, cannot be tested.
            if !group.joints.is_empty() && prior.iter().all(|&sd| sd > 0.0) {
                self.groups.push(group);
            }
        }
        self.width = origins.len();
        origins
    }

    /// What is believed of every weight before any data.
    pub fn beliefs(&self) -> Beliefs<'_> {
        Beliefs { prior: &self.prior, bounds: &self.bounds }
    }

    /// Number of joints.
    pub fn joints(&self) -> usize {
        self.local.len()
    }

    /// Weights of all columns in the local order of joint `j`.
    pub fn local_weights(&self, j: usize, weights: &[f64]) -> Vec<f64> {
        // Where nothing could be fitted there are no weights: nothing is explained then.
        self.local[j].iter().map(|&c| weights.get(c).copied().unwrap_or(0.0)).collect()
    }

    /// Residual of run `r` at joint `j` after the columns with `weights` (N·m or N).
    pub fn remaining(&self, r: usize, j: usize, weights: &[f64]) -> Vec<f64> {
        let joint = &self.runs[r].joints[j];
        let w = DVector::from_vec(self.local_weights(j, weights));
        let explained = &joint.x * w;
        joint.residual().zip(explained.iter()).map(|(y, e)| y - e).collect()
    }

    /// Index of the hypothesis `h` among the groups.
    pub fn find(&self, h: Hypothesis) -> Option<usize> {
        self.groups.iter().position(|g| g.hypothesis == h)
    }
}
