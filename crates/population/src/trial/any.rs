use std::path::Path;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use crate::corner::Origin;
use crate::error::PopulationError;
use crate::recorded::trial::{RecordedTrial, draw_recorded_trial, read_recorded_split};
use crate::sheet::TruthSheet;
use crate::spec::{PopulationSpec, RecordedSpec};
use crate::trial::make::{make, write_runs};

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
    write_recorded(&draw_recorded_trial(&recorded.data, origin, seed, &mut random)?, folder)
}

/// Makes the files of unchanged recorded logs in a folder, with the held-out part of number `number` of all that
/// [`count_recorded_splits`](crate::count_recorded_splits) counts. They are those of [`make_any`].
///
/// # Errors
///
/// As [`read_recorded_split`], and errors of writing.
pub fn make_recorded_split(
    data: &Path,
    number: usize,
    folder: &Path,
) -> Result<TruthSheet, PopulationError> {
    let trial = read_recorded_split(data, number)?;
    write_recorded(&trial, folder)?;
    Ok(trial.sheet)
}

fn write_recorded(trial: &RecordedTrial, folder: &Path) -> Result<(), PopulationError> {
    let nominal = folder.join("nominal");
    std::fs::create_dir_all(&nominal).map_err(PopulationError::of_folder(&nominal))?;
    trial.robot.write(&nominal)?;
    write_runs(&folder.join("logs"), &trial.runs)?;
    write_runs(&folder.join("held_out"), &trial.held_out)?;
    trial.sheet.write(folder)
}
