use std::borrow::Cow;

use catalogue::EffectKind;
use effects::{Hypothesis, hypotheses};
use logs::{Run, is_repeat};
use robot::Robot;

use crate::columns::design::Design;
use crate::diagnose::{DiagnosisRun, diagnose, diagnose_since};
use crate::error::DiagnosisError;
use crate::find_tones::in_wide_band;
use crate::oscillations::tones::tones_at;
use crate::outcome::effect_at::effect_at;
use crate::outcome::tone_finding::tone_finding;
use crate::progress::DiagnosisProgress;
use crate::readiness::extent::inadequate;
use crate::readiness::inspected_logs::inspect_logs;
use crate::regression::linear_fit::LinearFit;
use crate::regression::problem::HypothesisSet;
use crate::regression::uncertainty::Uncertainty;
use crate::result::{EffectAt, Estimate, Finding};
use crate::search::inputs::Inputs;
use crate::settings::Settings;
use crate::signals::log::Log;
use crate::signals::tone::{Beat, Tone};

/// Changes from one set of logs to another: of one arm before and after an event, early and late in a session, or of
/// two arms that should be equal.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// The diagnosis of the first logs.
    pub before: DiagnosisRun,
    /// The diagnosis of the other logs, about the robot with the findings of the first logs. Its findings are the
    /// changes.
    pub after: DiagnosisRun,
    /// Sizes of these findings in the first logs, about the same robot, for effects whose columns are linear.
    pub first: Vec<FirstSize>,
    /// Oscillations that the first logs show with the same amplitude, which are no changes.
    pub alike: Vec<Finding>,
}

/// The parameters of an effect in the first logs.
#[derive(Debug, Clone, PartialEq)]
pub struct FirstSize {
    /// The effect and its place.
    pub at: EffectAt,
    /// Its parameters.
    pub parameters: Vec<Estimate>,
}

/// Finds what changed from the runs `before` to the runs `after`.
///
/// ```text
/// effort before - extended nominal effort = X v + noise
/// effort after  - extended nominal effort = X v + X w + noise
/// ```
///
/// with the robot that the first runs extend, and the columns `X` of every effect. The weights `v` of all of them are in
/// every model: they take what both logs have in common, named or not, as far as any effect can imitate it. Changes are the
/// weights `w` that the second logs show beyond these; they are found as causes are. An oscillation is a change where its
/// amplitude differs from that in the first logs by more than their 95 per cent intervals, added as squares.
///
/// # Errors
///
/// The errors of [`diagnose`] for either set, and [`DiagnosisError::InBoth`] for a run that is in both.
pub fn compare(
    robot: &Robot,
    [before, after]: [&[Run]; 2],
    settings: &Settings,
    progress: &dyn DiagnosisProgress,
) -> Result<Comparison, DiagnosisError> {
    if let Some(run) = after.iter().find(|a| before.iter().any(|b| is_repeat(a, b))) {
        return Err(DiagnosisError::InBoth { run: run.name.clone() });
    }
    let first_runs = before;
    let before = diagnose(robot, first_runs, settings, progress)?;
    let settings = of_changes(settings, &before);
    let first = Some(&before.prepared);
    let mut after = diagnose_since(first, &before.extended, after, &settings, progress)?;
    let about = &before.extended;
    let named: Vec<&EffectAt> = after.diagnosis.findings.iter().map(|f| &f.at).collect();
    let is_named = |h: &Hypothesis| named.contains(&&effect_at(about, *h));
    let asked: Vec<Hypothesis> = hypotheses(about).into_iter().filter(is_named).collect();
    let mut first = sizes(&before, &asked, &settings)?;
    let tones = tone_sizes(&before, (robot, first_runs), &after.diagnosis.findings, &settings)?;
    let is_common = |finding: &Finding| {
        let mut same = tones.iter().filter(|size| size.at == finding.at);
        // The amplitude comes first; the phase of a disturbance differs from run to run.
        let amplitude = finding.parameters.get(..1).unwrap_or_default();
        same.any(|size| !differ(amplitude, &size.parameters))
    };
    let (alike, changes) = after.diagnosis.findings.into_iter().partition(is_common);
    first.extend(tones);
    after.diagnosis.findings = changes;
    Ok(Comparison { before, after, first, alike })
}

/// The settings of a search for changes since the logs of a diagnosis.
fn of_changes(settings: &Settings, before: &DiagnosisRun) -> Settings {
    let mut of_changes = settings.clone();
    of_changes.cutoff_hz = Some(before.prepared.cutoff_hz);
    let search = &mut of_changes.thresholds.search;
    search.evidence += search.evidence_of_change;
    search.evidence_of_imitable += search.evidence_of_change;
    of_changes
}

/// Sizes of some hypotheses in the logs of a diagnosis, about the robot with its findings.
fn sizes(
    outcome: &DiagnosisRun,
    hypotheses: &[Hypothesis],
    settings: &Settings,
) -> Result<Vec<FirstSize>, DiagnosisError> {
    if hypotheses.is_empty() {
        return Ok(Vec::new());
    }
    let (robot, prepared) = (&outcome.extended, &outcome.prepared);
    let t = &settings.thresholds;
    let inadequate = inadequate(robot, prepared, &t.readiness);
    let moved: Vec<bool> = inadequate.iter().map(Option::is_none).collect();
    let log = Log::new(prepared, &moved, t);
    let asked: Vec<Hypothesis> = hypotheses.iter().copied().filter(|h| log.includes(*h)).collect();
    let hypotheses = asked.as_slice();
    let design = Design::of(robot, &log, hypotheses)?;
    let inadequate = &inadequate;
    let inputs = Inputs { nominal: robot, robot, settings, log, design: &design, inadequate };
    inputs.with_dataset(|dataset| {
        let all: Vec<usize> = (0..dataset.blocks.len()).collect();
        let problem = dataset.problem(&all);
        let model: HypothesisSet = (0..design.groups.len()).collect();
        let Some(fit) = problem.fit(&model) else { return Vec::new() };
        let weights = fit.expand(design.width);
        let fitted = LinearFit {
            problem: Cow::Borrowed(&problem),
            model: &model,
            weights: &weights,
            about: robot,
            nominal: robot,
        };
        let Some(uncertainty) = Uncertainty::of(&fitted) else { return Vec::new() };
        let size = |h: &Hypothesis| FirstSize {
            at: effect_at(robot, *h),
            parameters: uncertainty.estimates(&fitted, *h, &[]),
        };
        hypotheses.iter().map(size).collect()
    })
}

/// What the logs of a diagnosis of `runs` of the robot `nominal` have of the oscillations among some findings.
fn tone_sizes(
    outcome: &DiagnosisRun,
    (nominal, runs): (&Robot, &[Run]),
    findings: &[Finding],
    settings: &Settings,
) -> Result<Vec<FirstSize>, DiagnosisError> {
    let (robot, prepared, t) = (&outcome.extended, &outcome.prepared, &settings.thresholds);
    let beat = |finding: &Finding| -> Option<(usize, Beat)> {
        let beat = finding.parameters.get(1)?.value;
        let beat = match finding.at.effect {
            EffectKind::TorqueRipple => Beat::Position(beat),
            EffectKind::ExternalDisturbance => Beat::Clock(beat),
            _ => return None,
        };
        let joint = finding.at.joint.as_deref()?;
        Some((robot.joint_names().position(|name| name == joint)?, beat))
    };
    let beats: Vec<(usize, Beat)> = findings.iter().filter_map(beat).collect();
    if beats.is_empty() {
        return Ok(Vec::new());
    }
    let inspected = outcome.read.as_ref().map(|_| inspect_logs(nominal, runs, t));
    let runs = inspected.as_ref().map_or(runs, |inspected| inspected.runs(runs));
    let Some(wide) = in_wide_band(prepared, robot, runs, settings)? else { return Ok(Vec::new()) };
    let moved = vec![true; robot.joint_count()];
    let tones = tones_at(&beats, robot, &wide, &Log::new(prepared, &moved, t))?;
    let size = |tone: Tone| {
        let finding = tone_finding(robot, &tone, t.tones.common_phase);
        FirstSize { at: finding.at, parameters: finding.parameters }
    };
    Ok(tones.into_iter().flatten().map(size).collect())
}

/// Whether a parameter differs by more than the two 95 per cent intervals of the noise.
fn differ(after: &[Estimate], before: &[Estimate]) -> bool {
    let half = |e: &Estimate| 0.5 * (e.noise95[1] - e.noise95[0]);
    after.iter().any(|a| {
        let before = before.iter().find(|b| b.name == a.name);
        before.is_none_or(|b| (a.value - b.value).abs() > half(a).hypot(half(b)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn estimate(value: f64, half: f64) -> Estimate {
        let noise95 = [value - half, value + half];
        // The part of effects without a name is in both logs.
        let ci95 = [value - 9.0, value + 9.0];
        Estimate {
            name: "level",
            value,
            ci95,
            noise95,
            nominal: 0.0,
            unit: "N m",
            determined: true,
        }
    }

    #[test]
    fn sizes_differ_by_more_than_both_intervals() {
        let after = [estimate(1.0, 0.3)];
        assert!(!differ(&after, &[estimate(1.49, 0.4)]));
        assert!(differ(&after, &[estimate(1.51, 0.4)]));
        assert!(!differ(&after, &[estimate(3.0, f64::INFINITY)]));
        assert!(differ(&after, &[]));
    }
}
