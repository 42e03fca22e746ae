use anstyle::Style;
use catalogue::{EffectKind, Entry};

use crate::Outcome;
use crate::error::CliError;
use crate::output::{print, table};

/// Arguments of `explain`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Name of the effect, such as coulomb_friction
    effect: Option<String>,
}

/// Prints what is known about one effect, or the list of all.
pub fn run(arguments: &Arguments) -> Result<Outcome, CliError> {
    let text = match &arguments.effect {
        Some(name) => explanation(&find(name)?.entry()),
        None => list(),
    };
    print(&text)?;
    Ok(Outcome::Good)
}

fn find(name: &str) -> Result<EffectKind, CliError> {
    let plain = name.to_lowercase().replace(['-', ' '], "_");
    plain.parse().map_err(|_| {
        let names = EffectKind::ALL.map(EffectKind::name);
        let near: Vec<&str> = names.into_iter().filter(|n| is_near(&plain, n)).collect();
        let hint = if near.is_empty() {
            format!("one of {} was expected", names.join(", "))
        } else {
            format!("did you mean {}?", near.join(" or "))
        };
        CliError::UnknownEffect { name: name.to_owned(), hint }
    })
}

/// Whether `typed` is a misspelt `name` or one of its words.
fn is_near(typed: &str, name: &str) -> bool {
    let mut words = std::iter::once(name).chain(name.split('_'));
    words.any(|word| 3 * strsim::damerau_levenshtein(typed, word) <= word.len())
}

fn list() -> String {
    let rows = EffectKind::ALL.map(|kind| {
        let entry = kind.entry();
        vec![kind.name().to_owned(), entry.equation.to_owned()]
    });
    table(&["effect", "adds to the torque"], rows)
}

fn explanation(entry: &Entry) -> String {
    let bold = Style::new().bold();
    let mut text = format!("{bold}{}{bold:#} ({})\n\n", entry.kind.words(), entry.kind.name());
    let mut line = |name: &str, value: &str| {
        text.push_str(&format!("  {name:<16}{value}\n"));
    };
    line("adds", entry.equation);
    for parameter in entry.parameters {
        let unit = match (report::unit(parameter.unit), report::unit(parameter.unit_prismatic)) {
            (rotation, translation) if rotation == translation => rotation,
            (rotation, translation) => format!("{rotation}, or {translation}"),
        };
        let unit = if unit.is_empty() { unit } else { format!(" ({unit})") };
        line(parameter.name, &format!("{}{unit}", parameter.meaning));
    }
    line("shows as", entry.signature);
    line("needs", entry.needs);
    let rivals: Vec<&str> = entry.confused_with.iter().map(|k| k.words()).collect();
    line("confused with", &rivals.join(", "));
    line("told apart by", entry.told_apart_by);
    line("source", entry.source);
    text
}
