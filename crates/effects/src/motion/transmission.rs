use std::cell::LazyCell;

use robot::{Actuator, Robot, SensingSide};

use crate::motion::compliance::{Compliance, Spring, curvature, rate};
use crate::motion::encoders::{JointMotions, LinkMotion};
use crate::motion::rigid_bodies::loads;
use crate::motion::slopes::Slopes;

/// The motion of the motors, corrected for errors of their encoders:
/// `q = transmission_ratio (reported - encoder_offset)`.
pub(crate) fn correct_reading(robot: &Robot, mut reading: JointMotions) -> JointMotions {
    for (i, link) in robot.links().iter().enumerate() {
        let (ratio, offset) = (link.actuator.transmission_ratio, link.actuator.encoder_offset);
        reading[0][i].iter_mut().for_each(|q| *q = ratio * (*q - offset));
        reading[1..].iter_mut().for_each(|x| x[i].iter_mut().for_each(|v| *v *= ratio));
    }
    reading
}

/// Motion of the motors and of the links, one of which was measured.
///
/// ```text
/// theta - q = load / elasticity + x,  |x| <= backlash / 2
/// ```
///
/// `load` is what the links need along their own motion. The play `x` is computed under the load that the links would
/// need along the measured motion.
#[derive(Debug)]
pub(crate) struct Deflection {
    pub motor: JointMotions,
    pub link: JointMotions,
    /// Load of the links along the measured motion; `None` where motors and links move as one.
    pub rigid_load: Option<Vec<Vec<f64>>>,
    /// One for each joint; `None` without a spring between its encoder and its link.
    pub compliances: Vec<Option<Compliance>>,
}

/// Rounds in which the twist of springs and the load of the twisted links are made consistent. The first round
/// leaves only what gravity and the other joints change.
const ROUNDS: usize = 3;

impl Deflection {
    /// Motion of motors and links from what was `measured` every `period_s`. Joints whose `links` were measured too
    /// keep both as measured.
    pub fn new(
        robot: &Robot,
        measured: JointMotions,
        links: Vec<Option<LinkMotion>>,
        period_s: f64,
    ) -> Self {
        let joints = robot.joint_count();
        let parts = |(i, l): (usize, &robot::Link)| {
            let drive = &l.actuator;
            let seen = links.get(i).is_some_and(Option::is_some);
            (!seen && (drive.elasticity.is_some() || drive.backlash > 0.0)).then_some(i)
        };
        let deflecting: Vec<usize> = robot.links().iter().enumerate().filter_map(parts).collect();
        let mut motor = measured.clone();
        let mut link = measured;
        for (i, seen) in links.into_iter().enumerate() {
            let signals = seen.into_iter().flatten();
            link.iter_mut().zip(signals).for_each(|(x, signal)| x[i] = signal);
        }
        let mut compliances = vec![None; joints];
        if deflecting.is_empty() {
            return Self { motor, link, rigid_load: None, compliances };
        }
        let load = loads(robot, &link);
        let slopes = LazyCell::new(|| Slopes::new(robot, &link));
        let mut of_motor = Vec::new();
        for i in deflecting {
            let drive = &robot.links()[i].actuator;
            let twist = match drive.backlash > 0.0 {
                true => {
                    let carried = LoadAlong::at_motor(&load[i], &slopes.by(i)[i]);
                    play(carried, Gap::of(drive, drive.backlash), period_s)
                }
                false => vec![0.0; load[i].len()],
            };
            if drive.sensing == SensingSide::Link {
                let compliance = drive.elasticity.map_or(0.0, f64::recip);
                let twist: Vec<f64> =
                    twist.iter().zip(&load[i]).map(|(x, load)| x + compliance * load).collect();
                move_joint(&mut motor, i, &twist, period_s);
                continue;
            }
            let compliance = |spring| Compliance::new(spring, &slopes.by(i)[i], period_s);
            compliances[i] = Spring::of(drive).map(compliance);
            of_motor.push((i, twist));
        }
        let link = links_behind(robot, link, (of_motor, &compliances), period_s);
        Self { motor, link, rigid_load: Some(load), compliances }
    }
}

/// Twist `theta - q` of some joints along the motion (rad or m).
type Twists = Vec<(usize, Vec<f64>)>;

/// Motion of the links behind motors that moved as `measured`, with the given `play` and compliances.
fn links_behind(
    robot: &Robot,
    measured: JointMotions,
    (play, compliances): (Twists, &[Option<Compliance>]),
    period_s: f64,
) -> JointMotions {
    let behind = |twists: &Twists| {
        let mut link = measured.clone();
        for (i, twist) in twists {
            let back: Vec<f64> = twist.iter().map(|s| -s).collect();
            move_joint(&mut link, *i, &back, period_s);
        }
        link
    };
    let mut twists = play.clone();
    let at_rest = twists_at_begin(robot, &measured, compliances);
    if compliances.iter().all(Option::is_none) {
        return behind(&twists);
    }
    for _ in 0..ROUNDS {
        let load = loads(robot, &behind(&twists));
        for ((i, twist), (_, play)) in twists.iter_mut().zip(&play) {
            let drive = &robot.links()[*i].actuator;
            let (Some(compliance), Some(spring)) = (&compliances[*i], Spring::of(drive)) else {
                continue;
            };
            let turns = rate(twist, period_s);
            let parts = play.iter().zip(twist.iter().zip(turns)).zip(&load[*i]);
            let missing = parts.map(|((x, (s, sd)), load)| {
                spring.compliance * load - spring.damping_s.unwrap_or(0.0) * sd + x - s
            });
            let mut missing: Vec<f64> = missing.collect();
            if let (Some(first), Some(rest)) = (missing.first_mut(), at_rest[*i]) {
                *first = rest + play.first().unwrap_or(&0.0) - twist.first().unwrap_or(&0.0);
            }
            twist.iter_mut().zip(compliance.twist_under(&missing)).for_each(|(s, more)| *s += more);
        }
    }
    behind(&twists)
}

/// Twists at the first sample of springs that are followed forward in time: links that rest twist them by their weight.
fn twists_at_begin(
    robot: &Robot,
    measured: &JointMotions,
    compliances: &[Option<Compliance>],
) -> Vec<Option<f64>> {
    if !compliances.iter().flatten().any(Compliance::is_forward) {
        return vec![None; compliances.len()];
    }
    let loads = loads_at_rest(robot, measured);
    let springs = robot.links().iter().map(|link| Spring::of(&link.actuator));
    let twists = springs.zip(compliances).zip(loads).map(|((spring, compliance), load)| {
        compliance.as_ref().filter(|of| of.is_forward())?;
        Some(spring?.compliance * load?)
    });
    twists.collect()
}

/// Loads of joints that rest where a motion begins; `None` for a motion without samples.
pub(crate) fn loads_at_rest(robot: &Robot, motion: &JointMotions) -> Vec<Option<f64>> {
    let first = |x: &Vec<f64>| x.first().copied().into_iter().collect::<Vec<f64>>();
    let position: Vec<Vec<f64>> = motion[0].iter().map(first).collect();
    let still: Vec<Vec<f64>> = position.iter().map(|x| vec![0.0; x.len()]).collect();
    let loads = loads(robot, &[position, still.clone(), still]);
    loads.iter().map(|load| load.first().copied()).collect()
}

/// Moves joint `i` by `change`.
fn move_joint(state: &mut JointMotions, i: usize, change: &[f64], period_s: f64) {
    let changes = [change.to_vec(), rate(change, period_s), curvature(change, period_s)];
    for (x, change) in state.iter_mut().zip(changes) {
        x[i].iter_mut().zip(change).for_each(|(x, change)| *x += change);
    }
}

/// Periods for which a link stays at an end of its gap after the impact there. It is half the response of the
/// low-pass filter of a diagnosis, which samples at sixteen times its cut-off and filters at four times.
const IMPACT_PERIODS: f64 = 2.0;

/// Position of the motor in a gap, sample by sample: `x = theta - q` with `|x| <= gap / 2`, at the side that carries
/// the load. When the load changes sign the link is free until it meets the other side, where it stays:
///
/// ```text
/// inertia xdd = load - dload/dq x - dload/dqd xd
/// xd = 0 at the ends,  xd = compliance d(load)/dt as it leaves one
/// ```
///
/// A spring that was twisted at the end releases the link as fast as its load falls. The load is linear between
/// samples. A link crosses a gap within a few samples, in a time that grows with the third root of the gap, so the
/// crossing is solved between samples. The impact at the other side moves the motor, and the low-pass filter spreads
/// it: a load that changes sign within `IMPACT_PERIODS` periods of an impact moves nothing.
pub(crate) fn play(
    carried: LoadAlong<'_>,
    Gap { width, compliance }: Gap,
    period_s: f64,
) -> Vec<f64> {
    let LoadAlong { load, slopes: [by_position, by_velocity, inertia] } = carried;
    let half = 0.5 * width;
    let start = half * load.first().copied().unwrap_or(0.0).signum();
    let mut state =
        GapState { half, x: start, xd: 0.0, stays_s: 0.0, impact_s: IMPACT_PERIODS * period_s };
    let mut all: Vec<f64> = load.first().map(|_| start).into_iter().collect();
    for (t, (ends, inertia)) in load.windows(2).zip(inertia).enumerate() {
        let per_inertia = |x: f64| x / inertia.max(f64::MIN_POSITIVE);
        let [stiffness, damping] =
            [by_position, by_velocity].map(|x| x.get(t).copied().unwrap_or(0.0));
        let slopes = LinkSlopes {
            stiffness: per_inertia(stiffness),
            damping: per_inertia(damping),
            departure: compliance * inertia,
        };
        state.pass([ends[0], ends[1]].map(per_inertia), slopes, period_s);
        all.push(state.x);
    }
    all
}

/// The load of a link (N·m or N) and its derivatives by the link's position, velocity and
/// acceleration, sample by sample. A derivative without samples is zero.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LoadAlong<'a> {
    load: &'a [f64],
    slopes: [&'a [f64]; 3],
}

impl LoadAlong<'_> {
    /// The load that a link would need at the position of its motor. In a gap the link is elsewhere, which the
    /// derivatives correct.
    pub fn at_motor<'a>(load: &'a [f64], [q, qd, qdd]: &'a [Vec<f64>; 3]) -> LoadAlong<'a> {
        LoadAlong { load, slopes: [q, qd, qdd] }
    }

    /// The load of a link at its own position.
    pub fn at_link<'a>(load: &'a [f64], [_, _, qdd]: &'a [Vec<f64>; 3]) -> LoadAlong<'a> {
        LoadAlong { load, slopes: [&[], &[], qdd] }
    }
}

/// Free play between a motor and its link.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Gap {
    /// Width from one end to the other (rad or m).
    pub width: f64,
    /// Compliance of the spring in series with the gap (rad/(N m) or m/N).
    pub compliance: f64,
}

impl Gap {
    /// The gap of a drive, with a width of its own (rad or m).
    pub fn of(drive: &Actuator, width: f64) -> Self {
        Self { width, compliance: drive.elasticity.map_or(0.0, f64::recip) }
    }
}

/// State of a motor in its gap.
struct GapState {
    half: f64,
    x: f64,
    xd: f64,
    /// Time left for which it stays at its end, and time for which it stays after an impact (s).
    stays_s: f64,
    impact_s: f64,
}

/// How the load of a link changes while the link crosses its gap.
#[derive(Debug, Clone, Copy)]
struct LinkSlopes {
    /// Fall of its acceleration per way (1/s²) and per speed (1/s).
    stiffness: f64,
    damping: f64,
    /// Speed at which it leaves an end, over the rate of its acceleration there (s²).
    departure: f64,
}

impl GapState {
    /// Largest number of departures from an end within one period.
    const DEPARTURES: usize = 2;

    /// Halvings of the interval in which an end is met: to 1e-15 of it.
    const HALVINGS: usize = 50;

    /// Moves on by a time in which the load is linear from one value to another, each over the inertia.
    fn pass(&mut self, [mut from, to]: [f64; 2], slopes: LinkSlopes, mut time_s: f64) {
        for _ in 0..Self::DEPARTURES {
            let rise = (to - from) / time_s;
            let stays_s = self.stays_s.min(time_s);
            self.stays_s -= stays_s;
            time_s -= stays_s;
            if time_s <= 0.0 {
                return;
            }
            from += rise * stays_s;
            if self.x.abs() >= self.half && self.xd * self.x >= 0.0 {
                let side = self.x.signum();
                let own = slopes.stiffness * self.x;
                if (from - own) * side >= 0.0 {
                    if (to - own) * side >= 0.0 {
                        return;
                    }
                    // The link leaves its end where the load is zero.
                    time_s -= (own - from) / rise;
                    (from, self.xd) = (own, slopes.departure * rise);
                }
            }
            let [start, end] = self.accelerations([from, to], slopes, time_s);
            let jerk = (end - start) / time_s;
            let after = |t: f64| self.x + t * (self.xd + t * (0.5 * start + t * jerk / 6.0));
            let end = after(time_s);
            if end.abs() < self.half {
                self.xd += time_s * (start + 0.5 * time_s * jerk);
                self.x = end;
                return;
            }
            let (mut before, mut met) = (0.0, time_s);
            for _ in 0..Self::HALVINGS {
                let middle = 0.5 * (before + met);
                let inside = after(middle).abs() < self.half;
                *(if inside { &mut before } else { &mut met }) = middle;
            }
            (self.x, self.xd, self.stays_s) = (self.half.copysign(end), 0.0, self.impact_s);
            from += rise * met;
            time_s -= met;
            if time_s <= 0.0 {
                return;
            }
        }
    }

    /// The accelerations at the begin and at the end of a time; the latter at the position to which the former leads.
    fn accelerations(&self, [from, to]: [f64; 2], slopes: LinkSlopes, time_s: f64) -> [f64; 2] {
        let at = |load: f64, x: f64, xd: f64| {
            load - slopes.stiffness * x.clamp(-self.half, self.half) - slopes.damping * xd
        };
        let start = at(from, self.x, self.xd);
        let way = time_s * (self.xd + 0.5 * time_s * start);
        [start, at(to, self.x + way, self.xd + time_s * start)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A load that grows as `c t` crosses the gap in `(6 gap inertia / c)^(1/3)`.
    #[test]
    fn a_link_crosses_its_play_as_it_falls() {
        let (gap, inertia, c, period_s) = (0.01, 0.2, 3.0, 1e-4);
        let time = |t: usize| (t as f64 - 1000.0) * period_s;
        let load: Vec<f64> = (0..6000).map(|t| c * time(t)).collect();
        let x = play(
            LoadAlong { load: &load, slopes: [&[0.0; 6000], &[0.0; 6000], &[inertia; 6000]] },
            Gap { width: gap, compliance: 0.0 },
            period_s,
        );
        let crossed = x.iter().position(|x| *x >= 0.5 * gap).unwrap();
        let expected = (6.0 * gap * inertia / c).cbrt();
        assert!((time(crossed) - expected).abs() < 3.0 * period_s, "{} s", time(crossed));
        assert!((x[0] + 0.5 * gap).abs() < 1e-15 && (x[5999] - 0.5 * gap).abs() < 1e-15);
    }

    /// The load turns between two samples; from there the link is `compliance c t + c t³ / (6 inertia)`
    /// from its end until it has crossed, in eight samples that tell nothing but their own load, or in
    /// six where a spring lets go.
    #[test]
    fn oracle_a_play_that_is_crossed_in_a_few_samples_is_crossed_as_in_many() {
        let (gap, inertia, c, period_s) = (0.01, 0.2, 3.0, 0.02);
        let time = |t: usize| (t as f64 - 20.4) * period_s;
        let load: Vec<f64> = (0..60).map(|t| c * time(t)).collect();
        for compliance in [0.0, 0.01] {
            let x = play(
                LoadAlong { load: &load, slopes: [&[0.0; 60], &[0.0; 60], &[inertia; 60]] },
                Gap { width: gap, compliance },
                period_s,
            );
            for (t, x) in x.iter().enumerate() {
                let after = time(t).max(0.0);
                let way = c * (compliance * after + after.powi(3) / (6.0 * inertia));
                let expected = (way - 0.5 * gap).min(0.5 * gap);
                assert!((x - expected).abs() < 1e-12, "{x}, not {expected}, at {} s", time(t));
            }
        }
    }

    /// A link that falls over, its load `c t + k x` at its motor's own position: it leaves an end
    /// late by `k gap / (2 c)`, and from there is
    ///
    /// ```text
    /// c / k (sinh(w t) / w - t),   w² = k / inertia
    /// ```
    ///
    /// from it.
    #[test]
    fn oracle_a_link_that_falls_over_leaves_its_end_late_and_is_soon_at_the_other() {
        let (gap, inertia, c, k, period_s) = (0.03, 2.5, 30.0, 60.0, 0.01_f64);
        let time = |t: usize| (t as f64 - 20.4) * period_s;
        let load: Vec<f64> = (0..100).map(|t| c * time(t)).collect();
        let carried = LoadAlong { load: &load, slopes: [&[-k; 100], &[0.0; 100], &[inertia; 100]] };
        let x = play(carried, Gap { width: gap, compliance: 0.0 }, period_s);
        let w = (k / inertia).sqrt();
        for (t, x) in x.iter().enumerate() {
            let after = (time(t) - 0.5 * k * gap / c).max(0.0);
            let way = c / k * ((w * after).sinh() / w - after);
            let expected = (way - 0.5 * gap).min(0.5 * gap);
            assert!((x - expected).abs() < 2e-3 * gap, "{x}, not {expected}, at {} s", time(t));
        }
    }

    /// A link that meets its motor throws it forward, for which the load turns until a sample later: it
    /// does not bounce.
    #[test]
    fn a_blow_that_a_low_pass_has_spread_is_no_load_that_turns() {
        let (gap, inertia, period_s) = (0.01, 0.2, 0.01);
        let mut load = [-1.0; 60];
        load[20..].fill(1.0);
        let at = |load: &[f64]| {
            let carried = LoadAlong { load, slopes: [&[0.0; 60], &[0.0; 60], &[inertia; 60]] };
            play(carried, Gap { width: gap, compliance: 0.0 }, period_s)
        };
        let met = at(&load).iter().position(|x| *x >= 0.5 * gap).unwrap();
        load[met] = -3.0;
        let x = at(&load);
        assert!(x[met + 1..].iter().all(|x| (x - 0.5 * gap).abs() < 1e-15), "{x:?}");
    }
}
