use crate::error::MotionError;
use crate::knots::{Knots, glide_s};
use crate::motion::ClockedCurve;
use crate::site::Site;

/// Speed of a move between two motions, as a share of a joint's velocity limit.
const SPEED_SHARE: f64 = 0.5;
/// Its speed at joints without a limit (rad/s or m/s).
const SPEED: f64 = 1.0;
/// Its acceleration (rad/s² or m/s²).
const ACCELERATION: f64 = 2.0;
/// The shortest move (s).
const SHORTEST_S: f64 = 0.5;

/// Refuses a sequence without a motion.
pub(super) fn check(count: usize, site: &Site) -> Result<(), MotionError> {
    if count > 0 {
        return Ok(());
    }
    let expected = "at least 1 was".to_owned();
    Err(MotionError::WrongLength { key: site.key(&[]), found: 0, expected })
}

/// Adds the next motion of a sequence, behind a move that leads to it.
///
/// The move is one polynomial of degree five from the last state of the motion before to the first
/// state of the next, so that position, velocity and acceleration are continuous. Equal states
/// need no move.
pub(super) fn append(
    parts: &mut Vec<ClockedCurve>,
    next: Vec<ClockedCurve>,
    site: &Site,
) -> Result<(), MotionError> {
    if let (Some(last), Some(first)) = (parts.last(), next.first())
        && let Some(knots) = join(site, last, first)
    {
        parts.extend(site.evenly(knots)?);
    }
    parts.extend(next);
    Ok(())
}

/// Refuses a sequence that lasts too long.
pub(super) fn check_length(parts: &[ClockedCurve], site: &Site) -> Result<(), MotionError> {
    let duration: f64 = parts.iter().map(|part| part.clock.duration_s()).sum();
    site.short_enough(&[], duration)
}

/// Speeds of a move, joint by joint (rad/s or m/s).
fn speeds(site: &Site) -> Vec<f64> {
    let speed =
        |index| site.joint(index).limits.velocity.map_or(SPEED, |limit| SPEED_SHARE * limit);
    (0..site.robot.joint_count()).map(speed).collect()
}

/// The move from the end of one part to the start of the next.
fn join(site: &Site, last: &ClockedCurve, first: &ClockedCurve) -> Option<Knots> {
    let joints = 0..site.robot.joint_count();
    let ends = joints.clone().map(|j| last.at(j, last.clock.duration_s())).collect::<Vec<_>>();
    let starts = joints.map(|j| first.at(j, 0.0)).collect::<Vec<_>>();
    if ends == starts {
        return None;
    }
    let pairs = ends.iter().zip(&starts).zip(speeds(site));
    let needed = pairs.map(|((end, start), v)| glide_s((end[0] - start[0]).abs(), v, ACCELERATION));
    let duration_s = needed.fold(SHORTEST_S, f64::max);
    Some(Knots::new(vec![0.0, duration_s], vec![ends, starts]))
}
