use serde::Serialize;

use crate::panel::judgement::Judgement;
use crate::panel::panel_side::PanelSide;
use crate::tables::kind_row::KindRow;
use crate::tables::panel_row::PanelRow;
use crate::tables::slow_diagnosis::SlowDiagnosis;
use crate::tables::spoiling_row::SpoilingRow;
use crate::tables::stranger_row::StrangerRow;

/// Results of the trials of a campaign.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PanelTally {
    /// All trials, then those by arm, origin, motion, effort, encoder, number of visible causes, number of logs, by
    /// whether runs repeat, and by what of robots in use they have.
    pub rows: Vec<PanelRow>,
    /// Causes by kind.
    pub kinds: Vec<KindRow>,
    /// Effects of no catalogue by name.
    pub strangers: Vec<StrangerRow>,
    /// Spoilt logs by what spoils them.
    pub spoilings: Vec<SpoilingRow>,
    /// The diagnoses that took longest.
    pub slowest: Vec<SlowDiagnosis>,
}

impl PanelTally {
    /// The tally of some judgements, whatever their order.
    pub fn of(judgements: &[Judgement]) -> Self {
        let mut sorted = judgements.to_vec();
        sorted.sort_by_key(|judgement| judgement.seed);
        let sides = PanelSide::by_side(&sorted);
        Self {
            rows: sides.into_iter().map(|(side, own)| PanelRow::new(side, &own)).collect(),
            kinds: KindRow::all(&sorted),
            strangers: StrangerRow::all(&sorted),
            spoilings: SpoilingRow::all(&sorted),
            slowest: SlowDiagnosis::all(&sorted),
        }
    }
}
