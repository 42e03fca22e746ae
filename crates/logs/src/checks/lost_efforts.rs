//! Efforts that another writer left between those of a joint: zeros of lost messages, and single spikes.

use robot::Joint;

use crate::checks::impossible::{FEWEST, Impossible, USUAL_SHARE, quantile};

/// A zero is lost where the efforts before and after it have one sign and are larger than so many usual steps.
const LOST_STEPS: f64 = 4.0;

/// Fewest different values of an effort that is measured: a drive that is switched on and off has two or three.
const FEWEST_VALUES: usize = 10;

/// Longest row of zeros that is lost: after a longer one the drive may have been off.
const LONGEST: usize = 50;

/// A spike differs from both of its neighbours by so many usual steps, and is so many times as large as usual values.
const SPIKE_STEPS: f64 = 50.0;
const SPIKE_SIZE: f64 = 3.0;

/// Of efforts with spikes in up to half of the samples, so many steps are between two that are none.
const CLEAN_STEPS: f64 = 0.2;

/// Two spikes in a row are less than the rest of the samples, up to a spike in ten samples.
const CLEAN_SIZES: f64 = 0.95;

/// Samples of an effort that are no efforts of the joint. The usual step is the largest of all but one in fifty.
///
/// ```text
/// zero    x[k] = 0,  x[a] x[b] > 0,  min(|x[a]|, |x[b]|) > 4 usual steps between values other than zero
/// spike   min(|x[k] - x[k-1]|, |x[k] - x[k+1]|) > 50 usual steps, both of one sign,  |x[k]| > 3 usual sizes
/// ```
///
/// with the last value other than zero before and the first after it, at `a` and `b`.
pub(crate) fn lost_efforts(joint: &Joint, x: &[f64]) -> Vec<Impossible> {
    if x.len() < FEWEST {
        return Vec::new();
    }
    let mut found = zeros(joint, x);
    found.extend(spikes(joint, x));
    found.sort_by_key(|impossible| impossible.sample);
    found.dedup_by_key(|impossible| impossible.sample);
    found
}

fn zeros(joint: &Joint, x: &[f64]) -> Vec<Impossible> {
    let is_zero = |x: &f64| x.abs() <= 0.0;
    let kept: Vec<usize> = (0..x.len()).filter(|&k| !is_zero(&x[k])).collect();
    if kept.len() < FEWEST || kept.len() == x.len() || !has_many_values(&kept, x) {
        return Vec::new();
    }
    let steps = kept.windows(2).map(|k| (x[k[1]] - x[k[0]]).abs()).collect();
    let least = LOST_STEPS * quantile(steps, USUAL_SHARE);
    let mut lost = Vec::new();
    for pair in kept.windows(2) {
        let (before, after) = (x[pair[0]], x[pair[1]]);
        let between = pair[0] + 1..pair[1];
        let is_lost = before * after > 0.0 && before.abs().min(after.abs()) > least;
        if is_lost && between.len() <= LONGEST {
            let expectation = format!(
                "joint {} has {before:.3} before and {after:.3} after it: a lost message or another publisher wrote it",
                joint.name
            );
            let one = |sample| Impossible { sample, expectation: expectation.clone() };
            lost.extend(between.map(one));
        }
    }
    lost
}

fn has_many_values(kept: &[usize], x: &[f64]) -> bool {
    let mut values: Vec<u64> = kept.iter().map(|&k| x[k].to_bits()).collect();
    values.sort_unstable();
    values.dedup();
    values.len() >= FEWEST_VALUES
}

fn spikes(joint: &Joint, x: &[f64]) -> Vec<Impossible> {
    let steps: Vec<f64> = x.windows(2).map(|x| (x[1] - x[0]).abs()).collect();
    let found = stand_out(x, quantile(steps.clone(), USUAL_SHARE), size(x.iter(), USUAL_SHARE));
    let found = if found.is_empty() { frequent_spikes(joint, x, steps) } else { found };
    let told = |k: usize| Impossible {
        sample: k,
        expectation: format!(
            "joint {} has {:.3} before and {:.3} after it",
            joint.name,
            x[k - 1],
            x[k + 1]
        ),
    };
    found.into_iter().map(told).collect()
}

/// Samples that stand out between both of their neighbours, from the usual step and size of an effort.
fn stand_out(x: &[f64], step: f64, size: f64) -> Vec<usize> {
    // An effort that hardly ever changes has no usual step: single changes are all it has.
    if step <= 0.0 {
        return Vec::new();
    }
    let is_spike = |(k, near): (usize, &[f64])| {
        let [before, after] = [near[1] - near[0], near[1] - near[2]];
        let stands_out = before * after > 0.0 && before.abs().min(after.abs()) > SPIKE_STEPS * step;
        (stands_out && near[1].abs() > SPIKE_SIZE * size).then_some(k + 1)
    };
    x.windows(3).enumerate().filter_map(is_spike).collect()
}

/// Spikes of more samples than the usual step and size leave out: single samples beyond what the drive has. Commands
/// that follow the steps of an encoder stand out singly as well, but are small.
fn frequent_spikes(joint: &Joint, x: &[f64], steps: Vec<f64>) -> Vec<usize> {
    let Some(limit) = joint.limits.effort.filter(|limit| *limit > 0.0) else { return Vec::new() };
    let doubtful = stand_out(x, quantile(steps, CLEAN_STEPS), size(x.iter(), 0.5));
    let mut is_kept = vec![true; x.len()];
    doubtful.iter().for_each(|&k| is_kept[k] = false);
    let kept = x.iter().zip(&is_kept).filter(|(_, is)| **is).map(|(x, _)| x);
    let least = limit.max(SPIKE_SIZE * size(kept, CLEAN_SIZES));
    let found: Vec<usize> = doubtful.into_iter().filter(|&k| x[k].abs() > least).collect();
    // A drive on a chattering controller reports single currents beyond its limit, too, in one sample of a hundred.
    let is_frequent = found.len() as f64 > (1.0 - USUAL_SHARE) * x.len() as f64;
    if is_frequent { found } else { Vec::new() }
}

fn size<'a>(x: impl Iterator<Item = &'a f64>, share: f64) -> f64 {
    quantile(x.map(|x| x.abs()).collect(), share)
}

#[cfg(test)]
mod tests {
    use robot::Robot;

    use super::*;

    fn lost(x: &[f64]) -> Vec<usize> {
        lost_beyond(None, x)
    }

    /// Of a joint whose effort has a limit (N m).
    fn lost_beyond(limit: Option<f64>, x: &[f64]) -> Vec<usize> {
        let text = r#"<robot name="r"><link name="a"/><link name="b"><inertial><mass value="1"/>
            <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
            <joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint></robot>"#;
        let mut joint = Robot::from_urdf(text).unwrap().links()[0].joint.clone();
        joint.limits.effort = limit;
        lost_efforts(&joint, x).iter().map(|impossible| impossible.sample).collect()
    }

    /// Efforts of a swing with dry friction: they step where the direction changes, and cross zero.
    fn swing() -> Vec<f64> {
        let effort = |k: i32| {
            let angle = 0.02 * f64::from(k);
            8.0 * angle.sin() + angle.cos().signum() + 0.01 * (1.7 * f64::from(k)).sin()
        };
        (0..2000).map(effort).collect()
    }

    #[test]
    fn zeros_between_efforts_of_one_sign_are_lost_at_any_share() {
        assert_eq!(lost(&swing()), [0_usize; 0]);
        for every in [2, 3, 10, 500] {
            let mut effort = swing();
            let zeros: Vec<usize> = (every..effort.len() - 1).step_by(every).collect();
            zeros.iter().for_each(|&k| effort[k] = 0.0);
            let found = lost(&effort);
            assert!(found.iter().all(|k| zeros.contains(k)), "{every}");
            // Near its zero a true effort may be none.
            assert!(found.len() * 10 > 7 * zeros.len(), "{} of {}", found.len(), zeros.len());
        }
    }

    #[test]
    fn drives_that_are_switched_and_currents_in_steps_have_none() {
        let switched: Vec<f64> = (0..1000).map(|k| if k % 7 < 2 { 0.0 } else { 5.0 }).collect();
        assert_eq!(lost(&switched), [0_usize; 0]);
        let in_steps: Vec<f64> = swing().iter().map(|x| x.round()).collect();
        assert_eq!(lost(&in_steps), [0_usize; 0]);
        let off_and_on: Vec<f64> = swing()
            .iter()
            .enumerate()
            .map(|(k, x)| if (100..400).contains(&k) { 0.0 } else { *x })
            .collect();
        assert_eq!(lost(&off_and_on), [0_usize; 0]);
    }

    #[test]
    fn a_single_sample_far_from_both_neighbours_is_a_spike() {
        for size in [60.0, 1000.0, -400.0] {
            let mut effort = swing();
            effort[700] = size;
            assert_eq!(lost(&effort), [700], "{size}");
            effort[701] = size;
            assert_eq!(lost(&effort), [0_usize; 0], "{size} in two rows is a blow");
        }
    }

    /// Spikes of both signs and of any size beyond the efforts, in one sample of 33, twenty or ten.
    #[test]
    fn single_samples_are_spikes_at_a_tenth_of_the_samples() {
        let clean = swing();
        for every in [33, 20, 10] {
            let mut effort = clean.clone();
            let spikes: Vec<usize> =
                (every..effort.len() - 1).step_by(every).map(|k| k - k % 7 % 3).collect();
            for (number, &k) in spikes.iter().enumerate() {
                let size = 30.0 * 1.3_f64.powi((number % 12) as i32);
                effort[k] = if number % 2 == 0 { size } else { -size };
            }
            let found = lost_beyond(Some(20.0), &effort);
            assert!(found.iter().all(|k| spikes.contains(k)), "{every}");
            assert!(found.len() * 10 > 9 * spikes.len(), "{every}: {}", found.len());
        }
    }

    /// A drive that is switched from row to row, and one whose commands alternate.
    #[test]
    fn efforts_that_alternate_have_no_spikes() {
        let chatter = |k: usize| if k.is_multiple_of(2) { 3.0 } else { -3.0 };
        let chattering: Vec<f64> =
            swing().iter().enumerate().map(|(k, x)| x + chatter(k)).collect();
        assert_eq!(lost_beyond(Some(20.0), &chattering), [0_usize; 0]);
        // A command that follows the steps of a coarse encoder.
        let kick = |k: usize| if k.is_multiple_of(3) { 0.2 } else { 0.0 };
        let kicked: Vec<f64> = (0..2000).map(|k| 0.001 * (k as f64).sin() + kick(k)).collect();
        assert_eq!(lost_beyond(Some(20.0), &kicked), [0_usize; 0]);
    }
}
