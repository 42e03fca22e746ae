use std::ops::Range;

#[cfg(doc)]
use crate::{Agreement, differentiate};
use crate::{
    LogError, LogWarning, LowPass, Run,
    clock::LONGEST_FILLED,
    cutoff,
    cutoff::MULTIPLE,
    duplicate_of,
    filtered::{Filtered, ORDER, SETTLING_PERIODS, choose_sources},
    info::{saturation, unknown_joints},
    uniform::{UniformRun, check, moving, uniform},
};

/// How a log is prepared.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PrepareSettings {
    /// Cut-off of the low-pass (Hz); `None` to choose it from the data.
    pub cutoff_hz: Option<f64>,
}

/// A log ready for identification.
#[derive(Debug, Clone, PartialEq)]
pub struct Prepared {
    /// The runs; one that was split at long gaps gives several, named `... part 1`.
    pub runs: Vec<PreparedRun>,
    /// Cut-off of the low-pass (Hz), the same for all runs and joints.
    pub cutoff_hz: f64,
    /// Why this cut-off, in a sentence.
    pub cutoff_reason: String,
    /// What the reader should know about the log.
    pub warnings: Vec<LogWarning>,
}

/// One run on a uniform clock, without its ends.
#[derive(Debug, Clone, PartialEq)]
pub struct PreparedRun {
    /// Name of the run.
    pub name: String,
    /// Sampling rate (Hz).
    pub rate_hz: f64,
    /// Time of each sample, on the clock of the file (s).
    pub time: Vec<f64>,
    /// Signals of each joint, in the order of the robot.
    pub joints: Vec<PreparedJoint>,
}

/// Signals of one joint, one value per entry of `time`.
#[derive(Debug, Clone, PartialEq)]
pub struct PreparedJoint {
    /// Position, low-passed (rad or m).
    pub q: Vec<f64>,
    /// Velocity, low-passed (rad/s or m/s).
    pub qd: Vec<f64>,
    /// Acceleration, low-passed (rad/s² or m/s²).
    pub qdd: Vec<f64>,
    /// The same behind four times the cut-off.
    pub wide: Wide,
    /// Effort on the same clock, not low-passed (N·m or N).
    pub effort: Vec<f64>,
    /// The motion of the link, where a second encoder shows it in every run.
    pub link: Option<PreparedLink>,
}

/// Motion behind four times the cut-off of the other signals: what a model makes of it and the
/// measured effort may then pass the same low-pass, and the sign of the velocity is that of the
/// motion up to the moments at which it starts and stops.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Wide {
    /// Position (rad or m).
    pub q: Vec<f64>,
    /// Velocity (rad/s or m/s).
    pub qd: Vec<f64>,
    /// Acceleration (rad/s² or m/s²).
    pub qdd: Vec<f64>,
}

/// What a second encoder at the link of a joint shows.
#[derive(Debug, Clone, PartialEq)]
pub struct PreparedLink {
    /// Position of the link, low-passed (rad or m).
    pub q: Vec<f64>,
    /// Its velocity, low-passed (rad/s or m/s).
    pub qd: Vec<f64>,
    /// Its acceleration, low-passed (rad/s² or m/s²).
    pub qdd: Vec<f64>,
    /// Position of the joint's first encoder minus that of the link, not low-passed (rad or m).
    pub twist: Vec<f64>,
}

/// Brings runs to a uniform clock and low-passes them.
///
/// 1. Clock: a run whose rows lie on a uniform clock is kept as it is; any other is
///    interpolated (cubic) at its usual rate, rounded. It is split at gaps of more than
///    five samples.
/// 2. Low-pass: zero-phase Butterworth of order 4 ([`LowPass`]), one cut-off for all runs
///    and joints. It is five times the bandwidth of the motion, unless it is given. The same
///    signals behind four times that are kept beside ([`Wide`]).
/// 3. Derivatives ([`differentiate`], of low-passed signals):
///
/// ```text
/// q   = L position
/// qd  = L velocity        where it agrees with d/dt q, else d/dt q
/// qdd = L acceleration    where it agrees with d/dt qd, else d/dt qd
/// ```
///
///    so that all three have passed the same filter `L`. A column agrees when
///    [`Agreement::holds`] in every run in which the joint moves. The motion of a link that a
///    second encoder shows is made likewise, all of it from its position.
/// 4. `1.5 / cutoff` seconds are cut from both ends, where this filter and those of the
///    robot's own software still settle.
///
/// # Errors
///
/// [`LogError::NoRuns`], [`LogError::JointsDiffer`], [`LogError::WrongLength`],
/// [`LogError::CutoffOutOfRange`] and [`LogError::RunTooShort`].
pub fn prepare(runs: &[Run], settings: &PrepareSettings) -> Result<Prepared, LogError> {
    check(runs)?;
    let all: Vec<UniformRun> =
        runs.iter().enumerate().flat_map(|(index, run)| uniform(run, index)).collect();
    let (cutoff_hz, cutoff_reason) = match settings.cutoff_hz {
        Some(given) => (given, format!("{given} Hz: it was given")),
        None => cutoff::choose(&all, &moving(&all)),
    };
    for piece in &all {
        LowPass::new(ORDER, cutoff_hz, piece.rate_hz)?;
    }
    let mut warnings = about_runs(runs, &all, cutoff_hz);
    let mut pieces = long_enough(runs, all, cutoff_hz)?;
    warnings.extend(whole_links(runs, &mut pieces));

    let filtered: Result<Vec<_>, _> = pieces.iter().map(|p| Filtered::of(p, cutoff_hz)).collect();
    let mut filtered = filtered?;
    let moves = moving(&pieces);
    for (joint, channels) in runs[0].joints.iter().enumerate() {
        let in_motion: Vec<bool> = moves.iter().map(|m| m[joint]).collect();
        let found = choose_sources(&mut filtered, &in_motion, joint, cutoff_hz);
        for warning in found.into_iter().map(|d| d.warning(&pieces, &channels.name)) {
            let left = warnings.iter_mut().try_fold(warning, |left, known| known.join(left));
            warnings.extend(left);
        }
    }
    let ends = pieces.into_iter().zip(filtered).map(|(piece, f)| without_ends(piece, f));
    Ok(Prepared { runs: ends.collect(), cutoff_hz, cutoff_reason, warnings })
}

impl Prepared {
    /// Frequency below which the motion lies (Hz), by the rule that chooses the cut-off.
    pub fn motion_hz(&self) -> f64 {
        self.cutoff_hz / MULTIPLE
    }

    /// Lowest and highest position of joint `j` over all runs (rad or m).
    pub fn span(&self, j: usize) -> (f64, f64) {
        let q = self.runs.iter().flat_map(|run| &run.joints[j].q);
        q.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &q| (l.min(q), h.max(q)))
    }
}

impl PreparedJoint {
    /// A joint without second encoder whose motion is exact: no low-pass has a part in it.
    pub fn exact([q, qd, qdd]: [Vec<f64>; 3], effort: Vec<f64>) -> Self {
        let wide = Wide { q: q.clone(), qd: qd.clone(), qdd: qdd.clone() };
        Self { q, qd, qdd, wide, effort, link: None }
    }
}

impl PreparedRun {
    /// The run's `samples` alone; what lies beyond its end is left out.
    pub fn part(&self, samples: Range<usize>) -> Self {
        let end = samples.end.min(self.time.len());
        let samples = samples.start.min(end)..end;
        let part = |x: &[f64]| x[samples.clone()].to_vec();
        let joint = |j: &PreparedJoint| PreparedJoint {
            q: part(&j.q),
            qd: part(&j.qd),
            qdd: part(&j.qdd),
            wide: Wide { q: part(&j.wide.q), qd: part(&j.wide.qd), qdd: part(&j.wide.qdd) },
            effort: part(&j.effort),
            link: j.link.as_ref().map(|link| PreparedLink {
                q: part(&link.q),
                qd: part(&link.qd),
                qdd: part(&link.qdd),
                twist: part(&link.twist),
            }),
        };
        Self {
            name: self.name.clone(),
            rate_hz: self.rate_hz,
            time: part(&self.time),
            joints: self.joints.iter().map(joint).collect(),
        }
    }
}

/// The shortest piece that is of use (s): a third of it is left between the ends.
fn shortest_s(cutoff_hz: f64) -> f64 {
    3.0 * SETTLING_PERIODS / cutoff_hz
}

/// The pieces that are long enough, at least one of every run.
fn long_enough(
    runs: &[Run],
    all: Vec<UniformRun>,
    cutoff_hz: f64,
) -> Result<Vec<UniformRun>, LogError> {
    let expected_s = shortest_s(cutoff_hz);
    for (index, run) in runs.iter().enumerate() {
        let own = all.iter().filter(|p| p.run == index);
        let found_s = own.map(UniformRun::duration_s).fold(0.0, f64::max);
        if found_s < expected_s {
            let run = run.name.clone();
            return Err(LogError::RunTooShort { run, found_s, expected_s, cutoff_hz });
        }
    }
    Ok(all.into_iter().filter(|p| p.duration_s() >= expected_s).collect())
}

fn without_ends(piece: UniformRun, filtered: Filtered) -> PreparedRun {
    let kept = filtered.settled();
    let cut = |x: Vec<f64>| x[kept.clone()].to_vec();
    let joints = piece
        .joints
        .into_iter()
        .zip(filtered.joints)
        .map(|(raw, f)| PreparedJoint {
            link: raw.link.zip(f.link).map(|(link, [q, qd, qdd])| PreparedLink {
                q: cut(q),
                qd: cut(qd),
                qdd: cut(qdd),
                twist: cut(raw.q.iter().zip(link).map(|(q, link)| q - link).collect()),
            }),
            q: cut(f.own.q),
            qd: cut(f.own.qd),
            qdd: cut(f.own.qdd),
            wide: Wide { q: cut(f.wide.q), qd: cut(f.wide.qd), qdd: cut(f.wide.qdd) },
            effort: cut(raw.effort),
        })
        .collect();
    PreparedRun { name: piece.name, rate_hz: piece.rate_hz, time: cut(piece.time), joints }
}

/// Leaves out the second encoder of a joint that some runs lack.
fn whole_links(runs: &[Run], pieces: &mut [UniformRun]) -> Vec<LogWarning> {
    let mut warnings = Vec::new();
    for (joint, channels) in runs[0].joints.iter().enumerate() {
        let has = |piece: &UniformRun| piece.joints[joint].link.is_some();
        let lacking = pieces.iter().find(|piece| !has(piece)).map(|piece| piece.name.clone());
        if let Some(run) = lacking.filter(|_| pieces.iter().any(has)) {
            pieces.iter_mut().for_each(|piece| piece.joints[joint].link = None);
            let joint = channels.name.clone();
            warnings.push(LogWarning::LinkPositionMissing { run, joint });
        }
    }
    warnings
}

/// What can be said of the runs before they are filtered.
fn about_runs(runs: &[Run], pieces: &[UniformRun], cutoff_hz: f64) -> Vec<LogWarning> {
    let mut warnings = Vec::new();
    for (index, run) in runs.iter().enumerate() {
        let name = || run.name.clone();
        warnings.extend(run.is_torn.then(|| LogWarning::TornLastRow { run: name() }));
        let unknown = unknown_joints(run).into_iter();
        warnings.extend(unknown.map(|joint| LogWarning::UnknownJoint { run: name(), joint }));
        if let Some(earlier) = duplicate_of(runs, index) {
            warnings.push(LogWarning::Duplicate { run: name(), of: runs[earlier].name.clone() });
        }
        let own: Vec<&UniformRun> = pieces.iter().filter(|p| p.run == index).collect();
        if let Some(deviation_s) = own.iter().filter_map(|p| p.deviation_s).reduce(f64::max) {
            let rate_hz = own[0].rate_hz;
            warnings.push(LogWarning::Resampled { run: name(), deviation_s, rate_hz });
        }
        if own.len() > 1 {
            let (gaps, shortest_s) = (own.len() - 1, shortest_s(cutoff_hz));
            let longest_filled = LONGEST_FILLED;
            warnings.push(LogWarning::Split { run: name(), gaps, longest_filled, shortest_s });
        }
        warnings.extend(saturated(run));
    }
    warnings
}

/// Joints whose effort sits at its extreme values for a hundredth of the run or more.
fn saturated(run: &Run) -> impl Iterator<Item = LogWarning> {
    const SHARE: f64 = 0.01;
    run.joints.iter().filter_map(|joint| {
        let share = saturation(&joint.effort);
        let (run, joint) = (run.name.clone(), joint.name.clone());
        (share >= SHARE).then_some(LogWarning::Saturated { run, joint, share })
    })
}
