mod page;
mod rows;

use catalogue::Family;
use serde::Serialize;

use self::rows::{EffectRow, rows};
use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::output::{print, print_json, table};

/// Arguments of `effects`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    /// Print a page in Markdown with what explain says of every effect
    #[arg(long, conflicts_with = "json")]
    pub markdown: bool,
}

/// Prints the list of all effects, family by family.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    if arguments.json {
        print_json(&Document { schema: "plumbline.effects/1", effects: rows() })?;
    } else if arguments.markdown {
        print(&page::page(&rows()))?;
    } else {
        print(&text())?;
    }
    Ok(ExitStatus::Good)
}

/// What `--json` prints.
#[derive(Serialize)]
struct Document {
    schema: &'static str,
    effects: Vec<EffectRow>,
}

fn text() -> String {
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

#[cfg(test)]
mod tests {
    use catalogue::EffectKind;

    use super::*;

    #[test]
    fn the_list_fits_a_terminal_of_100_columns_and_says_every_effect_once() {
        let text = text();
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
}
