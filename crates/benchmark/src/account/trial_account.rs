use std::path::Path;

use catalogue::EffectKind;
use diagnosis::{EffectAt, SearchAccount, Settings, account_for};
use population::{TrueCause, TruthSheet};
use serde::{Deserialize, Serialize};

use crate::account::false_finding::{stage_of_finding, stage_of_strangers};
use crate::account::lost_name::LostName;
use crate::account::missed_cause::{stage_of_cause, stage_of_forms, stage_of_logs};
use crate::account::oracle_noise::OracleEffortNoise;
use crate::error::BenchmarkError;
use crate::panel::judged_finding::JudgedFinding;
use crate::panel::judgement::Judgement;
use crate::panel::place::place;
use crate::panel::population_trial::nominal;
use crate::trial_folder::read_runs;

/// The missed visible causes and the false findings of one trial, each with the stage that loses it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TrialAccount {
    /// Missed causes, then false findings.
    pub lost: Vec<LostName>,
    /// Findings of the judgement that a search of the same logs does not find: another program has made it.
    pub not_found_again: Vec<String>,
}

impl TrialAccount {
    /// The account of a trial in a folder, whose answer was judged. Its logs are searched again where a name is lost
    /// in them.
    ///
    /// # Errors
    ///
    /// [`BenchmarkError`] when a file cannot be read or the logs cannot be searched.
    pub fn of_folder(folder: &Path, judgement: &Judgement) -> Result<Self, BenchmarkError> {
        let sheet = TruthSheet::open(folder)?;
        if let Some(account) = Self::of_logs(&sheet, judgement) {
            return Ok(account);
        }
        let oracle = OracleEffortNoise::read(folder, &sheet)?;
        let robot = nominal(folder)?;
        let runs = read_runs(&folder.join("logs"), &robot.robot)?;
        let settings = Settings { control_rate_hz: robot.control.rate_hz, ..Settings::default() };
        let truth: Vec<EffectAt> = sheet.causes.iter().map(place).collect();
        let places = lost_places(&sheet, judgement);
        let account = account_for(&robot.robot, &runs, &settings, &truth, &places)?;
        Ok(Self::of_search(&sheet, judgement, &oracle, &account))
    }

    /// The account of a trial without a search: nothing is lost, or its logs are spoilt or refused.
    pub fn of_logs(sheet: &TruthSheet, judgement: &Judgement) -> Option<Self> {
        let stage = stage_of_logs(sheet, judgement);
        let causes: Vec<&TrueCause> = missed_causes(sheet, judgement).collect();
        let findings: Vec<&JudgedFinding> = false_ones(judgement).collect();
        let lost = match stage {
            None if causes.is_empty() && findings.is_empty() => Vec::new(),
            None => return None,
            Some(stage) => {
                let missed = causes.into_iter().map(|cause| {
                    LostName::new(&place(cause), Some(cause.strength), stage.clone(), None)
                });
                let wrong =
                    findings.into_iter().map(|f| LostName::new(&f.at, None, stage.clone(), None));
                missed.chain(wrong).collect()
            }
        };
        Some(Self { lost, not_found_again: Vec::new() })
    }

    /// The account of a trial by a search of its logs, which was asked for every lost place.
    pub fn of_search(
        sheet: &TruthSheet,
        judgement: &Judgement,
        oracle: &OracleEffortNoise,
        account: &SearchAccount,
    ) -> Self {
        let asked = |at: &EffectAt| account.places.iter().find(|place| place.at == *at);
        let mut lost: Vec<LostName> = Vec::new();
        for cause in missed_causes(sheet, judgement) {
            let at = place(cause);
            let Some(place) = asked(&at) else { continue };
            let stage = stage_of_forms(cause, judgement)
                .unwrap_or_else(|| stage_of_cause((sheet, cause), oracle, account, place));
            lost.push(LostName::new(&at, Some(cause.strength), stage, Some(place)));
        }
        for finding in false_ones(judgement) {
            let Some(place) = asked(&finding.at) else { continue };
            let stage = stage_of_strangers(sheet).unwrap_or_else(|| stage_of_finding(place, &lost));
            lost.push(LostName::new(&finding.at, None, stage, Some(place)));
        }
        let is_new = |at: &&EffectAt| {
            at.effect != EffectKind::TorqueSaturation && !account.kept.contains(at)
        };
        let findings = judgement.findings.iter().map(|finding| &finding.at);
        let not_found_again = findings.filter(is_new).map(EffectAt::words).collect();
        Self { lost, not_found_again }
    }
}

/// The places of which a search is asked: those of missed causes and of false findings.
fn lost_places(sheet: &TruthSheet, judgement: &Judgement) -> Vec<EffectAt> {
    let findings = false_ones(judgement).map(|finding| finding.at.clone());
    missed_causes(sheet, judgement).map(place).chain(findings).collect()
}

/// The visible causes that no finding names.
fn missed_causes<'a>(
    sheet: &'a TruthSheet,
    judgement: &'a Judgement,
) -> impl Iterator<Item = &'a TrueCause> {
    let lost = judgement.visible().filter(|cause| !cause.is_named());
    lost.filter_map(|lost| sheet.causes.iter().find(|cause| place(cause) == lost.at))
}

/// The findings that are not true, where all causes are known.
fn false_ones(judgement: &Judgement) -> impl Iterator<Item = &JudgedFinding> {
    judgement.findings.iter().filter(|f| judgement.is_all_known() && !f.is_true)
}
