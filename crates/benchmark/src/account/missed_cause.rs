use std::f64::consts::TAU;

use catalogue::EffectKind;
use diagnosis::{LookedFor, PlaceAccount, PlaceTest, SearchAccount, SearchFate, Taker};
use population::{Strength, TrueCause, TruthSheet};

use crate::account::loss_stage::LossStage;
use crate::account::oracle_noise::OracleEffortNoise;
use crate::panel::judged_finding::JudgedFinding;
use crate::panel::judgement::Judgement;

/// Forms of dry friction whose findings state the Coulomb friction of their joint too.
const FORMS: [EffectKind; 3] = [
    EffectKind::StribeckFriction,
    EffectKind::PreslidingFriction,
    EffectKind::PositionDependentFriction,
];

/// How the name of a stranger begins that is a fault of a logger.
const OF_A_LOGGER: &str = "log: ";

/// The stage that loses a cause before the search is asked: the trial's logs are no measure of it.
pub(super) fn stage_of_logs(
    sheet: &TruthSheet,
    judgement: &Judgement,
) -> Option<(LossStage, String)> {
    let spoilt = sheet.strangers.iter().find(|s| s.name.starts_with(OF_A_LOGGER));
    let spoilt = spoilt.map(|stranger| format!("the logs are spoilt, {}", stranger.name));
    let refused = || judgement.refused.as_ref().map(|why| format!("the logs are refused: {why}"));
    Some((LossStage::Judge, spoilt.or_else(refused)?))
}

/// Coulomb friction inside another form of dry friction that is named at its joint.
pub(super) fn stage_of_forms(
    cause: &TrueCause,
    judgement: &Judgement,
) -> Option<(LossStage, String)> {
    let has = |kind: EffectKind| {
        let at = |f: &&JudgedFinding| f.at.effect == kind && f.at.joint == cause.truth.joint;
        judgement.findings.iter().find(at)
    };
    let is_coulomb = cause.truth.effect == EffectKind::CoulombFriction;
    let form = FORMS.into_iter().filter(|_| is_coulomb).find_map(has)?;
    Some((LossStage::Judge, format!("it is inside {}", form.at.words())))
}

/// The stage that loses a cause, by what became of its place. A cause is below the real noise where the oracle's noise
/// of the efforts, scaled to the known one, leaves it too few deviations, and the search beside the true names with the
/// known noise does not show it either.
pub(super) fn stage_of_cause(
    (sheet, cause): (&TruthSheet, &TrueCause),
    oracle: &OracleEffortNoise,
    account: &SearchAccount,
    place: &PlaceAccount,
) -> (LossStage, String) {
    let real = cause.strength.sigmas * share_of_known((sheet, cause), oracle, account);
    let is_shown = |known: PlaceTest| known.sigmas >= Strength::SIGMAS;
    if real < Strength::SIGMAS && !place.with_known_noise.is_some_and(is_shown) {
        let words = format!("{real:.1} sigmas with the noise that the efforts have");
        return (LossStage::Judge, words);
    }
    match &place.looked_for {
        LookedFor::Nowhere(reason) => (LossStage::NoHypothesis, reason.clone()),
        LookedFor::AsLine => stage_of_line(cause, account),
        LookedFor::ByColumns => stage_of_search(place),
    }
}

/// The largest share of the known noise that the oracle counts, over the joints that the cause acts on: its own, or
/// for a link all of them.
fn share_of_known(
    (sheet, cause): (&TruthSheet, &TrueCause),
    oracle: &OracleEffortNoise,
    account: &SearchAccount,
) -> f64 {
    let is_own = |name: &String| cause.truth.joint.as_ref().is_none_or(|joint| joint == name);
    let joints = sheet.joints.iter().enumerate().filter(|(_, name)| is_own(name));
    let shares = joints.map(|(j, _)| oracle.share_of_known(j, account));
    shares
        .fold(None, |most: Option<f64>, share| Some(most.map_or(share, |m| m.max(share))))
        .unwrap_or(1.0)
}

/// A line is looked for in a band.
fn stage_of_line(cause: &TrueCause, account: &SearchAccount) -> (LossStage, String) {
    let Some([_, highest]) = account.lines_hz else {
        return (LossStage::OutsideTheBand, "the logs are too slow for lines".to_owned());
    };
    let Some(hz) = frequency_hz(cause, account) else {
        return (LossStage::Line, "it was not found".to_owned());
    };
    if hz > highest {
        let words = format!("{hz:.1} Hz, lines are looked for up to {highest:.1} Hz");
        (LossStage::OutsideTheBand, words)
    } else {
        (LossStage::Line, format!("{hz:.1} Hz, in the band of lines up to {highest:.1} Hz"))
    }
}

/// Frequency of a tone (Hz); of a ripple that at the RMS velocity of its joint.
fn frequency_hz(cause: &TrueCause, account: &SearchAccount) -> Option<f64> {
    let value = |name: &str| cause.truth.parameters.get(name).copied();
    match cause.truth.effect {
        EffectKind::ExternalDisturbance => value("frequency"),
        EffectKind::TorqueRipple => {
            let joint = account.joints.iter().find(|j| Some(&j.name) == cause.truth.joint.as_ref());
            Some(value("periods_per_turn")? * joint?.speed / TAU)
        }
        _ => None,
    }
}

/// The stage of the search at which a hypothesis was lost.
fn stage_of_search(place: &PlaceAccount) -> (LossStage, String) {
    match &place.fate {
        SearchFate::SizeVaries(with) => (LossStage::SizeVaries, format!("with the {with}")),
        SearchFate::Kept => (
            LossStage::HeldOut,
            "found, but its joint is predicted worse or it is too small to matter".to_owned(),
        ),
        SearchFate::Dropped => {
            (LossStage::OtherName, "found, and dropped for a twin or plainer names".to_owned())
        }
        SearchFate::NotFound => match place.beside_truth {
            Some(truth) if truth.passes() => stage_beside_found(place),
            truth => stage_beside_truth(place.with_known_noise, truth),
        },
    }
}

/// A hypothesis that passes every test beside the true names.
fn stage_beside_found(place: &PlaceAccount) -> (LossStage, String) {
    let words = |taker: &Taker| format!("{} does its work", taker.at.words());
    if let Some(taker) = place.takers.iter().find(|t| t.excludes || t.is_exchanged) {
        return (LossStage::OtherName, words(taker));
    }
    if let Some(taker) = place.takers.first() {
        return (LossStage::Exchange, words(taker));
    }
    match place.beside_found {
        Some(found) if !found.passes() => stage_of_test(found, LossStage::FoundNames),
        _ => (LossStage::Exchange, "the search ended without it".to_owned()),
    }
}

/// A hypothesis that fails a test beside the true names.
fn stage_beside_truth(known: Option<PlaceTest>, truth: Option<PlaceTest>) -> (LossStage, String) {
    match (known, truth) {
        (Some(known), _) if !known.passes() => stage_of_test(known, LossStage::KnownNoise),
        (_, Some(truth)) if truth.is_evident() => stage_of_test(truth, LossStage::TrueNames),
        (_, Some(truth)) => {
            let words = format!("evidence {:.1}", truth.evidence);
            (LossStage::TrueNames, words)
        }
        _ => (LossStage::TrueNames, "nothing can be fitted beside them".to_owned()),
    }
}

/// The first test that fails; `evidence` is the stage of too little evidence.
pub(super) fn stage_of_test(test: PlaceTest, evidence: LossStage) -> (LossStage, String) {
    if !test.is_evident() {
        let PlaceTest { evidence: gain, least_evidence, sigmas, .. } = test;
        (evidence, format!("evidence {gain:.1} of {least_evidence:.0}, {sigmas:.1} sigmas"))
    } else if !test.is_possible {
        (LossStage::Physical, "its best size is held impossible".to_owned())
    } else {
        let fall = test.fall;
        (LossStage::HeldOut, format!("it lowers the held-out error by {fall:.2} of what counts"))
    }
}
