use rand_chacha::ChaCha8Rng;
use robot::{SensingSide, TorqueSource};
use simulator::{EffortSource, PositionSide};

use crate::arms::make::Make;
use crate::corner::{ArmClass, EffortClass};
use crate::dice::{between, happens, one_of, weighted_index};
use crate::instruments::Instrument;

/// The loop of an arm and where its signals come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Electronics {
    /// Rate of the controller (Hz).
    pub control_rate_hz: f64,
    /// Rate of the log (Hz).
    pub log_rate_hz: f64,
    /// Corner of the low pass through which velocity is differenced (Hz).
    pub cutoff_hz: f64,
    /// What the effort is.
    pub effort: EffortClass,
    /// Where position is measured.
    pub position: PositionSide,
    /// Resolution of the encoders (bits a turn); that of the class where it is `None`.
    pub encoder_bits: Option<u8>,
}

impl Electronics {
    /// Draws the electronics of a class; what `instrument` states is as it states.
    pub(crate) fn draw(class: ArmClass, instrument: Instrument, random: &mut ChaCha8Rng) -> Self {
        let make = Make::of(class);
        let rates = make.rates;
        let even = vec![1.0; rates.len()];
        let [control_rate_hz, log_rate_hz] =
            rates.get(weighted_index(random, &even)).copied().unwrap_or([500.0; 2]);
        let [control_rate_hz, log_rate_hz] = match instrument.log_rate_hz {
            Some(rate) => [make.control_rate_hz(rate), rate],
            None => [control_rate_hz, log_rate_hz],
        };
        let [command, current] = match class {
            ArmClass::Hobby => [0.7, 0.3],
            ArmClass::Cobot => [0.1, 0.5],
            ArmClass::Industrial => [0.1, 0.9],
            ArmClass::Wam => [0.7, 0.3],
        };
        let effort = match weighted_index(random, &[command, current, 1.0 - command - current]) {
            0 => EffortClass::Command,
            1 => EffortClass::Current,
            _ => EffortClass::JointTorque,
        };
        let effort = instrument.effort.unwrap_or(effort);
        let at_link = match class {
            ArmClass::Hobby => 0.8,
            ArmClass::Cobot => 0.2,
            ArmClass::Industrial | ArmClass::Wam => 0.0,
        };
        let position = match happens(random, at_link) {
            true => PositionSide::Link,
            false => PositionSide::Motor,
        };
        let cutoff_hz = match class {
            ArmClass::Wam => 28.6,
            _ if control_rate_hz > 150.0 => one_of(random, [28.6, 40.0, 50.0]),
            _ => (between(random, [0.2, 0.3]) * control_rate_hz).round(),
        };
        let encoder_bits = instrument.encoder_bits;
        Self { control_rate_hz, log_rate_hz, cutoff_hz, effort, position, encoder_bits }
    }

    /// Time by which velocity reaches the motors late (s): the hold, the difference and the low pass.
    pub(crate) fn lag_s(&self) -> f64 {
        1.5 / self.control_rate_hz + 1.0 / (std::f64::consts::TAU * self.cutoff_hz)
    }

    /// What `robot.toml` says of the efforts.
    pub(crate) fn torque_source(&self) -> TorqueSource {
        match self.effort {
            EffortClass::Command => TorqueSource::Commanded,
            EffortClass::Current => TorqueSource::Current,
            EffortClass::JointTorque => TorqueSource::Measured,
        }
    }

    /// What `robot.toml` says of the positions.
    pub(crate) fn sensing(&self) -> SensingSide {
        match self.position {
            PositionSide::Motor => SensingSide::Motor,
            PositionSide::Link => SensingSide::Link,
        }
    }

    /// What a log has for effort.
    pub(crate) fn effort_source(&self) -> EffortSource {
        match self.effort {
            EffortClass::Command => EffortSource::Commanded,
            EffortClass::Current => EffortSource::Motor,
            EffortClass::JointTorque => EffortSource::Link,
        }
    }
}
