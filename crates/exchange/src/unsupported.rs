use crate::fate::Fate;
use crate::quantity::DriveQuantity;

/// Why a format has no place for a quantity that only the models of this program know.
pub(crate) fn fate_of_unsupported(quantity: DriveQuantity) -> Fate {
    use DriveQuantity as Q;
    Fate::omit(match quantity {
        Q::Stribeck => "dry friction of the format has one level at all speeds",
        Q::LoadFriction => "dry friction of the format has one level at all loads",
        Q::Presliding => "dry friction of the format is there at once",
        Q::FrictionWave => "dry friction of the format has one level at all positions",
        Q::Warming => {
            "friction of the format is the same at all times; what is written is that of the cold drive"
        }
        Q::Ripple => "torque of the format does not depend on the motor's position",
        Q::Counterbalance => "springs of the format are linear in the position",
        Q::SpringHysteresis => "springs of the format have no loop",
        Q::Ratio => "divide positions by it before they are compared",
        Q::Skew => "it is one of the log: move its efforts by as much",
        Q::GoalDelay => "send goals to the simulated servos later by as much",
        Q::Loop => "the format has no position loops: export --to actuator writes this one",
        Q::GoalHold => "send goals to the simulated servos as seldom",
        Q::EffortGain => "it is one of the log: divide its efforts by it",
        Q::EffortOffset => "it is one of the log: subtract it from its efforts",
        Q::Delay | Q::Lag => "the format has no actuators with a memory",
        Q::Rotor => "the format has no rotors: give it to the simulator itself",
        Q::Backlash => "joints of the format have no play",
        Q::Elasticity => "transmissions of the format are rigid",
        Q::Coupling => "friction of the format belongs to one joint",
        Q::Asymmetry => "the mean of both directions is written",
        Q::Spring | Q::SpringCubic => "joints of the format have no such springs",
        Q::Viscous | Q::Coulomb | Q::EncoderOffset => "the format has no place for it",
    })
}
