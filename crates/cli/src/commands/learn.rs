pub(crate) mod arguments;
pub(super) mod benchmark;
mod compare;
mod data;
mod peers;
mod regressor_kernel;
mod row;
mod timing;

use report::ReportError;

use self::arguments::Arguments;
use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::progress::Line;
use crate::watch::Watch;

/// Learns models and compares them on the logs of `--test`, or times them.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    if let Some(out) = arguments.out.as_deref().filter(|out| out.exists() && !out.is_dir()) {
        return Err(ReportError::NotAFolder { path: out.to_owned() }.into());
    }
    let loaded = arguments.part.load(&arguments.robot)?;
    let watch = Watch::new((!arguments.quiet).then(Line::new))?;
    if arguments.benchmark {
        benchmark::run(arguments, &loaded, &watch)
    } else {
        compare::run(arguments, &loaded, &watch)
    }
}
