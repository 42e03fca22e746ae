use askama::Template;
use pages::{Provenance, ReportError, escape_json, render_page};

use crate::reports::trials::confusion_figure::confusion_figure;
use crate::reports::trials::table::table;
use crate::tables::merged::Merged;
use crate::tables::tally::TrialGroup;
use crate::trials::failure::Failure;
use crate::trials::kind_count::KindCount;

#[derive(Template)]
#[template(path = "trials.html")]
struct Page<'a> {
    campaign: &'a str,
    sentence: String,
    doubts: &'a [String],
    failed: usize,
    confusion: String,
    shares: String,
    powers: String,
    gained: String,
    sizes: String,
    counts: String,
    failures: &'a [Failure],
    provenance: &'a Provenance,
    json: String,
}

/// `report.html` of blind trials in one file that opens offline and without scripts: the findings against the
/// injected effects, the share of right ones, and the errors of the sizes.
///
/// `doubts` are sentences about what is missing.
///
/// # Errors
///
/// [`ReportError::Format`].
pub fn trials_page(
    merged: &Merged,
    doubts: &[String],
    provenance: &Provenance,
) -> Result<String, ReportError> {
    let json = serde_json::to_string_pretty(merged)
        .map_err(|e| ReportError::Format { format: "JSON", reason: e.to_string() })?;
    let [shares, sizes] = merged.tally.tables();
    render_page(&Page {
        campaign: merged.campaign.get(..8).unwrap_or(&merged.campaign),
        sentence: sentence(merged),
        doubts,
        failed: merged.counts.last().map_or(0, |all| all.failed),
        confusion: confusion_figure(&merged.tally.confusion())?,
        shares: table(shares)?,
        powers: table(merged.powers())?,
        gained: merged.gain_table().map_or_else(|| Ok(String::new()), table)?,
        sizes: table(sizes)?,
        counts: table(KindCount::table(&merged.counts))?,
        failures: &merged.failures,
        provenance: &provenance.without_folders(),
        json: escape_json(&json),
    })
}

/// How well the largest groups were diagnosed, in a sentence.
fn sentence(merged: &Merged) -> String {
    let of = |group| merged.tally.rows.iter().find(|row| row.injected == group);
    let one = of(TrialGroup::One).map(|row| {
        format!("one hidden effect is named exactly {} of {} times", row.exactly.count, row.trials)
    });
    let two = of(TrialGroup::Two)
        .map(|row| format!("two hidden effects are {} of {} times", row.exactly.count, row.trials));
    let clean = of(TrialGroup::Clean).map(|row| {
        let made_up = row.trials - row.exactly.count.min(row.trials);
        format!("something is made up in {made_up} of {} clean arms", row.trials)
    });
    let parts: Vec<String> = [one, two, clean].into_iter().flatten().collect();
    let text = parts.join("; ");
    let mut letters = text.chars();
    match letters.next() {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => "No trial has a score".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use crate::statistics::share::Share;
    use crate::tables::gained::{Gained, Reduction};
    use crate::tables::merged::MERGED_SCHEMA;
    use crate::tables::power::{Power, SizeClass};
    use crate::tables::tally::{Tally, TallyRow};
    use catalogue::EffectKind::{Backlash, CoulombFriction};

    use super::*;

    fn row(injected: TrialGroup, count: usize, named: &[(&'static str, usize)]) -> TallyRow {
        let share = Share::new(count, 4);
        TallyRow {
            injected,
            trials: 4,
            exactly: share,
            visibly: share,
            as_one_of: share,
            found: share,
            unknown: share,
            stray: share,
            named_first: named.iter().copied().collect(),
            sizes: Vec::new(),
        }
    }

    fn example_results() -> Merged {
        let kind = TrialGroup::Kind;
        let count = |hidden: &str| KindCount {
            hidden: hidden.to_owned(),
            made: 4,
            failed: 1,
            broken: 0,
            left: 0,
        };
        let class = SizeClass { sizes: [0.0002, 0.003], exactly: Share::new(3, 4) };
        Merged {
            schema: MERGED_SCHEMA,
            campaign: "0123456789abcdef".to_owned(),
            counts: ["backlash", "clean", "all"].map(count).to_vec(),
            failures: vec![Failure {
                hidden: "backlash".to_owned(),
                error: "</script><img>".to_owned(),
                seeds: vec![7],
            }],
            tally: Tally {
                rows: vec![
                    row(kind(CoulombFriction), 4, &[("FR02", 4)]),
                    row(kind(Backlash), 2, &[("TR01", 2), ("FR02", 1), ("nothing", 1)]),
                    row(TrialGroup::One, 3, &[]),
                    row(TrialGroup::Clean, 4, &[("nothing", 4)]),
                ],
            },
            power: vec![Power {
                injected: kind(Backlash),
                parameter: "gap",
                unit: "rad",
                classes: vec![class],
            }],
            gained: vec![example_gain()],
        }
    }

    fn example_gain() -> Gained {
        let halved = Share::new(3, 4);
        let torque = Reduction { median: Some(11.7), least: Some(0.4), halved };
        let drift = Reduction { median: Some(2.0), ..torque.clone() };
        let tracking = Reduction { median: None, least: None, halved: Share::new(0, 0) };
        Gained { injected: TrialGroup::Kind(Backlash), trials: 4, torque, drift, tracking }
    }

    fn page(merged: &Merged, doubts: &[String]) -> String {
        let provenance = Provenance {
            program: "plumbline",
            version: "0",
            command: vec!["plumbline".to_owned()],
            files: Vec::new(),
            seed: None,
        };
        trials_page(merged, doubts, &provenance).unwrap()
    }

    #[test]
    fn the_page_is_self_contained_and_holds_figure_and_numbers() {
        let page = page(&example_results(), &["3 trials are left".to_owned()]);
        assert!(!page.contains("http://") && !page.contains("https://"));
        assert!(page.contains("default-src 'none'") && !page.contains("<script src"));
        assert_eq!(page.matches("<svg").count(), 1);
        for expected in [
            "One hidden effect is named exactly 3 of 4 times; something is made up in 0 of 4 clean",
            "<title>TR01 backlash: FR02 named first in 1 of 4</title>",
            "0.0002-0.003: 3/4",
            "12x (0.4x)",
            "3 of 4",
            "<li>3 trials are left</li><li>1 of the trials failed, ",
            "plumbline.trials/1",
        ] {
            assert!(page.contains(expected), "{expected} is missing");
        }
        assert_eq!(page.matches("</script>").count(), 2);
        assert!(!page.contains("<img>"));
    }

    #[test]
    fn no_trial_at_all_is_still_a_page() {
        let nothing =
            Merged { tally: Tally { rows: Vec::new() }, power: Vec::new(), ..example_results() };
        assert!(page(&nothing, &[]).contains("No trial has a score"));
    }
}
