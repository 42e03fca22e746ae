use schemars::{Schema, schema_for};

use crate::robot_toml::description::Description;

/// The JSON schema of `robot.toml`, with what every key means and the constant defaults.
pub fn description_schema() -> Schema {
    schema_for!(Description)
}
