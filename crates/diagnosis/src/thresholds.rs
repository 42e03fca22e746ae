//! Every number that decides an answer, a field a meaning, with its unit, its reason and the figure that it rests on.

pub(crate) mod blocks;
pub(crate) mod limits;
pub(crate) mod readiness;
pub(crate) mod search;
pub(crate) mod signals;
pub(crate) mod sizes;
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
use crate::thresholds::tones::ToneThresholds;
use crate::thresholds::verdict::VerdictThresholds;

/// The numbers that decide an answer, grouped by the step that they belong to.
///
/// "Trials" in the documentation of a field are stored trials of the panel (`scenarios/campaigns/panel.toml`), the same logs
/// with and without the change. Fields that have the same value have it for reasons of their own.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Thresholds {
    /// What is assumed of the size of every effect before any log.
    pub priors: Priors,
    /// What is wrong with logs as a whole.
    pub inspection: InspectionThresholds,
    /// What logs can be asked for.
    pub readiness: ReadinessThresholds,
    /// Which samples speak of a joint, and which runs repeat a motion.
    pub signals: SignalThresholds,
    /// How logs are cut into blocks, and these into parts that are held out.
    pub blocks: BlockThresholds,
    /// Lines of the spectrum.
    pub tones: ToneThresholds,
    /// Limits of the efforts.
    pub limits: LimitThresholds,
    /// Which hypotheses become findings.
    pub search: SearchThresholds,
    /// How well a size is known.
    pub sizes: SizeThresholds,
    /// What is left at a joint, and what it means.
    pub verdict: VerdictThresholds,
}
