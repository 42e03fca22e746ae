use catalogue::EffectKind;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::{Reading, Robot};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::delay_line::DelayLine;
use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::Surroundings;
use crate::effects::truth::Truth;
use crate::mechanics::inject::Inject;

/// Effort and position of different instants in one row of the log.
///
/// ```text
/// skew > 0: effort logged at t is that of t - skew
/// skew < 0: position and velocity logged at t are those of t + skew
/// ```
///
/// Between rows the signals are taken as linear, and before the first row its values are held. The
/// noise of the effort comes on top; positions are late as measured, so that those of a broken
/// number of rows have less noise and lie between counts. The controller does not see any of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeSkew {
    /// The joint; every joint where none is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Time by which the log has effort later than position (ms), -1000 to 1000.
    pub skew_ms: f64,
}

impl ScenarioEffect for TimeSkew {
    const KIND: EffectKind = EffectKind::TimeSkew;

    fn truth(&self) -> Truth {
        let everywhere = Truth::everywhere(Self::KIND, &[("skew", 1e-3 * self.skew_ms)]);
        Truth { joint: self.joint.clone(), ..everywhere }
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joints = match &self.joint {
            Some(name) => vec![joint_of(robot, name)?],
            None => (0..robot.joint_count()).collect(),
        };
        within("skew_ms", self.skew_ms, -1000.0, 1000.0)?;
        let effort_is_late = self.skew_ms > 0.0;
        let line = DelayLine::new(1e-3 * self.skew_ms.abs());
        let lines = |joint| (joint, [line.clone(), line.clone(), line.clone()]);
        Ok(Box::new(Injected { effort_is_late, lines: joints.into_iter().map(lines).collect() }))
    }

    /// Of every joint; the torque is off by about `skew d(tau)/dt`.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let skew_ms = (1e3 * share * at.torque_rms / at.torque_rate_rms).min(1000.0);
        Self { joint: None, skew_ms: if random.random() { skew_ms } else { -skew_ms } }
    }
}

struct Injected {
    effort_is_late: bool,
    /// Joints, and what holds back their effort, or else their position, velocity and position of
    /// the link.
    lines: Vec<(usize, [DelayLine; 3])>,
}

impl Inject for Injected {
    fn on_start(&mut self, _: &[f64]) {
        self.lines.iter_mut().flat_map(|(_, lines)| lines).for_each(DelayLine::clear);
    }

    fn on_record(&mut self, row: &mut Reading) {
        for (joint, [first, second, _]) in &mut self.lines {
            let (time_s, i) = (row.time_s, *joint);
            if self.effort_is_late {
                row.effort[i] = first.pass(time_s, row.effort[i]);
            } else {
                row.q[i] = first.pass(time_s, row.q[i]);
                row.qd[i] = second.pass(time_s, row.qd[i]);
            }
        }
    }

    fn on_record_links(&mut self, time_s: f64, links: &mut [Option<f64>]) {
        if self.effort_is_late {
            return;
        }
        for (joint, [_, _, line]) in &mut self.lines {
            links[*joint] = links[*joint].map(|q| line.pass(time_s, q));
        }
    }
}
