use logs::{Prepared, rest_speeds};
use robot::Robot;

/// Least range over which a joint moves (rad or m), and the same as a share of the largest range of any joint of its
/// kind.
const LEAST_WAY: f64 = 2e-3;
const LEAST_SHARE: f64 = 0.02;

/// Width of a change of direction, in speeds below which a joint counts as at rest. One such speed is four standard
/// deviations of the velocity's noise.
const SIGN_WIDTH: f64 = 0.5;

/// Scales of the columns, from the logs as a whole.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Scales {
    /// Speed at which the direction of a joint is `tanh(1)` (rad/s or m/s).
    pub sign_speed: Vec<f64>,
    /// Whether the joint moves.
    pub moves: Vec<bool>,
}

impl Scales {
    /// The scales of some logs.
    pub fn of(robot: &Robot, logs: &Prepared) -> Self {
        let kinds: Vec<bool> = robot.links().iter().map(|l| l.joint.kind.is_rotation()).collect();
        let ways: Vec<f64> = (0..kinds.len())
            .map(|j| logs.span(j))
            .map(|(low, high)| (high - low).max(0.0))
            .collect();
        let longest = |kind: bool| {
            let alike = kinds.iter().zip(&ways).filter(|(other, _)| **other == kind);
            alike.fold(0.0, |most: f64, (_, way)| most.max(*way))
        };
        let least = |j: usize| LEAST_WAY.max(LEAST_SHARE * longest(kinds[j]));
        let moves: Vec<bool> = (0..ways.len()).map(|j| ways[j] >= least(j)).collect();
        Self {
            sign_speed: rest_speeds(logs).into_iter().map(|speed| SIGN_WIDTH * speed).collect(),
            moves,
        }
    }
}
