use std::path::Path;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use crate::corner::Origin;
use crate::error::PopulationError;
use crate::recorded::trial::draw_recorded_trial;
use crate::spec::{PopulationSpec, RecordedSpec};
use crate::trial::make::make;

/// Makes the files of a trial of any origin in a folder, creating it where it is absent. They are those of
/// [`make`], without `truth` for recorded logs.
///
/// # Errors
///
/// As [`make`] and [`draw_recorded_trial`].
pub fn make_any(
    spec: &PopulationSpec,
    origin: Origin,
    seed: u64,
    folder: &Path,
) -> Result<(), PopulationError> {
    std::fs::create_dir_all(folder).map_err(PopulationError::of_folder(folder))?;
    match (origin, &spec.recorded) {
        (Origin::Simulated, _) | (_, None) => make(spec, seed, folder).map(|_| ()),
        (_, Some(recorded)) => make_recorded_trial(recorded, origin, seed, folder),
    }
}

fn make_recorded_trial(
    recorded: &RecordedSpec,
    origin: Origin,
    seed: u64,
    folder: &Path,
) -> Result<(), PopulationError> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    draw_recorded_trial(&recorded.data, origin, seed, &mut random)?.write(folder)
}
