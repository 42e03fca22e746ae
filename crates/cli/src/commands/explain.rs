use anstyle::Style;
use catalogue::{EffectKind, Entry, Parameter};
use diagnosis::Diagnosed;

use crate::Outcome;
use crate::commands::effects as list;
use crate::error::CliError;
use crate::output::print;

/// Columns of the values on the page.
const WIDTH: usize = 79;

/// Arguments of `explain`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Code or name of the effect, such as FR02 or coulomb_friction
    effect: Option<String>,
}

/// Prints what is known about one effect; without one, what `effects` prints.
pub fn run(arguments: &Arguments) -> Result<Outcome, CliError> {
    let Some(name) = &arguments.effect else {
        return list::run(&list::Arguments { json: false, markdown: false });
    };
    print(&explanation(find(name)?.entry()))?;
    Ok(Outcome::Good)
}

/// The effect of a name or a code.
///
/// # Errors
///
/// [`CliError::UnknownEffect`], with names that are near.
pub fn find(name: &str) -> Result<EffectKind, CliError> {
    let plain = name.to_lowercase().replace(['-', ' '], "_");
    plain.parse().map_err(|_| {
        let named = |kind: &EffectKind| format!("{} {kind}", kind.code());
        let near = EffectKind::ALL.iter().filter(|kind| is_near(&plain, kind.name()));
        let near: Vec<String> = near.map(named).collect();
        let hint = if near.is_empty() {
            "a name such as coulomb_friction or a code such as FR02 was expected".to_owned()
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

fn explanation(entry: &Entry) -> String {
    let bold = Style::new().bold();
    let mut text = format!("{bold}{}{bold:#} ({})\n\n", entry.kind.label(), entry.kind);
    for (name, value) in facts(entry) {
        let lines = match name {
            "confused with" => report::packed(value.split(", "), ", ", WIDTH).join(",\n"),
            _ => value,
        };
        text.push_str(&format!("  {name:<19}{}\n", lines.replace('\n', &format!("\n{:21}", ""))));
    }
    text
}

/// What is known of an effect: names of its facts and parameters, and what each is.
pub(super) fn facts(entry: &Entry) -> Vec<(&'static str, String)> {
    let rivals: Vec<String> = entry.confused_with.iter().map(|k| k.label()).collect();
    let mut facts = vec![
        ("is", entry.summary.to_owned()),
        ("family", entry.family.name().to_owned()),
        ("adds", entry.equation.to_owned()),
    ];
    facts.extend(entry.parameters.iter().map(|parameter| (parameter.name, meaning(parameter))));
    facts.extend([
        ("shows as", entry.signature.to_owned()),
        ("needs", entry.needs.to_owned()),
        ("confused with", rivals.join(", ")),
        ("told apart by", entry.told_apart_by.to_owned()),
        ("diagnosed", diagnosed(entry)),
        match effects::remedy(entry.kind) {
            Ok(how) => ("compensated by", how.to_owned()),
            Err(reason) => ("not compensated", reason.to_owned()),
        },
        ("source", entry.source.to_owned()),
    ]);
    facts
}

/// What a parameter is, its unit, and its range on an arm of known size.
fn meaning(parameter: &Parameter) -> String {
    let unit = report::unit(parameter.unit);
    let units = match report::unit(parameter.unit_prismatic) {
        same if same == unit => unit.clone(),
        prismatic if unit.is_empty() => format!("on a slide {prismatic}"),
        prismatic => format!("{unit}, or {prismatic}"),
    };
    let units = if units.is_empty() { units } else { format!(" ({units})") };
    let (low, high) = parameter.typical;
    let [low, high] = [low, high].map(|end| (end * 1e4).round() / 1e4);
    format!("{}{units}: {low} to {high} on an arm like the WAM", parameter.meaning)
}

/// Whether the diagnosis can name the effect, with what, or why not.
fn diagnosed(entry: &Entry) -> String {
    match diagnosis::diagnosed(entry.kind) {
        Ok(Diagnosed { how, parameters }) if parameters.len() == entry.parameters.len() => {
            format!("yes, {how}")
        }
        Ok(Diagnosed { how, parameters }) => {
            let found: Vec<&str> = parameters.iter().map(|p| p.name).collect();
            format!("yes, {how}: {} only", found.join(" and "))
        }
        Err(reason) => {
            format!("no: {reason}\nwhat it leaves has no name, or a wrong one of the above")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_effect_says_what_it_is_made_of_and_whether_it_is_diagnosed() {
        for kind in EffectKind::ALL {
            let text = explanation(kind.entry());
            for parameter in kind.entry().parameters {
                assert!(text.contains(&meaning(parameter)), "{} in\n{text}", parameter.name);
            }
            let answer = diagnosis::diagnosed(kind).map_or_else(|reason| reason, |_| "yes");
            assert!(text.contains(answer), "{answer} in\n{text}");
            let undone = effects::remedy(kind).map_or_else(
                |reason| format!("not compensated    {reason}\n"),
                |how| format!("compensated by     {how}\n"),
            );
            assert!(text.contains(&undone), "{undone} in\n{text}");
        }
    }

    #[test]
    fn an_effect_that_is_none_is_told_in_one_line() {
        let told = |name| find(name).unwrap_err().to_string();
        let expected = "effect FR99: it is not in the catalogue, \
                        a name such as coulomb_friction or a code such as FR02 was expected";
        assert_eq!(told("FR99"), expected);
        assert!(
            told("coulomb").ends_with("did you mean FR02 coulomb_friction?"),
            "{}",
            told("coulomb")
        );
    }

    #[test]
    fn a_range_stands_beside_its_unit_and_a_partial_diagnosis_says_what_it_finds() {
        let spring = EffectKind::CableSpring.entry();
        let expected = "torque per unit of displacement (N·m/rad, or N/m): \
                        0.1 to 2 on an arm like the WAM";
        assert_eq!(spring.parameters.first().map(meaning).as_deref(), Some(expected));
        assert_eq!(diagnosed(spring), "yes, by its columns in a regression");
        assert_eq!(
            diagnosed(EffectKind::ExternalDisturbance.entry()),
            "yes, as a line of the spectrum over time: amplitude and frequency and phase only"
        );
    }
}
