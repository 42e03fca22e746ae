use robot::PdGain;

use crate::fit::Fitted;
use crate::judge::Judge;
use crate::log_reading::LogReading;
use crate::observation::{Observation, ObservationKind, ReadingEvidence, Spoils};

/// A joint whose computed effort friction of no size leaves as it is, and friction of either sign does not.
struct Contradicted {
    joint: usize,
    gains: PdGain,
    /// Without and with friction of either sign.
    fits: [Fitted; 2],
}

/// Loops that follow the velocity of their goals, where efforts are computed from goals: these fall with speed by the gain `kd`,
/// which no friction does. The samples are read so from then on.
///
/// ```text
/// kp (goal - q) - kd qd = c tau + f sign(qd) + b qd + i qdd + offset,   b = -kd about
/// ```
pub(crate) fn goal_velocity(judge: &mut Judge, runs: usize) -> Option<Observation> {
    let t = judge.thresholds;
    let links = judge.robot.links();
    let gains = |j: usize| {
        let gains = links[j].actuator.position_loop;
        gains.filter(|gains| gains.kp > 0.0 && gains.kd > 0.0 && judge.samples.has_goals(j))
    };
    let contradicted = |joint: usize| {
        let (gains, fits) = (gains(joint)?, judge.fits_of_loop(joint));
        let is_contradicted = fits[0].share >= t.misfit[0] && fits[1].share <= t.mended;
        is_contradicted.then_some(Contradicted { joint, gains, fits })
    };
    let all: Vec<Contradicted> = (0..links.len()).filter_map(contradicted).collect();
    let falls_by_kd = |c: &Contradicted| (c.fits[1].b() + c.gains.kd).abs() < t.alike * c.gains.kd;
    let wanted = links.len().div_ceil(t.joints_of_confirming).min(t.most_confirming);
    if all.len() < wanted || !all.iter().all(falls_by_kd) {
        return None;
    }
    let most = all.iter().max_by(|a, b| a.fits[0].share.total_cmp(&b.fits[0].share))?;
    let gain = |c: &Contradicted| {
        let [before, after] = c.fits.map(|fit| fit.share + judge.floors[c.joint]);
        (before / after).ln()
    };
    let evidence = ReadingEvidence {
        joint: most.joint,
        before: most.fits[0].share,
        after: most.fits[1].share,
        gain: all.iter().map(gain).sum(),
    };
    let joints = (0..links.len()).filter(|j| gains(*j).is_some()).collect();
    let ratio = |j| gains(j).map_or(0.0, |gains| gains.kd / gains.kp);
    let reading = LogReading::GoalVelocity((0..links.len()).map(ratio).collect());
    judge.adopt(&reading);
    let (kind, runs) = (ObservationKind::GoalVelocity, (0..runs).collect());
    Some(Observation {
        evidence: Some(evidence),
        ..Observation::of_runs(kind, joints, runs, Spoils::Everything)
    })
}
