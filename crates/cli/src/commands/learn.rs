pub(crate) mod arguments;
pub(super) mod benchmark;
mod compare;
mod data;
mod peers;
mod regressor_kernel;
mod row;
mod timing;

use self::arguments::Arguments;
use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::output::refuse_file;
use crate::progress::Line;
use crate::watch::Watch;

/// Learns models and compares them on the logs of `--test`, or times them.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    arguments.out.as_deref().map_or(Ok(()), refuse_file)?;
    let loaded = arguments.robot.load()?;
    let watch = Watch::new((!arguments.quiet).then(Line::new))?;
    if arguments.benchmark {
        benchmark::run(arguments, &loaded, &watch)
    } else {
        compare::run(arguments, &loaded, &watch)
    }
}
