//! Every number that decides an answer: one field a meaning, with unit, reason and the figure that it rests on.

pub(crate) mod blocks;
pub(crate) mod limits;
pub(crate) mod readiness;
pub(crate) mod search;
pub(crate) mod signals;
pub(crate) mod sizes;
pub(crate) mod springs;
pub(crate) mod tones;
pub(crate) mod verdict;

use effects::Priors;
use inspection::InspectionThresholds;

use crate::thresholds::blocks::BlockThresholds;
use crate::thresholds::limits::LimitThresholds;
use crate::thresholds::readiness::ReadinessThresholds;
use crate::thresholds::search::SearchThresholds;
use crate::thresholds::signals::SignalThresholds;
use crate::thresholds::sizes::SizeThresholds;
use crate::thresholds::springs::SpringThresholds;
use crate::thresholds::tones::ToneThresholds;
use crate::thresholds::verdict::VerdictThresholds;

/// The numbers that decide an answer, grouped by the step that they belong to.
///
/// "Trials" in the documentation of a field are stored trials of the panel (`scenarios/campaigns/panel.toml`): the
/// same logs with and without the change. Where fields have equal values, each has its own reason.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Thresholds {
    /// Prior sizes of every effect.
    pub priors: Priors,
    /// What is wrong with logs as a whole.
    pub inspection: InspectionThresholds,
    /// What the logs must have to be used.
    pub readiness: ReadinessThresholds,
    /// Which samples are informative about a joint, and which runs repeat a motion.
    pub signals: SignalThresholds,
    /// Which trial springs joint elasticity has.
    pub springs: SpringThresholds,
    /// How logs are cut into blocks, and blocks into folds.
    pub blocks: BlockThresholds,
    /// Lines of the spectrum.
    pub tones: ToneThresholds,
    /// Limits of the efforts.
    pub limits: LimitThresholds,
    /// Which hypotheses become findings.
    pub search: SearchThresholds,
    /// How well a size is known.
    pub sizes: SizeThresholds,
    /// What the residual of a joint means.
    pub verdict: VerdictThresholds,
}
