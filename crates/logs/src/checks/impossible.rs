//! Impossible samples: positions out of reach from the row before, and signals of a size that no joint has.

use std::ops::Range;

use robot::Joint;

use crate::{
    checks::turns::unwrap_turns,
    runs::run::{Channel, Channels, median},
};

/// A step is out of reach above this many usual steps. The usual step is the largest of all but one in fifty.
const USUAL_STEPS: f64 = 20.0;
pub(crate) const USUAL_SHARE: f64 = 0.98;

/// Least step that is out of reach (rad, and m at a sliding joint): coarse encoders and short motions stay below it.
const LEAST: [f64; 2] = [0.5, 0.1];

/// Speeds that no joint has (per s): 30 rad/s and 10 m/s, each in the smallest unit found in logs, degrees and mm.
const FASTEST: [f64; 2] = [30.0 * 180.0 / std::f64::consts::PI, 10.0 * 1e3];

/// A joint without limits is not at a position beyond this (rad or m) after a step out of reach.
const FARTHEST: f64 = 1e4;

/// Position that no joint has (rad or m). Beyond it the digits of a file resolve little of a motion.
const NOWHERE: f64 = 1e6;

/// Fewest rows from which the usual step is known.
pub(crate) const FEWEST: usize = 20;

/// How many rows may be left out: one in a hundred, and three of a short log.
pub(crate) fn most_left_out(rows: usize) -> usize {
    (rows / 100).max(3)
}

/// A sample that the joint cannot have.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Impossible {
    /// Index of the sample.
    pub sample: usize,
    /// Why it is impossible, as the end of `but ...`.
    pub expectation: String,
}

/// Finds impossible samples of a joint, by channel.
pub(crate) fn find_impossible(
    joint: &Joint,
    time: &[f64],
    c: &Channels,
) -> Vec<(Channel, Vec<Impossible>)> {
    let all = Channel::ALL.into_iter().filter_map(|channel| {
        let x = c.get(channel)?;
        let found = match channel {
            Channel::Position | Channel::LinkPosition => of_position(joint, time, x),
            // What was asked for is no measurement.
            Channel::DesiredPosition | Channel::DesiredVelocity | Channel::DesiredAcceleration => {
                return None;
            }
            _ => of_size(joint, channel, x),
        };
        (!found.is_empty()).then_some((channel, found))
    });
    all.collect()
}

/// Positions out of reach.
///
/// ```text
/// step     |q[k] - q[k-1]| > reach * rows between them
/// reach  = max(1/2 rad, min(20 usual steps, what no joint does in a row))
/// ```
///
/// Steps out of reach cut a run into stretches. The longest one belongs to the motion. From it on, in both directions,
/// a stretch belongs to the motion where it is within reach of the motion so far. A stretch out of reach is impossible
/// when it is short, or when it lies outside the limits by more than their span.
fn of_position(joint: &Joint, time: &[f64], q: &[f64]) -> Vec<Impossible> {
    let turns = joint.kind.is_rotation().then(|| unwrap_turns(time, q)).flatten();
    let q = turns.as_ref().map_or(q, |turns| &turns.position);
    let Some(reach) = Reach::of(joint, time, q) else { return nowhere(q) };
    let stretches = reach.stretches(time, q);
    let longest = (0..stretches.len()).max_by_key(|&s| {
        let own = &stretches[s];
        (!is_outside(joint, q[own.start]), own.len())
    });
    let Some(longest) = longest else { return Vec::new() };
    let short = most_left_out(q.len());
    let strange = |s: &Range<usize>| s.len() <= short || is_outside(joint, q[s.start]);
    let mut out = Vec::new();
    let mut last = stretches[longest].end - 1;
    for own in &stretches[longest + 1..] {
        if reach.holds(time, q, last, own.start) || !strange(own) {
            last = own.end - 1;
        } else {
            out.extend(own.clone().map(|k| (k, last)));
        }
    }
    let mut first = stretches[longest].start;
    for own in stretches[..longest].iter().rev() {
        if reach.holds(time, q, own.end - 1, first) || !strange(own) {
            first = own.start;
        } else {
            out.extend(own.clone().map(|k| (k, first)));
        }
    }
    if out.is_empty() {
        return nowhere(q);
    }
    out.sort_unstable();
    let why = |(sample, near): (usize, usize)| Impossible {
        sample,
        expectation: format!(
            "joint {} is at {:.3} beside it{}",
            joint.name,
            q[near],
            limits(joint)
        ),
    };
    out.into_iter().map(why).collect()
}

/// Positions that no joint has.
fn nowhere(q: &[f64]) -> Vec<Impossible> {
    let all = q.iter().enumerate().filter(|(_, q)| q.abs() > NOWHERE);
    let expectation = format!("up to {NOWHERE:e} was expected");
    all.map(|(sample, _)| Impossible { sample, expectation: expectation.clone() }).collect()
}

fn limits(joint: &Joint) -> String {
    let unit = if joint.kind.is_rotation() { "rad" } else { "m" };
    let of = |(lower, upper)| format!(" and limited to {lower} .. {upper} {unit}");
    joint.limits.position.map(of).unwrap_or_default()
}

/// Whether a position is outside the limits by more than their span, or without limits beyond `FARTHEST`.
fn is_outside(joint: &Joint, q: f64) -> bool {
    match joint.limits.position {
        Some((lower, upper)) => {
            let span = (upper - lower).max(LEAST[0]);
            q < lower - span || q > upper + span
        }
        None => q.abs() > FARTHEST,
    }
}

/// What a joint reaches from one row to the next.
struct Reach {
    /// Usual step of time (s).
    usual_s: f64,
    /// Largest step from one row to the next (rad or m).
    step: f64,
}

impl Reach {
    /// `None` for too few rows to know the usual step.
    fn of(joint: &Joint, time: &[f64], q: &[f64]) -> Option<Self> {
        if q.len() < FEWEST || time.len() != q.len() {
            return None;
        }
        let times: Vec<f64> = time.windows(2).map(|t| t[1] - t[0]).collect();
        let mut reach = Self { usual_s: median(&times), step: 0.0 };
        let step = |k: usize| (q[k] - q[k - 1]).abs() / reach.rows(time, k - 1, k);
        let steps: Vec<f64> = (1..q.len()).map(step).collect();
        let kind = usize::from(!joint.kind.is_rotation());
        let fastest = FASTEST[kind] * reach.usual_s;
        let usual = quantile(steps, USUAL_SHARE);
        reach.step = LEAST[kind].max((USUAL_STEPS * usual).min(fastest));
        Some(reach)
    }

    /// Number of rows of the usual clock between two rows, at least one.
    fn rows(&self, time: &[f64], from: usize, to: usize) -> f64 {
        let rows = (time[to] - time[from]) / self.usual_s;
        if rows.is_finite() { rows.round().max(1.0) } else { 1.0 }
    }

    /// Whether the joint can move from one row to a later one.
    fn holds(&self, time: &[f64], q: &[f64], from: usize, to: usize) -> bool {
        (q[to] - q[from]).abs() <= self.step * self.rows(time, from, to)
    }

    fn stretches(&self, time: &[f64], q: &[f64]) -> Vec<Range<usize>> {
        let mut all = Vec::new();
        let mut start = 0;
        for k in 1..=q.len() {
            if k == q.len() || !self.holds(time, q, k - 1, k) {
                all.push(start..k);
                start = k;
            }
        }
        all
    }
}

/// Velocities, accelerations and efforts that are more than a hundred times the usual size, and larger than any joint
/// has. The usual size is the largest of all but one in fifty.
fn of_size(joint: &Joint, channel: Channel, x: &[f64]) -> Vec<Impossible> {
    const USUAL: f64 = 100.0;
    if x.len() < FEWEST {
        return Vec::new();
    }
    let least = match channel {
        Channel::Effort | Channel::CommandedEffort => {
            joint.limits.effort.map_or(1e4, |limit| 10.0 * limit)
        }
        Channel::Acceleration => 1e6,
        _ => 1e3,
    };
    let usual = quantile(x.iter().map(|x| x.abs()).collect(), USUAL_SHARE);
    let most = (USUAL * usual).max(least);
    let all = x.iter().enumerate().filter(|(_, x)| x.abs() > most);
    let expectation = format!("its size is up to {usual:.3} in most rows of joint {}", joint.name);
    all.map(|(sample, _)| Impossible { sample, expectation: expectation.clone() }).collect()
}

/// The value that a share of all values does not exceed; 0 without values.
pub(crate) fn quantile(mut values: Vec<f64>, share: f64) -> f64 {
    let at = (share * values.len().saturating_sub(1) as f64) as usize;
    if values.is_empty() { 0.0 } else { *values.select_nth_unstable_by(at, f64::total_cmp).1 }
}

#[cfg(test)]
mod tests {
    use robot::Robot;

    use super::*;

    fn joint() -> Joint {
        let text = r#"<robot name="r"><link name="a"/><link name="b"><inertial><mass value="1"/>
            <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
            <joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
            <limit lower="-2.5" upper="2.5" effort="0" velocity="0"/></joint></robot>"#;
        Robot::from_urdf(text).unwrap().links()[0].joint.clone()
    }

    fn swing() -> (Vec<f64>, Vec<f64>) {
        (0..1000).map(|k| (0.01 * f64::from(k), (0.02 * f64::from(k)).sin())).unzip()
    }

    fn impossible_samples(q: &[f64]) -> Vec<usize> {
        let (time, _) = swing();
        of_position(&joint(), &time[..q.len()], q).iter().map(|i| i.sample).collect()
    }

    #[test]
    fn samples_out_of_reach_are_found_whatever_their_size_and_place() {
        let (_, clean) = swing();
        assert_eq!(impossible_samples(&clean), [0_usize; 0]);
        // None of them a number of full turns from its neighbours.
        for size in [3.0, 103.0, 1002.0, 1e6, 4_294_967_296.0, 1e300] {
            for rows in [vec![500], vec![0], vec![999], vec![300, 301, 302], vec![20, 22]] {
                let mut q = clean.clone();
                rows.iter().for_each(|&k| q[k] = size);
                assert_eq!(impossible_samples(&q), rows, "{size}");
            }
        }
    }

    /// What lasts within the limits is another zero of the encoder, which inspection tells.
    #[test]
    fn a_step_that_lasts_is_none() {
        let (_, mut q) = swing();
        q[500..].iter_mut().for_each(|q| *q += 1.5);
        assert_eq!(impossible_samples(&q), [0_usize; 0]);
        q[500..].iter_mut().for_each(|q| *q += 1e4);
        assert_eq!(impossible_samples(&q).len(), 500);
    }

    #[test]
    fn degrees_and_full_turns_are_none() {
        let (_, clean) = swing();
        let degrees: Vec<f64> = clean.iter().map(|q| q.to_degrees()).collect();
        assert_eq!(impossible_samples(&degrees), [0_usize; 0]);
        let mut wrapped = clean;
        wrapped[300..303].iter_mut().for_each(|q| *q -= std::f64::consts::TAU);
        assert_eq!(impossible_samples(&wrapped), [0_usize; 0]);
    }

    #[test]
    fn an_effort_of_no_drive_is_found() {
        let (_, mut effort) = swing();
        effort[7] = 1e300;
        let all = of_size(&joint(), Channel::Effort, &effort);
        assert_eq!(all.iter().map(|i| i.sample).collect::<Vec<_>>(), [7]);
    }
}
