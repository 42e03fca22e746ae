use catalogue::EffectKind;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::{Robot, Warming};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::Surroundings;
use crate::effects::truth::Truth;
use crate::mechanics::inject::{Efforts, Inject, Moment};

/// Largest share of friction that may go: a warm joint keeps some.
const MAX_SHARE: f64 = 0.9;

/// Friction that falls while the drive warms up; the run starts cold.
///
/// ```text
/// friction(t) = (1 - share (1 - exp(-t / time_constant))) friction(cold)
/// ```
///
/// Scales viscous and dry friction and the torque of bristles, those of the robot's own actuators
/// and those of every effect before this one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrictionTemperatureDrift {
    /// The joint; every joint if none is named.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Share of the cold friction that is lost when warm (no unit), 0 to 0.9.
    pub share: f64,
    /// Time constant of warming up (s), 0.001 to 100000.
    pub time_constant_s: f64,
}

impl ScenarioEffect for FrictionTemperatureDrift {
    const KIND: EffectKind = EffectKind::FrictionTemperatureDrift;

    fn truth(&self) -> Truth {
        let parameters = [("share", self.share), ("time_constant", self.time_constant_s)];
        Truth { joint: self.joint.clone(), ..Truth::everywhere(Self::KIND, &parameters) }
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joints = match &self.joint {
            Some(name) => vec![joint_of(robot, name)?],
            None => (0..robot.joint_count()).collect(),
        };
        within("share", self.share, 0.0, MAX_SHARE)?;
        within("time_constant_s", self.time_constant_s, 1e-3, 1e5)?;
        Ok(Box::new(Injected { joints, share: self.share, time_constant: self.time_constant_s }))
    }

    /// The share follows from the friction that the robot has without effects, if it has any.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let friction = at.robot.links().get(at.joint).map_or(0.0, |link| {
            let dry = 0.5 * (link.actuator.coulomb_forward + link.actuator.coulomb_backward);
            dry + link.actuator.viscous * at.speed_rms
        });
        let lost = if friction > 0.0 { share * at.torque_rms / friction } else { share };
        Self {
            joint: Some(at.joint_name()),
            share: lost.min(MAX_SHARE),
            time_constant_s: random.random_range(600.0..2400.0),
        }
    }
}

struct Injected {
    joints: Vec<usize>,
    share: f64,
    time_constant: f64,
}

impl Inject for Injected {
    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        let left = 1.0 + self.share * (-moment.time_s.max(0.0) / self.time_constant).exp_m1();
        for &joint in &self.joints {
            efforts.scale_friction(joint, left);
        }
    }
}

/// The friction that a robot is described to lose.
pub(super) fn losing(joint: usize, warming: Warming) -> Box<dyn Inject> {
    Box::new(Losing { joint, warming })
}

struct Losing {
    joint: usize,
    warming: Warming,
}

impl Inject for Losing {
    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        let Self { joint, warming } = *self;
        let warm = -(-moment.time_s.max(0.0) / warming.time_constant_s).exp_m1();
        efforts.viscous[joint] -= warm * warming.viscous_lost;
        efforts.add_dry(joint, -warm * warming.coulomb_lost);
    }
}
