use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::MotionError;
use crate::knots::Knots;
use crate::motion::ClockedCurve;
use crate::site::{LONGEST_S, Site, above_up_to};
use crate::spline::smoothest;

/// Through given positions at given times, from rest to rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Waypoints {
    /// Times of the waypoints (s), at least two, increasing from 0.
    pub times_s: Vec<f64>,
    /// Positions of each joint that moves, one per time.
    pub positions_rad: BTreeMap<String, Vec<f64>>,
    /// What happens at the waypoints between the first and the last.
    #[serde(default)]
    pub via: Via,
}

/// What happens at a waypoint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Via {
    /// Pass it, on the curve of least jerk (squared, over time) through all of them.
    #[default]
    Pass,
    /// Rest at it; between two the move is `10 u^3 - 15 u^4 + 6 u^5`.
    Stop,
}

impl Waypoints {
    pub(super) fn parts(&self, site: &Site) -> Result<Vec<ClockedCurve>, MotionError> {
        self.check_times(site)?;
        let still = site.posture("positions_rad", &BTreeMap::new())?;
        let mut states: Vec<Vec<[f64; 3]>> =
            vec![still.iter().map(|&q| [q, 0.0, 0.0]).collect(); self.times_s.len()];
        for (joint, positions) in &self.positions_rad {
            let index = site.joint_index("positions_rad", joint)?;
            let key = ["positions_rad", joint];
            if positions.len() != self.times_s.len() {
                return Err(MotionError::WrongLength {
                    key: site.key(&key),
                    found: positions.len(),
                    expected: format!("{} as in times_s were", self.times_s.len()),
                });
            }
            for (k, &position) in positions.iter().enumerate() {
                site.number(&[key[0], key[1], &k.to_string()], position, ..)?;
            }
            let curve = match self.via {
                Via::Pass => smoothest(&self.times_s, positions, [[0.0; 2]; 2]),
                Via::Stop => positions.iter().map(|&q| [q, 0.0, 0.0]).collect(),
            };
            states.iter_mut().zip(curve).for_each(|(state, here)| state[index] = here);
        }
        site.evenly(Knots::new(self.times_s.clone(), states))
    }

    fn check_times(&self, site: &Site) -> Result<(), MotionError> {
        if self.times_s.len() < 2 {
            return Err(MotionError::WrongLength {
                key: site.key(&["times_s"]),
                found: self.times_s.len(),
                expected: "at least 2 were".to_owned(),
            });
        }
        site.number(&["times_s", "0"], self.times_s[0], 0.0..=0.0)?;
        for (k, pair) in self.times_s.windows(2).enumerate() {
            let later = above_up_to(pair[0], LONGEST_S);
            site.number(&["times_s", &(k + 1).to_string()], pair[1], later)?;
        }
        Ok(())
    }
}
