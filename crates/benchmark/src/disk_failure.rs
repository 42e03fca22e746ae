use document::DocumentError;
use experiment::ExperimentError;
use logs::{FormatError, LogError};
use population::PopulationError;
use robot::RobotError;
use simulator::SimulatorError;

use crate::error::BenchmarkError;

/// Whether the disk failed: a file that cannot be written or read says nothing of the trial.
pub(crate) fn is_of_the_disk(error: &BenchmarkError) -> bool {
    use BenchmarkError as B;
    use ExperimentError as E;
    use PopulationError as P;
    match error {
        B::TrialFolder { .. } => true,
        B::Experiment(error) => match &**error {
            E::Stage { .. } | E::UnreadableTruth { .. } => true,
            E::Log(log) => is_of_a_log(log),
            E::Robot(robot) => is_of_a_robot(robot),
            E::Document(document) => is_of_a_document(document),
            E::Simulator(error) => is_of_a_simulation(error),
            _ => false,
        },
        B::Population(error) => match &**error {
            P::Folder { .. } => true,
            P::Log(log) => is_of_a_log(log),
            P::Robot(robot) => is_of_a_robot(robot),
            P::Document(document) => is_of_a_document(document),
            P::Simulator(error) => is_of_a_simulation(error),
            _ => false,
        },
        _ => false,
    }
}

fn is_of_a_log(error: &LogError) -> bool {
    use FormatError as F;
    use LogError as L;
    // A decoder that cannot read on calls the file broken.
    matches!(error, L::Unwritable { .. } | L::File(F::Unreadable { .. } | F::Broken { .. }))
}

fn is_of_a_robot(error: &RobotError) -> bool {
    matches!(error, RobotError::Unreadable { .. })
}

fn is_of_a_document(error: &DocumentError) -> bool {
    matches!(error, DocumentError::Unreadable { .. })
}

fn is_of_a_simulation(error: &SimulatorError) -> bool {
    match error {
        SimulatorError::Log(log) => is_of_a_log(log),
        SimulatorError::Scenario(document) => is_of_a_document(document),
        _ => false,
    }
}
