use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Vector3;

use crate::effort_unit::{effort_unit, joint_units};
use crate::fit::Drive;
use crate::goal_velocity::goal_velocity;
use crate::judge::{Judge, ReadingFit};
use crate::locked::{locked_elsewhere, other_locks};
use crate::log_reading::LogReading;
use crate::observation::{CountedTogether, Observation, ReadingEvidence, Rival, Spoils};
use crate::payload::shares_with_a_tool;

/// Errors that the nominal torque shows: readings that improve its fit, the best first.
pub(crate) fn readings(judge: &mut Judge, runs: usize) -> Vec<Observation> {
    let mut observations: Vec<Observation> = goal_velocity(judge, runs).into_iter().collect();
    while observations.len() < judge.thresholds.most_readings {
        let as_is = judge.as_is();
        let Some((best, rivals)) = best(judge, &as_is) else { break };
        let Some(found) = observation(judge, &best, &rivals, runs) else { break };
        observations.push(found);
        judge.adopt(&best.reading);
    }
    observations
}

/// The reading that improves the fit most, and those that improve it as much; `None` where none does, or a tool does so too.
fn best(judge: &mut Judge, as_is: &ReadingFit) -> Option<(ReadingFit, Vec<ReadingFit>)> {
    let t = judge.thresholds;
    let candidates = candidates(judge, as_is);
    let locks = locked_elsewhere(judge, as_is);
    let mut judged: Vec<ReadingFit> = candidates
        .into_iter()
        .chain(locks)
        .map(|reading| judge.judge_reading(reading, as_is))
        .collect();
    let without = judge.without_gravity();
    if let Some(without) = without {
        if judge.lacks_gravity_at_joints() {
            judged.retain(|j| j.gain > without.gain && improves(judge, j));
            if judged.is_empty() {
                return Some((without, judged));
            }
        }
        judged.extend(Some(without).filter(|without| improves(judge, without)));
    }
    judged.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    let best = judged.first()?.clone();
    if !improves(judge, &best) {
        return None;
    }
    if let Some(tool) = shares_with_a_tool(judge, Drive { gain: t.drive_gain })
        && judge.gain(&as_is.shares, &tool) > best.gain - t.margin
    {
        return None;
    }
    let near = |j: &&ReadingFit| j.gain > best.gain - t.margin;
    let rivals: Vec<ReadingFit> = judged.iter().skip(1).filter(near).cloned().collect();
    (rivals.len() < t.most_rivals).then_some((best, rivals))
}

/// Whether a reading improves the fit of a joint that the log as it stands contradicts.
fn improves(judge: &Judge, read: &ReadingFit) -> bool {
    let joint = most_improved_joint(judge, read);
    let at = |x: &[f64]| x.get(joint).copied().unwrap_or(0.0);
    let t = judge.thresholds;
    let ratio = |j: usize| {
        let [before, after, floor] = [read.before[j], read.shares[j], judge.floors[j]];
        (before + floor) / (after + floor)
    };
    let n = read.shares.len();
    let confirming = (0..n).filter(|j| ratio(*j) > t.confirms).count();
    let wanted = match read.reading {
        LogReading::WithoutGravity => t.joints_without_gravity.min(n),
        _ => n.div_ceil(t.joints_of_confirming).min(t.most_confirming),
    };
    if read.reading.is_of_whole_arm() && confirming < wanted {
        return false;
    }
    // Each of two exchanged columns must fit at its new joint.
    let not_worse = |j: &usize| ratio(*j) > 1.0 - t.alike || read.shares[*j] < judge.floors[*j];
    if !read.reading.exchanged_joints().iter().all(not_worse) {
        return false;
    }
    let least = match read.gain {
        gain if gain >= t.gain[1] => t.misfit[1],
        gain if gain >= t.gain[0] => t.misfit[0],
        gain if gain >= t.contradicted_gain && read.reading.is_sign() => 1.0,
        _ => return false,
    };
    at(&read.before) >= least.max(t.above_floor * at(&judge.floors)) && at(&read.shares) <= t.mended
}

fn most_improved_joint(judge: &Judge, read: &ReadingFit) -> usize {
    let of = |j: usize| {
        let [before, after, floor] = [read.before[j], read.shares[j], judge.floors[j]];
        (before + floor) / (after + floor)
    };
    (0..read.shares.len()).max_by(|&a, &b| of(a).total_cmp(&of(b))).unwrap_or(0)
}

fn observation(
    judge: &Judge,
    best: &ReadingFit,
    rivals: &[ReadingFit],
    runs: usize,
) -> Option<Observation> {
    let nominal = judge.robot.gravity_in_base();
    let (joints, aligned) = (judge.samples.joints, judge.thresholds.aligned_gravity);
    let rival = |judged: &ReadingFit| judged.reading.rival(joints, nominal, aligned);
    let Rival { kind, joints } = rival(best)?;
    let joint = most_improved_joint(judge, best);
    let at = |x: &[f64]| x.get(joint).copied().unwrap_or(0.0);
    let evidence = ReadingEvidence {
        joint,
        before: at(&best.before),
        after: at(&best.shares),
        gain: best.gain,
    };
    let whole = joints.len() == judge.samples.joints && joints.len() > 1;
    let or: Vec<Rival> = rivals.iter().filter_map(rival).collect();
    let of_efforts =
        best.reading.is_of_efforts() && rivals.iter().all(|r| r.reading.is_of_efforts());
    let spoils = if of_efforts && !whole { Spoils::Joints } else { Spoils::Everything };
    Some(Observation {
        or,
        units: joint_units(judge, &best.reading),
        locks: other_locks(&judge.robot, &best.reading),
        evidence: Some(evidence),
        ..Observation::of_runs(kind, joints, (0..runs).collect(), spoils)
    })
}

/// Readings that may be true of these logs.
fn candidates(judge: &Judge, as_is: &ReadingFit) -> Vec<LogReading> {
    let t = judge.thresholds;
    if as_is.shares.iter().all(|share| *share < t.misfit[1]) {
        return Vec::new();
    }
    let links = judge.robot.links();
    let n = links.len();
    let mut all = Vec::new();
    if n > 1 {
        all.extend([LogReading::EffortSign(None), LogReading::PositionSign(None)]);
    }
    for (j, link) in links.iter().enumerate() {
        all.extend([LogReading::EffortSign(Some(j)), LogReading::PositionSign(Some(j))]);
        all.push(LogReading::AxisSign(j));
        if link.joint.kind.is_rotation() {
            all.extend([FRAC_PI_2, -FRAC_PI_2, PI].map(|offset| LogReading::Offset(j, offset)));
            if span(judge, j) > t.degrees_range {
                all.push(LogReading::Degrees(Some(j)));
            }
        }
        for (k, other) in links.iter().enumerate().skip(j + 1) {
            all.push(LogReading::EffortsExchanged(j, k));
            if link.joint.kind.is_rotation() == other.joint.kind.is_rotation() {
                all.push(LogReading::Exchanged(j, k));
            }
        }
    }
    all.extend((1..n).flat_map(|j| counted_together(judge, j)));
    let turn = links.iter().all(|link| link.joint.kind.is_rotation());
    if n > 1 && turn && (0..n).any(|j| span(judge, j) > t.degrees_range) {
        all.push(LogReading::Degrees(None));
    }
    all.extend(gravity(judge));
    all.extend(time(judge));
    all.extend(effort_unit(judge));
    all
}

/// The ways to count a joint together with the one before it, where both turn about parallel axes.
fn counted_together(judge: &Judge, joint: usize) -> Vec<LogReading> {
    let links = judge.robot.links();
    let Some(with) = links[joint].parent else { return Vec::new() };
    let (own, before) = (&links[joint].joint, &links[with].joint);
    let axis = own.parent_from_joint.rotation * own.axis_in_joint.into_inner();
    let is_parallel = axis.dot(&before.axis_in_joint).abs() > judge.thresholds.parallel;
    if !(is_parallel && own.kind.is_rotation() && before.kind.is_rotation()) {
        return Vec::new();
    }
    let signs = [1.0, -1.0].into_iter();
    let ways = signs.flat_map(|sign| [false, true].map(|is_driven| (sign, is_driven)));
    let reading = |(sign, is_driven)| CountedTogether { joint, with, sign, is_driven };
    ways.map(reading).map(LogReading::CountedTogether).collect()
}

fn span(judge: &Judge, j: usize) -> f64 {
    let q = judge.samples.column(&judge.samples.motion[0], j);
    let low = q.iter().copied().fold(f64::INFINITY, f64::min);
    q.iter().copied().fold(f64::NEG_INFINITY, f64::max) - low
}

/// The gravity that fits the efforts, where it differs from that of the description.
fn gravity(judge: &Judge) -> Option<LogReading> {
    let t = judge.thresholds;
    let columns = judge.gravity.each_ref().map(Vec::as_slice);
    let found = judge.fit_pooled(&judge.inertial, &columns)?;
    let found = Vector3::new(*found.first()?, *found.get(1)?, *found.get(2)?);
    let nominal = judge.robot.gravity_in_base();
    let factor = found.norm() / nominal.norm().max(f64::MIN_POSITIVE);
    let is_somewhere = found.norm() > t.gravity_sizes[0] && found.norm() < t.gravity_sizes[1];
    let other_size = factor > t.gravity_factor || factor < 1.0 / t.gravity_factor;
    // Of a direction, the size says whether the efforts are torques at all.
    let turned = found.angle(&nominal) > t.gravity_angle && !other_size;
    let aligned = found.angle(&nominal) < t.gravity_angle && other_size;
    (is_somewhere && (turned || aligned)).then_some(LogReading::Gravity(found))
}

/// The unit of time that fits the efforts.
///
/// ```text
/// effort = g(q) + factor² (M qdd + C qd)_logged
/// ```
fn time(judge: &Judge) -> Option<LogReading> {
    let granted: Vec<f64> =
        judge.whole.iter().zip(&judge.inertial).map(|(w, inertial)| w - inertial).collect();
    let squared = *judge.fit_pooled(&granted, &[&judge.inertial])?.first()?;
    let least = judge.thresholds.time_factor;
    let factor = squared.max(0.0).sqrt();
    (factor > least || (factor > 0.0 && factor < 1.0 / least)).then_some(LogReading::Time(factor))
}
