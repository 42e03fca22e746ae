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

/// An integrator in the drive that nobody asked for: a slow torque up to its limit.
///
/// ```text
/// tau = command + z,   dz/dt = command / time_constant  while |z| < limit
/// ```
///
/// `z` stops at the limit and leaves it as soon as the command has the other sign. It starts at
/// zero with the run, before the log where the arm is held first. In the unit of the command; it
/// acts on the command before everything else.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct IntegratorWindup {
    /// The joint.
    pub joint: String,
    /// Time in which a constant command winds up as much again (s), 0.001 to 1e5.
    pub time_constant_s: f64,
    /// Where it stops (N m; N for a prismatic joint), 0 to 1000.
    pub limit_nm: f64,
}

impl ScenarioStranger for IntegratorWindup {
    const KIND: StrangerKind = StrangerKind::IntegratorWindup;

    fn truth(&self) -> StrangerTruth {
        let parameters = [("time_constant", self.time_constant_s), ("limit", self.limit_nm)];
        StrangerTruth::at_joint(Self::KIND, &self.joint, &parameters)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("time_constant_s", self.time_constant_s, 1e-3, 1e5)?;
        within("limit_nm", self.limit_nm, 0.0, 1000.0)?;
        Ok(Box::new(Injected {
            joint,
            time_constant_s: self.time_constant_s,
            limit: self.limit_nm,
            wound: 0.0,
        }))
    }

    /// At its limit most of the time: a torque that swings with `w = rms(d tau/dt) / rms(tau)`
    /// winds up `sqrt(2) rms / (w time_constant)`, here two to four times the limit.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let limit = (1.1 * share * at.torque_rms).min(1000.0);
        let omega = at.torque_rate_rms / at.torque_rms.max(1e-9);
        let times = share * random.random_range(2.0..4.0);
        let time_constant_s = std::f64::consts::SQRT_2 / (omega * times).max(1e-9);
        Self {
            joint: at.joint_name(),
            time_constant_s: time_constant_s.clamp(0.05, 100.0),
            limit_nm: limit,
        }
    }
}

struct Injected {
    joint: usize,
    time_constant_s: f64,
    limit: f64,
    /// What the integrator has wound up (N m or N).
    wound: f64,
}

impl Inject for Injected {
    fn on_start(&mut self, _: &[f64]) {
        self.wound = 0.0;
    }

    fn on_command(&mut self, moment: &Moment<'_>, tau: &mut [f64]) {
        let tau = &mut tau[self.joint];
        // Half of the step's winding acts in it.
        let more = *tau * moment.step_s / self.time_constant_s;
        let before = self.wound;
        self.wound = (before + more).clamp(-self.limit, self.limit);
        *tau += 0.5 * (before + self.wound);
    }
}
