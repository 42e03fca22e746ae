use std::collections::BTreeSet;
use std::ops::Range;

use effects::{Frame, Hypothesis, Priors, Scale, ShapedRobot, hypotheses};
use logs::LogError;
use nalgebra::DVector;
use rayon::prelude::*;
use robot::Robot;

use crate::columns::common::CommonPart;
use crate::columns::evaluated::Evaluated;
use crate::columns::prior::Prior;
use crate::columns::readings::Readings;
use crate::columns::repeats::{Runs, motions};
use crate::columns::run_design::RunDesign;
use crate::signals::along::Along;
use crate::signals::log::Log;
use crate::signals::response::Response;
use crate::thresholds::signals::SignalThresholds;

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
    /// The columns of effects whose size is unknown by decades.
    pub of_any_scale: Vec<Vec<usize>>,
    /// The columns that reach each joint, in order.
    pub local: Vec<Vec<usize>>,
    /// One entry a run.
    pub runs: Vec<RunDesign>,
    /// Rate of the samples (Hz).
    pub rate_hz: f64,
    /// The frame in which the columns were evaluated.
    pub frame: Frame,
    /// Joints that moved; the rows of the others are left out.
    pub moved: Vec<bool>,
    /// Which joints move in which run, `[run][joint]`.
    pub moves: Vec<Vec<bool>>,
    /// Index of the motion of each run: runs that repeat a motion share it.
    pub motion: Vec<usize>,
    /// The signal that the design explains.
    pub response: Response,
    pub priors: Priors,
    /// What the logs have in common with others, if they are compared.
    pub common: Option<CommonPart>,
}

/// A robot evaluated along all runs, and the readings of the logs.
struct MotionAndReadings<'a> {
    frame: Frame,
    along: &'a [Along<'a>],
    readings: Vec<Readings>,
}

impl Design {
    /// Evaluates every hypothesis about `robot` along the prepared runs.
    pub fn new(robot: &Robot, log: &Log) -> Result<Self, LogError> {
        Self::of(robot, log, &hypotheses_of(robot, log))
    }

    /// Evaluates the given hypotheses about `robot` along the prepared runs.
    pub fn of(robot: &Robot, log: &Log, hypotheses: &[Hypothesis]) -> Result<Self, LogError> {
        Self::within(Frame::of_logs(log.prepared), robot, log, hypotheses)
    }

    /// Evaluates every hypothesis about a robot with trial shapes along the prepared runs.
    pub fn of_shaped(shaped: &ShapedRobot, log: &Log) -> Result<Self, LogError> {
        Self::of_shaped_with(shaped, log, &hypotheses_of(&shaped.robot, log))
    }

    /// Evaluates the given hypotheses about a robot with trial shapes along the prepared runs.
    pub fn of_shaped_with(
        shaped: &ShapedRobot,
        log: &Log,
        hypotheses: &[Hypothesis],
    ) -> Result<Self, LogError> {
        let ShapedRobot { robot, trial_gaps, trial_springs, trial_lateness_s } = shaped.clone();
        let of_logs = Frame::of_logs(log.prepared);
        let frame = Frame { trial_gaps, trial_springs, trial_lateness_s, ..of_logs };
        Self::within(frame, &robot, log, hypotheses)
    }

    /// Evaluates the same hypotheses about the same `robot` along other logs.
    pub fn along_others(&self, robot: &Robot, log: &Log) -> Result<Self, LogError> {
        let own = self.groups.iter().map(|group| group.hypothesis);
        let hypotheses: Vec<Hypothesis> = own.filter(|h| log.includes(*h)).collect();
        Self::within(self.frame.clone(), robot, log, &hypotheses)
    }

    fn within(
        frame: Frame,
        robot: &Robot,
        log: &Log,
        hypotheses: &[Hypothesis],
    ) -> Result<Self, LogError> {
        let along = log.along(robot, &frame)?;
        let readings: Vec<Readings> =
            along.par_iter().map(|along| Readings::new(along, log.response)).collect();
        let mut design = Self::assemble(
            robot,
            log,
            hypotheses,
            MotionAndReadings { frame, along: &along, readings },
        )?;
        let thresholds = &log.thresholds.signals;
        let moves = |run: &RunDesign| run.moves(thresholds.moving_share);
        design.moves = design.runs.iter().map(moves).collect();
        design.motion = motions(design.runs_to_compare(thresholds));
        Ok(design)
    }

    /// Evaluates the given hypotheses about another `robot` along the same runs.
    pub fn about(
        &self,
        robot: &Robot,
        log: &Log,
        hypotheses: &[Hypothesis],
    ) -> Result<Self, LogError> {
        let along = log.along(robot, &self.frame)?;
        let readings = self.runs.iter().map(RunDesign::readings).collect();
        let evaluated = MotionAndReadings { frame: self.frame.clone(), along: &along, readings };
        let mut design = Self::assemble(robot, log, hypotheses, evaluated)?;
        design.copy_common(self);
        Ok(Self { moves: self.moves.clone(), motion: self.motion.clone(), ..design })
    }

    /// The design from the robot's motions along the runs and the readings of the logs.
    fn assemble(
        robot: &Robot,
        log: &Log,
        hypotheses: &[Hypothesis],
        MotionAndReadings { frame, along, readings }: MotionAndReadings,
    ) -> Result<Self, LogError> {
        let scale = Scale::of_logs(robot, log.prepared);
        let evaluated =
            |(along, readings)| Evaluated::new(along, readings, hypotheses, log.response);
        let mut evaluated: Vec<Evaluated> = along.par_iter().zip(readings).map(evaluated).collect();
        if let Some(described) = log.described {
            let described = log.along(described, &frame)?;
            evaluated.iter_mut().zip(&described).for_each(|(e, along)| e.measure_from(along));
        }
        let mut design = Self {
            groups: Vec::new(),
            width: 0,
            prior: Vec::new(),
            bounds: Vec::new(),
            of_any_scale: Vec::new(),
            local: vec![Vec::new(); robot.joint_count()],
            runs: Vec::new(),
            rate_hz: evaluated.first().map_or(0.0, |e| e.rate_hz),
            frame,
            moved: log.rows(),
            response: log.response,
            priors: log.thresholds.priors,
            moves: Vec::new(),
            motion: Vec::new(),
            common: None,
        };
        let origins = design.lay_out(robot, hypotheses, &scale, &evaluated);
        design.runs = evaluated.into_iter().map(|e| e.into_run(&design.local, &origins)).collect();
        Ok(design)
    }

    /// Gives every distinct column an index and every hypothesis its columns. Returns the hypothesis and weight that
    /// each column comes from.
    fn lay_out(
        &mut self,
        robot: &Robot,
        hypotheses: &[Hypothesis],
        scale: &Scale,
        runs: &[Evaluated],
    ) -> Vec<(usize, usize)> {
        let mut origins: Vec<(usize, usize)> = Vec::new();
        for (h, &hypothesis) in hypotheses.iter().enumerate() {
            let prior = hypothesis.prior(robot, scale, &self.priors);
            let bounds = hypothesis.bounds(robot, &self.priors);
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
            // A hypothesis that reaches no joint that moved, or has no prior spread, cannot be tested.
            if !group.joints.is_empty() && prior.iter().all(|&sd| sd > 0.0) {
                if hypothesis.has_any_scale() {
                    self.of_any_scale.push(group.columns.clone());
                }
                self.groups.push(group);
            }
        }
        self.width = origins.len();
        origins
    }

    /// The prior of every weight.
    pub fn weight_prior(&self) -> Prior<'_> {
        let Self { prior: sd, bounds, of_any_scale, priors, .. } = self;
        Prior { sd, bounds, of_any_scale, scales: &priors.scales }
    }

    /// The runs, for the comparison of their motions.
    pub fn runs_to_compare<'a>(&'a self, thresholds: &'a SignalThresholds) -> Runs<'a> {
        Runs { runs: &self.runs, rate_hz: self.rate_hz, moved: &self.moved, thresholds }
    }

    /// The columns of some groups and of the common part, in increasing order.
    pub fn columns(&self, groups: &BTreeSet<usize>) -> Vec<usize> {
        let of_groups = groups.iter().flat_map(|&g| self.groups[g].columns.iter().copied());
        let common = self.common.iter().flat_map(|part| part.columns.clone());
        let all: BTreeSet<usize> = of_groups.chain(common).collect();
        all.into_iter().collect()
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

    /// Residual of samples of run `r` at joint `j` after the columns with `weights` (N·m or N).
    pub fn remaining(
        &self,
        (r, samples): (usize, &Range<usize>),
        j: usize,
        weights: &[f64],
    ) -> Vec<f64> {
        let joint = &self.runs[r].joints[j];
        let w = DVector::from_vec(self.local_weights(j, weights));
        let explained = joint.x.rows(samples.start, samples.len()) * w;
        joint.residual().skip(samples.start).zip(explained.iter()).map(|(y, e)| y - e).collect()
    }

    /// Index of the hypothesis `h` among the groups.
    pub fn find(&self, h: Hypothesis) -> Option<usize> {
        self.groups.iter().position(|g| g.hypothesis == h)
    }
}

/// The hypotheses about a robot that a design of some logs includes.
fn hypotheses_of(robot: &Robot, log: &Log) -> Vec<Hypothesis> {
    hypotheses(robot).into_iter().filter(|h| log.includes(*h)).collect()
}
