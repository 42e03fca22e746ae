use anstyle::Style;
use catalogue::EffectEntry;

use crate::commands::effects as list;
use crate::effect_facts::facts;
use crate::effect_name::find_effect;
use crate::error::CliError;
use crate::exit_status::ExitStatus;
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
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let Some(name) = &arguments.effect else {
        return list::run(&list::Arguments { json: false, markdown: false });
    };
    print(&explanation(find_effect(name)?.entry()))?;
    Ok(ExitStatus::Good)
}

fn explanation(entry: &EffectEntry) -> String {
    let bold = Style::new().bold();
    let mut text = format!("{bold}{}{bold:#} ({})\n\n", entry.kind.label(), entry.kind);
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
    use crate::effect_facts::meaning;

    #[test]
    fn every_effect_says_what_it_is_made_of_and_whether_it_is_diagnosed() {
        for kind in EffectKind::ALL {
            let text = explanation(kind.entry());
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
