use rand_chacha::ChaCha8Rng;
use robot::Robot;
use simulator::VelocitySource;
use simulator::effects::{ActuatorDelay, EffectSpec};
use simulator::scenario::SensorSpec;

use crate::dice::{between, round_to_digits};

/// Delay of all drives over the lag of the rate loop, which is tuned for a lag twice as large.
const SHARE_OF_LAG: [f64; 2] = [0.2, 0.8];

/// The same delay at every joint: the bus to the drives.
///
/// ```text
/// delay = share (3/2 T + 1 / (2 pi f_c)),   T the period of control, f_c the corner of the velocity's low pass
/// ```
pub(crate) fn delay_of_all(
    robot: &Robot,
    sensors: &SensorSpec,
    control_rate_hz: f64,
    random: &mut ChaCha8Rng,
) -> Vec<EffectSpec> {
    let filter_s = match sensors.velocity {
        VelocitySource::FilteredDifference { cutoff_hz } => {
            1.0 / (std::f64::consts::TAU * cutoff_hz)
        }
        VelocitySource::Ideal => 0.0,
    };
    let lag_ms = 1e3 * (1.5 / control_rate_hz + filter_s);
    let delay_ms = round_to_digits(lag_ms * between(random, SHARE_OF_LAG), 3);
    let at =
        |name: &str| EffectSpec::ActuatorDelay(ActuatorDelay { joint: name.to_owned(), delay_ms });
    robot.joint_names().map(at).collect()
}
