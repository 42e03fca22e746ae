use catalogue::{EffectKind, Family};

use super::rows::EffectRow;
use crate::effect_facts::facts;

/// The catalogue as a page in Markdown: a table of all effects, then each with what `explain` says of it.
pub(super) fn page(rows: &[EffectRow]) -> String {
    let mut page = format!(
        "# The effects\n\nThe {} causes that Plumbline knows. All can be simulated; the table says which a diagnosis \
         names, and which a feedforward compensates. On the command line `plumbline explain CODE` says the same.\n\n\
         Equations say what an effect adds to the right side of\n\n```text\n\
         effort = torque_gain (M qdd + C qd + g + sum of effects) + torque_offset\n```\n\n\
         `q`, `qd`, `qdd` are position, velocity and acceleration of the joint, `tau` is the torque of everything \
         else. What resists a positive motion is positive.\n\n\
         | code | effect | diagnosed | compensated | what it is |\n|---|---|---|---|---|\n",
        rows.len()
    );
    let yes_or_no = |is: bool| if is { "yes" } else { "no" };
    for row in rows {
        let (diagnosed, compensated) = (yes_or_no(row.diagnosed), yes_or_no(row.compensated));
        let (code, words) = (row.code, row.kind.entry().words);
        let anchor = anchor(row.kind);
        let summary = row.summary;
        page.push_str(&format!(
            "| [{code}](#{anchor}) | {words} | {diagnosed} | {compensated} | {summary} |\n"
        ));
    }
    for family in Family::ALL {
        let name = family.name();
        page.push_str(&format!("\n## {}{}\n", name[..1].to_uppercase(), &name[1..]));
        rows.iter().filter(|row| row.family == family).for_each(|row| page.push_str(&section(row)));
    }
    page
}

/// An effect: its heading, and a list of what is known of it.
fn section(row: &EffectRow) -> String {
    let entry = row.kind.entry();
    let mut text = format!("\n### {}\n\n`{}`\n\n", row.kind.label(), row.name);
    let parameters: Vec<&str> = entry.parameters.iter().map(|p| p.name).collect();
    for (name, value) in facts(entry) {
        let value = value.replace('\n', "; ");
        let line = match name {
            "family" => continue,
            "adds" => format!("- **adds** `{value}`\n"),
            "confused with" => format!("- **confused with** {}\n", links(entry.confused_with)),
            parameter if parameters.contains(&parameter) => format!("- `{parameter}`: {value}\n"),
            _ => format!("- **{name}** {}\n", plain(&value)),
        };
        text.push_str(&line);
    }
    text
}

fn links(kinds: &[EffectKind]) -> String {
    let link = |kind: &EffectKind| format!("[{}](#{})", kind.label(), anchor(*kind));
    kinds.iter().map(link).collect::<Vec<_>>().join(", ")
}

/// The anchor that mdBook gives the heading of an effect: lower case, hyphens for blanks.
fn anchor(kind: EffectKind) -> String {
    kind.label().to_lowercase().replace(' ', "-")
}

/// Text without what Markdown would read as emphasis.
fn plain(text: &str) -> String {
    text.replace('*', "\\*").replace('_', "\\_")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::explain::rows::rows;

    #[test]
    fn the_page_has_a_section_for_every_effect_and_a_link_to_it() {
        let page = page(&rows());
        for kind in EffectKind::ALL {
            assert!(page.contains(&format!("\n### {}\n", kind.label())), "{kind}");
            assert!(page.contains(&format!("](#{})", anchor(kind))), "{kind}");
            let equation = format!("- **adds** `{}`\n", kind.entry().equation);
            assert!(page.contains(&equation), "{equation}");
        }
    }
}
