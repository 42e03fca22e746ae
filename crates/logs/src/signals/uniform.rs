use crate::{
    error::LogError,
    runs::run::{Channel, GoalEffort, Run, range},
    signals::clock::{Fill, Piece, pieces},
};

/// A piece of a run on a uniform clock, not yet filtered.
#[derive(Debug, Clone)]
pub(crate) struct UniformRun {
    /// Index of the run.
    pub run: usize,
    /// Name of the run, with the number of the piece where there are several.
    pub name: String,
    pub rate_hz: f64,
    /// Largest difference between a step of the file and the usual step (s); `None` where the piece was
    /// not resampled.
    pub deviation_s: Option<f64>,
    pub time: Vec<f64>,
    pub joints: Vec<UniformJoint>,
}

#[derive(Debug, Clone)]
pub(crate) struct UniformJoint {
    pub q: Vec<f64>,
    pub effort: Vec<f64>,
    pub velocity: Option<Vec<f64>>,
    pub acceleration: Option<Vec<f64>>,
    /// Position of the link.
    pub link: Option<Vec<f64>>,
    /// Part of the effort that follows the goal.
    pub goal_effort: Option<GoalEffort>,
}

impl UniformRun {
    pub(crate) fn duration_s(&self) -> f64 {
        self.time.len().saturating_sub(1) as f64 / self.rate_hz
    }
}

/// The pieces of one run, each on its own uniform clock.
pub(crate) fn uniform_pieces(run: &Run, index: usize, fill: Fill) -> Vec<UniformRun> {
    let pieces = pieces(&run.time, fill);
    let several = pieces.len() > 1;
    let named = pieces.iter().enumerate().map(|(number, piece)| {
        let name = match several {
            true => format!("{} part {}", run.name, number + 1),
            false => run.name.clone(),
        };
        resample(run, index, name, piece)
    });
    named.collect()
}

fn resample(run: &Run, index: usize, name: String, piece: &Piece) -> UniformRun {
    let time = piece.clock(&run.time);
    let read = |x: &[f64]| piece.resample(&run.time, x, &time);
    let joints = run
        .joints
        .iter()
        .map(|joint| UniformJoint {
            q: read(&joint.position),
            effort: read(&joint.effort),
            velocity: joint.velocity.as_deref().map(read),
            acceleration: joint.acceleration.as_deref().map(read),
            link: joint.link_position.as_deref().map(read),
            goal_effort: joint.goal_effort.as_ref().map(|goal| goal.map(read)),
        })
        .collect();
    let deviation_s = (!piece.is_uniform).then_some(piece.deviation_s);
    UniformRun { run: index, name, rate_hz: piece.rate_hz, deviation_s, time, joints }
}

/// Least range of a moving joint, as a share of the largest range of any joint.
pub(crate) const MOVING_SHARE: f64 = 0.05;

/// Which joints move, per run. The position of a moving joint ranges over a twentieth of the
/// largest range of any joint in any run, and over a thousandth of a radian or metre.
pub(crate) fn moving(runs: &[UniformRun]) -> Vec<Vec<bool>> {
    let span = |q: &[f64]| {
        let (low, high) = range(q);
        high - low
    };
    let largest =
        runs.iter().flat_map(|r| &r.joints).map(|joint| span(&joint.q)).fold(0.0, f64::max);
    let least = (MOVING_SHARE * largest).max(1e-3);
    runs.iter().map(|r| r.joints.iter().map(|joint| span(&joint.q) >= least).collect()).collect()
}

/// Checks that the runs have the same joints and that their signals are complete.
pub(crate) fn check_runs(runs: &[Run]) -> Result<(), LogError> {
    let first = runs.first().ok_or(LogError::NoRuns)?;
    let names = |run: &Run| run.joints.iter().map(|j| j.name.clone()).collect::<Vec<_>>();
    for run in runs {
        if names(run) != names(first) {
            return Err(LogError::JointsDiffer {
                run: run.name.clone(),
                found: names(run),
                first: first.name.clone(),
                expected: names(first),
            });
        }
        let signals = run.joints.iter().flat_map(|joint| {
            let all = Channel::ALL.into_iter().map(|c| (c.suffix(), joint.get(c)));
            let goal = joint.goal_effort.as_ref().map(|goal| goal.values.as_slice());
            let all = all.chain([("goal_effort", goal)]);
            all.filter_map(|(name, x)| Some((format!("{}.{name}", joint.name), x?)))
        });
        for (column, samples) in signals {
            if samples.len() != run.time.len() {
                let (found, expected) = (samples.len(), run.time.len());
                return Err(LogError::WrongLength {
                    run: run.name.clone(),
                    column,
                    found,
                    expected,
                });
            }
        }
    }
    Ok(())
}
