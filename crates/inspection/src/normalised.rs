use logs::Run;
use robot::Robot;

use crate::observation::{Observation, ObservationKind, Spoils};
use crate::thresholds::InspectionThresholds;

/// The largest normalised position, 100, read as degrees (rad).
const LARGEST: f64 = 100.0_f64.to_radians();

/// Positions of a dataset of `LeRobot`, a folder, that were read as degrees and may be normalised, -100 to 100 over the range
/// of a calibration: none is beyond 100, and some joint is beyond its limits.
///
/// The joint that is so in most samples is told. The zero of an encoder that is off looks alike; nothing can be told from such
/// positions either.
pub(crate) fn normalised_positions(
    robot: &Robot,
    runs: &[Run],
    t: &InspectionThresholds,
) -> Option<Observation> {
    let turns = |j: usize| robot.links()[j].joint.kind.is_rotation();
    let is_dataset = runs.iter().all(|run| run.source.is_dir());
    let rotations: Vec<usize> = (0..robot.joint_count()).filter(|j| turns(*j)).collect();
    let of = |j: usize| runs.iter().flat_map(move |run| &run.joints[j].position);
    // The rounding of numbers of single precision.
    let within = |j: &usize| of(*j).all(|q| q.abs() <= LARGEST * (1.0 + f64::from(f32::EPSILON)));
    if !is_dataset || !rotations.iter().all(within) {
        return None;
    }
    let share = |j: usize| {
        let (low, high) = robot.links()[j].joint.limits.position?;
        let room = t.beyond_range * (high - low);
        let beyond = of(j).filter(|q| **q < low - room || **q > high + room).count();
        Some((j, beyond as f64 / of(j).count().max(1) as f64))
    };
    let shares = rotations.iter().filter_map(|j| share(*j));
    let (joint, share) = shares.max_by(|a, b| a.1.total_cmp(&b.1))?;
    (share > t.rows_beyond_range).then(|| {
        let kind = ObservationKind::NormalisedPositions { share };
        Observation::of_runs(kind, vec![joint], (0..runs.len()).collect(), Spoils::Everything)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inspect::inspect;
    use crate::testing::{pendulum, swing};

    /// A hinge of -10 to 100 degrees, as a gripper has, in a dataset that says 1.3 rad at most either way.
    #[test]
    fn degrees_of_a_dataset_beyond_the_limits_of_a_joint_may_be_normalised() {
        let mut robot = pendulum();
        let limits = |low: f64, high: f64| Some((low.to_radians(), high.to_radians()));
        robot.link_mut(0).unwrap().joint.limits.position = limits(-10.0, 100.0);
        let folder = std::env::temp_dir();
        let mut runs = vec![swing(0.3), swing(1.1)];
        let told = |robot: &Robot, runs: &[Run]| {
            let kind = |o: &Observation| matches!(o.kind, ObservationKind::NormalisedPositions { share } if share > 0.3);
            inspect(robot, runs).iter().find(|o| kind(o)).map(|o| o.sentence(robot, runs))
        };
        assert_eq!(told(&robot, &runs), None, "a file has no normalised positions");
        runs.iter_mut().for_each(|run| run.source.clone_from(&folder));
        let sentence = told(&robot, &runs).unwrap();
        let begin = "Read as degrees, the position of joint hinge is beyond its limits of -0.175 to 1.745 rad in";
        assert!(sentence.starts_with(begin), "{sentence}");
        assert!(sentence.contains("may be normalised to -100 .. 100"), "{sentence}");
        robot.link_mut(0).unwrap().joint.limits.position = limits(-100.0, 100.0);
        assert_eq!(told(&robot, &runs), None);
        robot.link_mut(0).unwrap().joint.limits.position = limits(-10.0, 100.0);
        runs[0].joints[0].position[7] = 101.0_f64.to_radians();
        assert_eq!(told(&robot, &runs), None, "it is beyond 100");
    }
}
