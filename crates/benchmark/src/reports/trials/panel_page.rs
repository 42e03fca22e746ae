use askama::Template;
use pages::{Provenance, ReportError, escape_json, render_page};

use crate::reports::trials::corner_figure::corner_figure;
use crate::reports::trials::table::table;
use crate::tables::merged_panel::MergedPanel;
use crate::trials::failure::Failure;
use crate::trials::kind_count::KindCount;

#[derive(Template)]
#[template(path = "panel.html")]
struct Page<'a> {
    campaign: &'a str,
    sentence: String,
    doubts: &'a [String],
    failed: usize,
    corners: String,
    names: String,
    verdicts: String,
    predictions: String,
    costs: String,
    by_hand: String,
    answers: String,
    kinds: String,
    sizes: String,
    strangers: String,
    spoilings: String,
    slowest: String,
    counts: String,
    failures: &'a [Failure],
    provenance: &'a Provenance,
    json: String,
}

/// `report.html` of a campaign in one file that opens offline and without scripts. It shows, corner by
/// corner and beside plain least squares, how well causes are named, the false assurances, and the predictions with the
/// findings.
///
/// `doubts` are sentences about what is missing.
///
/// # Errors
///
/// [`ReportError::Format`].
pub fn panel_page(
    merged: &MergedPanel,
    doubts: &[String],
    provenance: &Provenance,
) -> Result<String, ReportError> {
    let json = serde_json::to_string_pretty(merged)
        .map_err(|e| ReportError::Format { format: "JSON", reason: e.to_string() })?;
    let [
        names,
        verdicts,
        predictions,
        costs,
        by_hand,
        answers,
        kinds,
        sizes,
        strangers,
        spoilings,
        slowest,
    ] = merged.tally.tables();
    render_page(&Page {
        campaign: merged.campaign.get(..8).unwrap_or(&merged.campaign),
        sentence: sentence(merged),
        doubts,
        failed: merged.counts.last().map_or(0, |all| all.failed),
        corners: corner_figure(&merged.tally)?,
        names: table(names)?,
        verdicts: table(verdicts)?,
        predictions: table(predictions)?,
        costs: table(costs)?,
        by_hand: table(by_hand)?,
        answers: table(answers)?,
        kinds: table(kinds)?,
        sizes: table(sizes)?,
        strangers: table(strangers)?,
        spoilings: table(spoilings)?,
        slowest: table(slowest)?,
        counts: table(KindCount::table(&merged.counts))?,
        failures: &merged.failures,
        provenance: &provenance.without_folders(),
        json: escape_json(&json),
    })
}

/// How well all trials were answered, in a sentence.
fn sentence(merged: &MergedPanel) -> String {
    let Some(all) = merged.tally.rows.first() else {
        return "No trial has a score".to_owned();
    };
    let per_cent = |value: Option<f64>| {
        value.map_or("none".to_owned(), |value| format!("{:.0} %", 100.0 * value))
    };
    format!(
        "{} of findings are true, {} of visible causes are named; false assurance in {} of {} trials",
        per_cent(all.named.precision.value),
        per_cent(all.named.recall.value),
        all.false_assurance.count,
        all.false_assurance.of
    )
}

#[cfg(test)]
mod tests {
    use crate::alarms::alarm_ledger::AlarmLedger;
    use crate::tables::merged_panel::PANEL_SCHEMA;
    use crate::tables::panel_tally::PanelTally;

    use super::*;

    #[test]
    fn no_trial_at_all_is_still_a_page() {
        let merged = MergedPanel {
            schema: PANEL_SCHEMA,
            campaign: "0123456789abcdef".to_owned(),
            counts: Vec::new(),
            failures: Vec::new(),
            tally: PanelTally::of(&[]),
            alarms: AlarmLedger::of(&[]),
        };
        let provenance = Provenance {
            program: "plumbline",
            version: "0",
            command: vec!["plumbline".to_owned()],
            files: Vec::new(),
            seed: None,
        };
        let page = panel_page(&merged, &["3 trials are left".to_owned()], &provenance).unwrap();
        assert!(
            page.contains("No trial has a score") && page.contains("<li>3 trials are left</li>")
        );
    }
}
