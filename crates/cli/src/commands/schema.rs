use schemars::schema_for;
use simulator::scenario::ScenarioSpec;

use crate::Outcome;
use crate::error::CliError;
use crate::output::print_json;

/// Prints the JSON schema of scenario files, which editors complete and check keys with.
pub fn run() -> Result<Outcome, CliError> {
    print_json(&schema_for!(ScenarioSpec))?;
    Ok(Outcome::Good)
}
