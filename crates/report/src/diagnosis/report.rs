use pages::Provenance;

use crate::diagnosis::input_options::InputOptions;
use crate::diagnosis::residual::ResidualModel;

/// Everything that a report shows.
#[derive(Debug, Clone, Copy)]
pub struct Report<'a> {
    /// The answer.
    pub diagnosis: &'a diagnosis::Diagnosis,
    /// The signals behind it, one entry a run.
    pub traces: &'a [diagnosis::RunTraces],
    /// The robot as it was given, for units and for the joint of a link.
    pub robot: &'a robot::Robot,
    /// The model of the error that the findings leave, where one was learned.
    pub residual: Option<&'a ResidualModel>,
    /// How far simulations drift from the logs, where that was measured.
    pub forward: Option<&'a experiment::ForwardGap>,
    /// The extended robot in the formats of other programs, with the fate of every quantity.
    pub descriptions: &'a [(exchange::Format, exchange::Export)],
    /// How robot and logs were read, where another command is to know it.
    pub input: Option<&'a InputOptions>,
    /// Where the answer comes from.
    pub provenance: &'a Provenance,
}

impl<'a> Report<'a> {
    /// What a diagnosis of logs of `robot` came to, and no more.
    pub fn new(
        outcome: &'a diagnosis::DiagnosisRun,
        robot: &'a robot::Robot,
        provenance: &'a Provenance,
    ) -> Self {
        let diagnosis::DiagnosisRun { diagnosis, traces, .. } = outcome;
        Self {
            diagnosis,
            traces,
            robot,
            residual: None,
            forward: None,
            descriptions: &[],
            input: None,
            provenance,
        }
    }
}
