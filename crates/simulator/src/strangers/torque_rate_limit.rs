use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::surroundings::Surroundings;
use crate::mechanics::inject::{Inject, Moment};
use crate::strangers::kind::StrangerKind;
use crate::strangers::scenario_stranger::ScenarioStranger;
use crate::strangers::truth::StrangerTruth;

/// Torque that changes no faster than it can, as of a drive short of voltage.
///
/// ```text
/// |tau(k+1) - tau(k)| <= rate dt,  towards the command,  while |command - tau| <= behind
/// ```
///
/// Where `behind` is given, the drive has a reserve with which it never stays further behind; without
/// one, the loop of a stiff controller swings ever wider. In the unit of the command; it acts on the
/// command before saturation, delay and lag. Before the start, the first command was held.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TorqueRateLimit {
    /// The joint.
    pub joint: String,
    /// Largest rate of torque in both directions (N m/s; N/s for a prismatic joint), 0.000001 to
    /// 1e7.
    pub rate_nm_per_s: f64,
    /// How far the torque stays behind its command at most (N m; N), 0 to 1000; any distance where
    /// it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub behind_nm: Option<f64>,
}

impl ScenarioStranger for TorqueRateLimit {
    const KIND: StrangerKind = StrangerKind::TorqueRateLimit;

    fn truth(&self) -> StrangerTruth {
        let behind = self.behind_nm.map(|behind| ("behind", behind));
        let parameters: Vec<(&str, f64)> =
            [("rate", self.rate_nm_per_s)].into_iter().chain(behind).collect();
        StrangerTruth::at_joint(Self::KIND, &self.joint, &parameters)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("rate_nm_per_s", self.rate_nm_per_s, 1e-6, 1e7)?;
        within("behind_nm", self.behind_nm.unwrap_or(0.0), 0.0, 1000.0)?;
        let behind = self.behind_nm.unwrap_or(f64::INFINITY);
        Ok(Box::new(Injected { joint, rate: self.rate_nm_per_s, behind, last: None }))
    }

    /// A rate that the command often exceeds; what is behind, a controller asks for on top.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let rate = at.torque_rate_rms * random.random_range(0.2..0.5);
        Self {
            joint: at.joint_name(),
            rate_nm_per_s: rate.clamp(1e-6, 1e7),
            behind_nm: Some((share * at.torque_rms).min(1000.0)),
        }
    }
}

struct Injected {
    joint: usize,
    rate: f64,
    behind: f64,
    /// Torque of the last step (N m or N).
    last: Option<f64>,
}

impl Inject for Injected {
    fn on_start(&mut self, _: &[f64]) {
        self.last = None;
    }

    fn on_command(&mut self, moment: &Moment<'_>, tau: &mut [f64]) {
        let command = tau[self.joint];
        let last = self.last.unwrap_or(command);
        let most = self.rate * moment.step_s;
        let ramp = last + (command - last).clamp(-most, most);
        let torque = ramp.clamp(command - self.behind, command + self.behind);
        tau[self.joint] = torque;
        self.last = Some(torque);
    }
}
