use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::Mistake;
use crate::effects::surroundings::Surroundings;
use crate::mechanics::inject::Inject;
use crate::strangers::drive_dead_zone::DriveDeadZone;
use crate::strangers::eccentric_encoder::EccentricEncoder;
use crate::strangers::integrator_windup::IntegratorWindup;
use crate::strangers::kind::StrangerKind;
use crate::strangers::list::for_each_stranger;
use crate::strangers::magnet_well::MagnetWell;
use crate::strangers::scenario_stranger::ScenarioStranger;
use crate::strangers::snag::Snag;
use crate::strangers::soft_mount::SoftMount;
use crate::strangers::soft_wall::SoftWall;
use crate::strangers::speed_crosstalk::SpeedCrosstalk;
use crate::strangers::square_drag::SquareDrag;
use crate::strangers::tilting_bearing::TiltingBearing;
use crate::strangers::torque_dropout::TorqueDropout;
use crate::strangers::torque_rate_limit::TorqueRateLimit;
use crate::strangers::truth::StrangerTruth;

/// Makes [`StrangerSpec`] of the list of strangers, and calls the [`ScenarioStranger`] that it is.
macro_rules! strangers {
    ($($(#[$meaning:meta])* $name:ident $file:ident;)*) => {
        /// Any stranger, as `[[stranger]]` of a scenario states it: one key, the stranger's name.
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(rename_all = "snake_case")]
        pub enum StrangerSpec {
            $($(#[$meaning])* $name($name),)*
        }

        impl StrangerSpec {
            /// Its name.
            pub fn kind(&self) -> StrangerKind {
                match self {
                    $(Self::$name(_) => <$name as ScenarioStranger>::KIND,)*
                }
            }

            /// Where it acts, and its parameters (SI).
            pub fn truth(&self) -> StrangerTruth {
                match self {
                    $(Self::$name(stranger) => stranger.truth(),)*
                }
            }

            /// The stranger ready to act on a robot; see [`ScenarioStranger::inject`].
            ///
            /// # Errors
            ///
            /// [`Mistake`], the first found: a joint that the robot does not have, or a value
            /// that no arm has.
            pub fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
                match self {
                    $(Self::$name(stranger) => stranger.inject(robot),)*
                }
            }

            /// A stranger of a kind, drawn; see [`ScenarioStranger::draw`].
            pub fn draw(
                kind: StrangerKind,
                at: &Surroundings<'_>,
                share: f64,
                random: &mut ChaCha8Rng,
            ) -> Self {
                match kind {
                    $(StrangerKind::$name => Self::$name(ScenarioStranger::draw(at, share, random)),)*
                }
            }
        }
    };
}

for_each_stranger!(strangers);
