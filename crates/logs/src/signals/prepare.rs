use std::ops::Range;

#[cfg(doc)]
use crate::signals::{
    agreement::Agreement, differentiate::differentiate, filter::LowPass, noise::JointNoise,
};
use crate::{
    checks::{clocks::compare_clocks, saturation::saturation},
    error::LogError,
    runs::{
        duplicate::duplicate_of,
        repair::Repair,
        run::{GoalEffort, Run},
        session::session_starts,
    },
    signals::{
        choice::choose,
        clock::Fill,
        filtered::{FilteredRun, SETTLING_PERIODS},
        link_lag,
        prepared::{Prepared, PreparedJoint, PreparedLink, PreparedRun, Wide},
        uniform::{UniformRun, check_runs, uniform_pieces},
        warning::LogWarning,
    },
};

/// How a log is prepared.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PrepareSettings {
    /// Cut-off of the low-pass (Hz); `None` to choose it from the data.
    pub cutoff_hz: Option<f64>,
}

/// Resamples runs to a uniform clock and low-passes them.
///
/// 1. Clock: a run whose rows lie on a uniform clock is kept as it is. Any other run is
///    interpolated (cubic) at its usual rate, rounded. It is split at gaps of more than
///    five samples and more than a quarter period of the cut-off.
/// 2. Low-pass: zero-phase Butterworth of order 4 ([`LowPass`]), with one cut-off for all runs
///    and joints. The default cut-off is five times the bandwidth of the motion, or the lower
///    frequency at which the noise of a joint's acceleration reaches 3 % of the acceleration of its motion
///    ([`JointNoise`]). The same signals low-passed at four times the cut-off are kept too ([`Wide`]).
/// 3. Derivatives ([`differentiate`], of low-passed signals):
///
/// ```text
/// q   = L position
/// qd  = L velocity        where it agrees with d/dt q, else d/dt q
/// qdd = L acceleration    where it agrees with d/dt qd, else d/dt qd
/// ```
///
///    All three have thus passed the same filter `L`. A column agrees when
///    [`Agreement::holds`] in every run in which the joint moves. The motion of a link with a
///    second encoder is derived from the position of that encoder alone. Its clock is first shifted to
///    that of the first encoder where it is late or early.
/// 4. `1.5 / cutoff` seconds are cut from both ends, where this filter and the filters of the
///    robot's own software have not settled.
///
/// # Errors
///
/// [`LogError::NoRuns`], [`LogError::JointsDiffer`], [`LogError::WrongLength`], [`LogError::OtherClock`],
/// [`LogError::CutoffOutOfRange`] and [`LogError::RunTooShort`].
pub fn prepare(runs: &[Run], settings: &PrepareSettings) -> Result<Prepared, LogError> {
    check_runs(runs)?;
    compare_clocks(runs)?;
    let split = |fill: Fill| -> Vec<UniformRun> {
        runs.iter().enumerate().flat_map(|(index, run)| uniform_pieces(run, index, fill)).collect()
    };
    let choice = choose(runs, &split(Fill::SAMPLES), settings.cutoff_hz)?;
    let cutoff_hz = choice.cutoff.cutoff_hz;
    let fill = Fill::below(cutoff_hz);
    let all = split(fill);
    let mut warnings = run_warnings(runs, &all, fill, cutoff_hz);
    let mut pieces = keep_long_pieces(runs, all, cutoff_hz)?;
    warnings.extend(drop_partial_links(runs, &mut pieces));
    warnings.extend(link_lag::remove_lags(&mut pieces, &runs[0], cutoff_hz)?);
    warnings.extend(choice.warnings);

    let filtered = pieces.iter().map(|p| FilteredRun::of(p, cutoff_hz, &choice.sources));
    let filtered: Vec<FilteredRun> = filtered.collect::<Result<_, _>>()?;
    let starts = session_starts(runs);
    let ends = pieces.into_iter().zip(filtered);
    let ends = ends.map(|(piece, f)| (starts[piece.run], piece, f)).map(cut_ends);
    let prepared = Prepared {
        runs: ends.collect(),
        cutoff_hz,
        cutoff_reason: choice.cutoff.reason,
        motion_hz: choice.cutoff.motion_hz,
        noise: choice.noise,
        warnings,
    };
    Ok(prepared.with_noise_warnings(&runs[0]))
}

/// The shortest piece that is used (s). A third of it is left after its ends are cut.
fn shortest_s(cutoff_hz: f64) -> f64 {
    3.0 * SETTLING_PERIODS / cutoff_hz
}

/// The pieces that are long enough. Every run must have at least one.
fn keep_long_pieces(
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

fn cut_ends((session_start_s, piece, filtered): (f64, UniformRun, FilteredRun)) -> PreparedRun {
    let (kept, rate_hz) = (filtered.settled_range(), piece.rate_hz);
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
            goal_effort: raw.goal_effort.map(|goal| with_lead(goal, &kept, rate_hz)),
        })
        .collect();
    let time = cut(piece.time);
    PreparedRun { name: piece.name, rate_hz: piece.rate_hz, time, session_start_s, joints }
}

/// Longest time by which goals may be late (s), for which samples before the first one are kept.
const LONGEST_LATENESS_S: f64 = 0.3;

/// The kept samples, and those before them.
fn with_lead(goal: GoalEffort, kept: &Range<usize>, rate_hz: f64) -> GoalEffort {
    let lead = kept.start.min((LONGEST_LATENESS_S * rate_hz).ceil() as usize);
    let values = goal.values[kept.start - lead..kept.end].to_vec();
    GoalEffort { values, lead, ..goal }
}

/// Leaves out the second encoder of a joint where some runs lack it.
fn drop_partial_links(runs: &[Run], pieces: &mut [UniformRun]) -> Vec<LogWarning> {
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

/// Warnings of the runs before they are filtered.
fn run_warnings(
    runs: &[Run],
    pieces: &[UniformRun],
    fill: Fill,
    cutoff_hz: f64,
) -> Vec<LogWarning> {
    let mut warnings = Vec::new();
    for (index, run) in runs.iter().enumerate() {
        let name = || run.name.clone();
        warnings.extend(run.is_torn.then(|| LogWarning::TornLastRow { run: name() }));
        // Of all logs alike: once is enough.
        let is_said = |mend: &&Repair| {
            runs[..index].iter().flat_map(|r| &r.mended).any(|m| m.says_of_all(mend))
        };
        for mend in run.mended.iter().filter(|mend| !is_said(mend)).cloned() {
            let alike = |other: &&mut LogWarning| matches!(other, LogWarning::OtherRate { mend: of, .. } if of.to_string() == mend.to_string());
            match warnings.iter_mut().find(alike) {
                Some(LogWarning::OtherRate { runs, .. }) => runs.push(name()),
                _ if mend.is_of_rate() => {
                    warnings.push(LogWarning::OtherRate { runs: vec![name()], mend });
                }
                _ if matches!(mend, Repair::Stretches { .. }) => {
                    warnings.push(LogWarning::Thinned { mend });
                }
                _ => warnings.push(LogWarning::Mended { run: name(), mend }),
            }
        }
        let unknown = run.unknown_joints().into_iter();
        warnings.extend(unknown.map(|joint| LogWarning::UnknownJoint { run: name(), joint }));
        if let Some(earlier) = duplicate_of(runs, index) {
            warnings.push(LogWarning::Duplicate { run: name(), of: runs[earlier].name.clone() });
        }
        let own: Vec<&UniformRun> = pieces.iter().filter(|p| p.run == index).collect();
        if let Some(deviation_s) = own.iter().filter_map(|p| p.deviation_s).reduce(f64::max) {
            let rate_hz = own[0].rate_hz;
            warnings.push(LogWarning::Resampled { run: name(), deviation_s, rate_hz });
        }
        let between = run.mended.iter().map(Repair::gaps).sum::<usize>();
        if own.len() > between + 1 {
            let (gaps, shortest_s) = (own.len() - 1 - between, shortest_s(cutoff_hz));
            let longest_s = fill.longest_s(&run.time);
            warnings.push(LogWarning::Split { run: name(), gaps, longest_s, shortest_s });
        }
        warnings.extend(saturation_warnings(run));
    }
    warnings
}

/// Joints with a hundredth or more of the run's samples at the extreme values of the effort.
fn saturation_warnings(run: &Run) -> impl Iterator<Item = LogWarning> {
    const SHARE: f64 = 0.01;
    run.joints.iter().filter_map(|joint| {
        let share = saturation(&joint.effort);
        let (run, joint) = (run.name.clone(), joint.name.clone());
        (share >= SHARE).then_some(LogWarning::Saturated { run, joint, share })
    })
}
