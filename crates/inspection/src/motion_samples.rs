use logs::{LowPass, Run};

use crate::pieces::RunPiece;
use crate::scale::scale_s;
use crate::thresholds::InspectionThresholds;

/// Motion and effort of all joints at some hundred moments, low-passed alike.
///
/// All are row-major, `rows x joints`; units are those of the log.
#[derive(Debug, Clone)]
pub(crate) struct MotionSamples {
    /// Number of joints.
    pub joints: usize,
    /// Position, velocity and acceleration.
    pub motion: [Vec<f64>; 3],
    /// Effort.
    pub effort: Vec<f64>,
    /// Time between two rows of the log (s).
    pub step_s: f64,
    /// Velocity column, NaN where the log has none.
    pub velocity: Vec<f64>,
    /// Rate of the part of the effort that follows the goal, `kp d goal/dt` (N m/s or N/s); zero where efforts are logged.
    pub goal_rate: Vec<f64>,
    /// Index of the run of each row.
    run: Vec<usize>,
    /// Share of the largest speed of a joint from which on it moves.
    moving_speed: f64,
    /// Rows of a joint's own motion that are enough to judge it by.
    enough_rows: usize,
}

/// Rows that are looked at, over all runs.
const ROWS: usize = 480;

/// Time over which the filter settles, in scales of the motion.
const SETTLING: usize = 3;

/// Pieces of runs after the low-pass of their motion: what samples are taken from.
pub(crate) struct Thinned {
    joints: usize,
    pieces: Vec<Smooth>,
    rows: Vec<Row>,
    moving_speed: f64,
    enough_rows: usize,
}

/// A piece, and one of its rows.
#[derive(Debug, Clone, Copy)]
struct Row {
    piece: usize,
    k: usize,
}

impl Thinned {
    /// Low-passes the pieces; `None` where none is long enough.
    ///
    /// The low-pass is that of the motion: `cutoff = rate / (2 scale)` with the scale of the piece in samples. Rows
    /// are those in which some joint moves.
    pub fn of(runs: &[Run], pieces: &[RunPiece], t: &InspectionThresholds) -> Option<Self> {
        let joints = runs.first()?.joints.len();
        let scale_s = scale_s(pieces, t)?;
        let pieces: Vec<Smooth> =
            pieces.iter().filter_map(|p| Smooth::of(p, scale_s, t.shortest_piece)).collect();
        let fastest: Vec<f64> = (0..joints)
            .map(|j| pieces.iter().flat_map(|s| &s.joints[j][1]).fold(0.0, |m, v| v.abs().max(m)))
            .collect();
        let moves = |row: &Row| {
            let speed = |j: usize| pieces[row.piece].joints[j][1][row.k].abs();
            (0..joints).any(|j| speed(j) > t.moving_speed * fastest[j])
        };
        let of_piece = |(piece, s): (usize, &Smooth)| (0..s.len()).map(move |k| Row { piece, k });
        let all: Vec<Row> = pieces.iter().enumerate().flat_map(of_piece).filter(moves).collect();
        let step = all.len().div_ceil(ROWS).max(1);
        let rows = all.into_iter().step_by(step).collect();
        let (moving_speed, enough_rows) = (t.moving_speed, t.enough_rows);
        Some(Self { joints, pieces, rows, moving_speed, enough_rows })
    }

    /// The samples, with the efforts of `later` rows behind those of the motion.
    ///
    /// Rows that have none within `reach` either way are left out.
    pub fn samples(&self, reach: usize, later: isize) -> MotionSamples {
        let inside = |r: &&Row| r.k >= reach && r.k + reach < self.pieces[r.piece].len();
        let rows: Vec<Row> = self.rows.iter().filter(inside).copied().collect();
        let read = |channel: usize, later: isize| -> Vec<f64> {
            let of = |r: &Row| {
                let k = r.k.saturating_add_signed(later);
                self.pieces[r.piece].joints.iter().map(move |j| j[channel][k])
            };
            rows.iter().flat_map(of).collect()
        };
        MotionSamples {
            joints: self.joints,
            motion: [read(0, 0), read(1, 0), read(2, 0)],
            effort: read(3, later),
            velocity: read(4, 0),
            goal_rate: read(5, later),
            run: rows.iter().map(|r| self.pieces[r.piece].run).collect(),
            step_s: self.pieces.iter().map(|p| p.log_step_s).fold(0.0, f64::max),
            moving_speed: self.moving_speed,
            enough_rows: self.enough_rows,
        }
    }

    /// Time between two rows of a piece (s), and the rows of the shortest piece.
    pub fn spacing(&self) -> Option<(f64, usize)> {
        let shortest = self.pieces.iter().map(Smooth::len).min()?;
        Some((self.pieces.first()?.step_s, shortest))
    }
}

impl MotionSamples {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.effort.len() / self.joints.max(1)
    }

    /// Whether the effort of joint `j` is computed from goals, which moved.
    pub fn has_goals(&self, j: usize) -> bool {
        self.goal_rate.iter().skip(j).step_by(self.joints.max(1)).any(|rate| rate.abs() > 0.0)
    }

    /// The values of joint `j` in its informative rows.
    pub fn column(&self, signal: &[f64], j: usize) -> Vec<f64> {
        let all = signal.iter().skip(j).step_by(self.joints.max(1));
        all.zip(&self.informative(j)).filter(|(_, is)| **is).map(|(x, _)| *x).collect()
    }

    /// The run of each informative row of joint `j`.
    pub fn runs(&self, j: usize) -> Vec<usize> {
        let all = self.run.iter().zip(self.informative(j));
        all.filter(|(_, is)| *is).map(|(run, _)| *run).collect()
    }

    /// Direction of motion of joint `j` in its informative rows, smooth about rest.
    pub fn direction(&self, j: usize) -> Vec<f64> {
        let qd = self.column(&self.motion[1], j);
        let fastest = qd.iter().fold(f64::MIN_POSITIVE, |most, v| v.abs().max(most));
        qd.iter().map(|v| (v / (self.moving_speed * fastest)).tanh()).collect()
    }

    /// Rows in which joint `j` moves: at rest dry friction holds any effort within its level. All rows where it hardly moves.
    /// The values of joint `j` in its informative rows of a run.
    pub fn column_of_run(&self, signal: &[f64], j: usize, run: usize) -> Vec<f64> {
        let all = signal.iter().skip(j).step_by(self.joints.max(1)).zip(&self.run);
        let own = all.zip(self.informative(j)).filter(|((_, of), is)| *is && **of == run);
        own.map(|((x, _), _)| *x).collect()
    }

    fn informative(&self, j: usize) -> Vec<bool> {
        let speeds = || self.motion[1].iter().skip(j).step_by(self.joints.max(1)).map(|v| v.abs());
        let least = self.moving_speed * speeds().fold(0.0, f64::max);
        let moves: Vec<bool> = speeds().map(|v| v > least).collect();
        let enough = moves.iter().filter(|m| **m).count() >= self.enough_rows;
        if enough { moves } else { vec![true; self.rows()] }
    }
}

/// A piece after its low-pass, at every few of its samples.
struct Smooth {
    /// Per joint: position, velocity, acceleration, effort, velocity column, rate of the effort that follows the goal.
    joints: Vec<[Vec<f64>; 6]>,
    /// Index of the run.
    run: usize,
    /// Time between two of its rows (s).
    step_s: f64,
    /// Time between two rows of the log (s).
    log_step_s: f64,
}

/// Mean of a velocity over `near` samples either way: what the central difference of the position is.
fn mean(v: &[f64], k: usize, near: usize) -> f64 {
    let inner: f64 = v[k + 1 - near..k + near].iter().sum();
    (inner + 0.5 * (v[k - near] + v[k + near])) / (2 * near) as f64
}

impl Smooth {
    fn of(piece: &RunPiece, scale_s: f64, shortest: usize) -> Option<Self> {
        let scale = ((scale_s / piece.step_s).round() as usize).max(1);
        let cutoff = 0.5 / scale as f64;
        let filter = LowPass::new(4, cutoff.min(0.45), 1.0).ok();
        let length = piece.len();
        let end = SETTLING * scale;
        if length < shortest * end {
            return None;
        }
        let apply = |x: &[f64]| {
            let mut x = x.to_vec();
            if let Some(filter) = filter.as_ref().filter(|_| scale > 1) {
                filter.apply(&mut x);
            }
            x
        };
        let near = (scale / 4).max(1);
        let stride = (scale / 2).max(1);
        let kept = || (end..length - end).step_by(stride);
        let joint = |j: usize| {
            let signals = &piece.joints[j];
            let (q, effort) = (apply(&signals.position), apply(&signals.effort));
            let h = near as f64 * piece.step_s;
            let velocity = signals.velocity.as_deref().map(apply);
            let goal = signals.goal_effort.as_deref().map(apply);
            [
                kept().map(|k| q[k]).collect(),
                kept().map(|k| 0.5 * (q[k + near] - q[k - near]) / h).collect(),
                kept().map(|k| (q[k + near] - 2.0 * q[k] + q[k - near]) / (h * h)).collect(),
                kept().map(|k| effort[k]).collect(),
                kept().map(|k| velocity.as_ref().map_or(f64::NAN, |v| mean(v, k, near))).collect(),
                kept()
                    .map(|k| goal.as_ref().map_or(0.0, |g| 0.5 * (g[k + near] - g[k - near]) / h))
                    .collect(),
            ]
        };
        let step_s = stride as f64 * piece.step_s;
        Some(Self {
            joints: (0..piece.joints.len()).map(joint).collect(),
            run: piece.run,
            step_s,
            log_step_s: piece.step_s,
        })
    }

    fn len(&self) -> usize {
        self.joints.first().map_or(0, |j| j[0].len())
    }
}
