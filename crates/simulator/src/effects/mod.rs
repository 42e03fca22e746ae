//! The truth side of every effect, one file each, named as in the catalogue.

mod coulomb_friction;

use catalogue::EffectKind;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use coulomb_friction::CoulombFriction;

use crate::{Inject, Truth};

/// A value of a scenario that cannot be meant.
#[derive(Debug, Clone, PartialEq)]
pub struct Mistake {
    /// Key of the value, inside the effect.
    pub key: &'static str,
    /// What was found and what was expected.
    pub found: String,
}

/// Where an effect is drawn, and how large motion and torque are there without it.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings<'a> {
    /// The robot without effects.
    pub robot: &'a Robot,
    /// The joint, or the joint that carries the link.
    pub joint: usize,
    /// Root mean square of the joint's torque (N m or N).
    pub torque_rms: f64,
    /// Root mean square of its velocity (rad/s or m/s).
    pub speed_rms: f64,
    /// Root mean square of its acceleration (rad/s² or m/s²).
    pub acceleration_rms: f64,
    /// Least and largest position (rad or m).
    pub range: (f64, f64),
    /// Root mean square of the derivative of its torque (N m/s or N/s).
    pub torque_rate_rms: f64,
}

impl Surroundings<'_> {
    /// Name of the joint.
    pub fn joint_name(&self) -> String {
        self.robot.joint_names().nth(self.joint).unwrap_or_default().to_owned()
    }
}

/// An effect as a scenario states it.
pub trait Effect: Sized {
    /// Its name.
    const KIND: EffectKind;

    /// Where it acts, and its parameters under the catalogue's names.
    fn truth(&self) -> Truth;

    /// The effect ready to act on a robot. Refuses what no arm has; the joints and links named
    /// must be the robot's.
    ///
    /// # Errors
    ///
    /// [`Mistake`], the first found.
    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake>;

    /// An effect whose torque has about `share` of the joint's torque root mean square, and more
    /// the larger `share` is; what does not set the size is drawn.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self;
}

/// Any effect, as `[[effect]]` of a scenario states it: one key, the effect's name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EffectSpec {
    /// Torque of constant size against the motion.
    CoulombFriction(CoulombFriction),
}

/// Calls a function of [`Effect`] on whichever effect it is.
macro_rules! each {
    ($spec:expr, $effect:ident => $call:expr) => {
        match $spec {
            EffectSpec::CoulombFriction($effect) => $call,
        }
    };
}

impl EffectSpec {
    /// Its name.
    pub fn kind(&self) -> EffectKind {
        each!(self, effect => kind_of(effect))
    }

    /// Where it acts, and its parameters under the catalogue's names.
    pub fn truth(&self) -> Truth {
        each!(self, effect => effect.truth())
    }

    /// The effect ready to act on a robot; see [`Effect::inject`].
    ///
    /// # Errors
    ///
    /// [`Mistake`], the first found: a joint that the robot does not have, or a value that no arm
    /// has.
    pub fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        each!(self, effect => effect.inject(robot))
    }

    /// An effect of a kind, drawn; see [`Effect::draw`].
    pub fn draw(
        kind: EffectKind,
        at: &Surroundings<'_>,
        share: f64,
        random: &mut ChaCha8Rng,
    ) -> Option<Self> {
        match kind {
            EffectKind::CoulombFriction => {
                Some(Self::CoulombFriction(Effect::draw(at, share, random)))
            }
            _ => None,
        }
    }
}

fn kind_of<E: Effect>(_: &E) -> EffectKind {
    E::KIND
}

/// The index of a joint that a scenario names.
fn joint_of(robot: &Robot, name: &str) -> Result<usize, Mistake> {
    robot.joint_index(name).ok_or_else(|| {
        let names: Vec<&str> = robot.joint_names().collect();
        let found = format!(
            "no joint of robot {} is called {name}, its joints are {}",
            robot.name(),
            names.join(", ")
        );
        Mistake { key: "joint", found }
    })
}

/// Refuses a number outside of `low..=high`.
fn within(key: &'static str, value: f64, low: f64, high: f64) -> Result<(), Mistake> {
    if value.is_finite() && (low..=high).contains(&value) {
        return Ok(());
    }
    let found = format!("{value}, a number from {low} to {high} was expected");
    Err(Mistake { key, found })
}
