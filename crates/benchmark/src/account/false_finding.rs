use diagnosis::{LookedFor, PlaceAccount};
use population::TruthSheet;

use crate::account::loss_stage::LossStage;
use crate::account::lost_name::{LostName, NameError};
use crate::account::missed_cause::stage_of_test;

/// A stranger that an oracle sees may pass for any cause.
pub(super) fn stage_of_strangers(sheet: &TruthSheet) -> Option<(LossStage, String)> {
    let stranger = sheet.strangers.iter().find(|s| s.strength.visible())?;
    Some((LossStage::Judge, format!("beside an effect of no catalogue, {}", stranger.name)))
}

/// The stage that would have kept a false finding out, had the search known the true names; `lost` are the missed
/// causes of the trial.
pub(super) fn stage_of_finding(place: &PlaceAccount, lost: &[LostName]) -> (LossStage, String) {
    if place.looked_for != LookedFor::ByColumns {
        return (LossStage::Line, "a line of the spectrum or a limit".to_owned());
    }
    let is_in_its_place =
        |other: &&LostName| other.error == NameError::Missed && other.takers.contains(&place.at);
    if let Some(missed) = lost.iter().find(is_in_its_place) {
        return (LossStage::OtherName, format!("in the place of {}", missed.at.words()));
    }
    match (place.beside_truth, place.with_known_noise) {
        (Some(truth), _) if !truth.passes() => stage_of_test(truth, LossStage::FoundNames),
        (Some(_), Some(known)) if !known.is_evident() => {
            stage_of_test(known, LossStage::KnownNoise)
        }
        (Some(truth), _) => {
            let words = format!("evidence {:.1} beside all true names", truth.evidence);
            (LossStage::TrueNames, words)
        }
        (None, _) => (LossStage::FoundNames, "nothing can be fitted beside the truth".to_owned()),
    }
}
