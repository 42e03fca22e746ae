mod page;
mod rows;

use std::collections::BTreeMap;

use anstyle::Style;
use catalogue::{EffectEntry, Family};
use schemars::{JsonSchema, Schema};
use serde::Serialize;

use self::rows::{EffectRow, rows};
use crate::effect_facts::{facts, meaning};
use crate::effect_name::find_effect;
use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::output::{print, print_json, table};

/// Columns of the values on the page.
const WIDTH: usize = 79;

/// Name and version of the schema of what `--json` prints of all effects.
const SCHEMA: &str = "plumbline.effects/1";

/// The same of one effect.
const SCHEMA_OF_ONE: &str = "plumbline.effect/1";

/// Arguments of `explain`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Code or name of the effect, such as FR02 or coulomb_friction; all are listed where it is left out
    effect: Option<String>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Print a page in Markdown with all that is known of every effect
    #[arg(long, conflicts_with_all = ["json", "effect"])]
    markdown: bool,
}

/// Prints what is known about one effect; without one, the list of all, family by family.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    match &arguments.effect {
        Some(name) => {
            let entry = find_effect(name)?.entry();
            match arguments.json {
                true => print_json(&Effect::new(entry))?,
                false => print(&explanation(entry, Style::new().bold()))?,
            }
        }
        None if arguments.json => {
            print_json(&Effects { schema: SCHEMA, effects: rows() })?;
        }
        None if arguments.markdown => print(&page::page(&rows()))?,
        None => print(&list())?,
    }
    Ok(ExitStatus::Good)
}

/// The JSON schema of what `--json` prints of all effects.
pub fn schema() -> Schema {
    report::written_schema::<Effects>(SCHEMA, "Plumbline effects")
}

/// The JSON schema of what `--json` prints of one effect.
pub fn schema_of_one() -> Schema {
    report::written_schema::<Effect>(SCHEMA_OF_ONE, "Plumbline effect")
}

/// What `--json` prints of all effects.
#[derive(Serialize, JsonSchema)]
struct Effects {
    schema: &'static str,
    effects: Vec<EffectRow>,
}

/// What `--json` prints of one effect.
#[derive(Serialize, JsonSchema)]
struct Effect {
    schema: &'static str,
    /// Its code, such as `FR02`.
    code: &'static str,
    /// Its name, such as `coulomb_friction`.
    name: &'static str,
    family: Family,
    /// What it is, in a few words.
    summary: &'static str,
    /// What it adds to the torque.
    equation: &'static str,
    /// Each by its name, with its unit and range.
    parameters: BTreeMap<&'static str, String>,
    /// Its signature in a log.
    signature: &'static str,
    /// What a log must contain to reveal it.
    needs: &'static str,
    /// Names of the effects that can produce the same torque.
    confused_with: Vec<&'static str>,
    /// The motion that distinguishes it from those.
    told_apart_by: &'static str,
    /// Whether a diagnosis names it.
    diagnosed: bool,
    /// Whether a scenario can have it.
    simulated: bool,
    /// Whether the extended model compensates it.
    compensated: bool,
    /// Where the model comes from.
    source: &'static str,
}

impl Effect {
    fn new(entry: &EffectEntry) -> Self {
        Self {
            schema: SCHEMA_OF_ONE,
            code: entry.kind.code(),
            name: entry.kind.name(),
            family: entry.kind.family(),
            summary: entry.summary,
            equation: entry.equation,
            parameters: entry.parameters.iter().map(|p| (p.name, meaning(p))).collect(),
            signature: entry.signature,
            needs: entry.needs,
            confused_with: entry.confused_with.iter().map(|kind| kind.name()).collect(),
            told_apart_by: entry.told_apart_by,
            diagnosed: diagnosis::how_found(entry.kind).is_ok(),
            simulated: true,
            compensated: effects::remedy(entry.kind).is_ok(),
            source: entry.source,
        }
    }
}

/// The list of all effects, family by family.
fn list() -> String {
    let yes_or_no = |is: bool| if is { "yes" } else { "no" }.to_owned();
    let cells = rows().into_iter().map(|row| {
        let [diagnosed, compensated] = [row.diagnosed, row.compensated].map(yes_or_no);
        vec![row.code.into(), row.name.into(), diagnosed, compensated, row.summary.into()]
    });
    let list = table(&["code", "effect", "diagnosed", "compensated", "what it is"], cells);
    let families = Family::ALL.map(|f| format!("{} {}", f.letters(), f.name()));
    format!(
        "{list}\n  {}\n  All can be simulated. Of each, plumbline explain CODE says more.\n",
        families.join(", ")
    )
}

/// What is known about an effect, as text without styles.
pub fn plain_explanation(entry: &EffectEntry) -> String {
    explanation(entry, Style::new())
}

/// What is known about one effect.
fn explanation(entry: &EffectEntry, title: Style) -> String {
    let mut text = format!("{title}{}{title:#} ({})\n\n", entry.kind.label(), entry.kind);
    for (name, value) in facts(entry) {
        let lines = match name {
            "confused with" => report::pack(value.split(", "), ", ", WIDTH).join(",\n"),
            _ => value,
        };
        text.push_str(&format!("  {name:<19}{}\n", lines.replace('\n', &format!("\n{:21}", ""))));
    }
    text
}

#[cfg(test)]
mod tests {
    use catalogue::EffectKind;

    use super::*;

    #[test]
    fn the_list_fits_a_terminal_of_100_columns_and_says_every_effect_once() {
        let text = list();
        assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
        for kind in EffectKind::ALL {
            assert_eq!(text.matches(&format!(" {}  {} ", kind.code(), kind.name())).count(), 1);
        }
    }

    #[test]
    fn what_is_diagnosed_is_what_has_a_model_and_families_stand_together() {
        let rows = rows();
        let diagnosed = rows.iter().filter(|r| r.diagnosed).map(|r| r.name);
        let diagnosed: Vec<&str> = diagnosed.collect();
        // Ripple, disturbances and saturation are found without columns.
        assert_eq!(diagnosed.len(), effects::MODELLED.len() + 3);
        assert!(effects::MODELLED.iter().all(|kind| diagnosed.contains(&kind.name())));
        assert!(rows.is_sorted_by_key(|r| (r.family, r.code)));
    }

    #[test]
    fn every_effect_says_what_it_is_made_of_and_whether_it_is_diagnosed() {
        for kind in EffectKind::ALL {
            let text = plain_explanation(kind.entry());
            for parameter in kind.entry().parameters {
                assert!(text.contains(&meaning(parameter)), "{} in\n{text}", parameter.name);
            }
            let answer = diagnosis::how_found(kind).map_or_else(|reason| reason, |_| "yes");
            assert!(text.contains(answer), "{answer} in\n{text}");
            let undone = effects::remedy(kind).map_or_else(
                |reason| format!("not compensated    {reason}\n"),
                |how| format!("compensated by     {how}\n"),
            );
            assert!(text.contains(&undone), "{undone} in\n{text}");
        }
    }
}
