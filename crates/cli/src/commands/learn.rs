pub(crate) mod arguments;
mod compare;
mod data;
mod row;
pub mod timing;

use self::arguments::Arguments;
use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::output::refuse_file;
use crate::progress::Line;
use crate::watch::Watch;

/// Learns models and compares them on the logs of `--test`.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let out = &arguments.out;
    refuse_file(out)?;
    let loaded = arguments.robot.load()?;
    let watch = Watch::new((!arguments.quiet).then(Line::new))?;
    compare::run(arguments, &loaded, &watch)
}
