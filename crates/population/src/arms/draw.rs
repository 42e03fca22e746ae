use rand_chacha::ChaCha8Rng;

use crate::arms::arm::SampledArm;
use crate::arms::{generated, wam};
use crate::corner::ArmClass;
use crate::error::PopulationError;
use crate::instruments::Instrument;

impl SampledArm {
    /// An arm of a class, read with an instrument; a generated one has so many joints.
    pub(crate) fn draw(
        class: ArmClass,
        count: usize,
        instrument: Instrument,
        random: &mut ChaCha8Rng,
    ) -> Result<Self, PopulationError> {
        match class {
            ArmClass::Wam => wam::draw(instrument, random),
            ArmClass::Hobby | ArmClass::Cobot | ArmClass::Industrial => {
                generated::draw(class, count, instrument, random)
            }
        }
    }
}
