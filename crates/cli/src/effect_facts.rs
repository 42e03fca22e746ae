use catalogue::{EffectEntry, Parameter};
use diagnosis::HowFound;

/// What is known of an effect: names of its facts and parameters, and what each is.
pub fn facts(entry: &EffectEntry) -> Vec<(&'static str, String)> {
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
        ("diagnosed", diagnosis_of(entry)),
        match effects::remedy(entry.kind) {
            Ok(how) => ("compensated by", how.to_owned()),
            Err(reason) => ("not compensated", reason.to_owned()),
        },
        ("source", entry.source.to_owned()),
    ]);
    facts
}

/// What a parameter is, its unit, and its range on an arm of known size.
pub fn meaning(parameter: &Parameter) -> String {
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
fn diagnosis_of(entry: &EffectEntry) -> String {
    match diagnosis::how_found(entry.kind) {
        Ok(HowFound { how, parameters }) if parameters.len() == entry.parameters.len() => {
            format!("yes, {how}")
        }
        Ok(HowFound { how, parameters }) => {
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
    use catalogue::EffectKind;

    use super::*;

    #[test]
    fn a_range_stands_beside_its_unit_and_a_partial_diagnosis_says_what_it_finds() {
        let spring = EffectKind::CableSpring.entry();
        let expected = "torque per unit of displacement (N·m/rad, or N/m): \
                        0.1 to 2 on an arm like the WAM";
        assert_eq!(spring.parameters.first().map(meaning).as_deref(), Some(expected));
        assert_eq!(diagnosis_of(spring), "yes, by its columns in a regression");
        assert_eq!(
            diagnosis_of(EffectKind::ExternalDisturbance.entry()),
            "yes, as a line of the spectrum over time: amplitude and frequency and phase only"
        );
    }
}
