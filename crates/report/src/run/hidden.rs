use experiment::{Injected, Named, Score, Size};
use robot::Robot;

use crate::diagnosis::places::JointUnits;
use pages::{count_noun, percent, significant, unit};

/// What was put in beside what was found of it.
pub(crate) struct HiddenRow {
    /// The effect and its place.
    pub hidden: String,
    /// Whether and how it was found.
    pub found: String,
    /// Class of the answer in the style sheet.
    pub class: &'static str,
    /// Its parameters.
    pub sizes: Vec<SizeRow>,
}

/// A parameter of what was put in.
pub(crate) struct SizeRow {
    pub name: String,
    pub truth: String,
    pub found: String,
}

/// What was put in, in its order.
pub(crate) fn hidden_rows(score: &Score, robot: &Robot) -> Vec<HiddenRow> {
    score.injected.iter().map(|injected| row(injected, &score.findings, robot)).collect()
}

fn row(injected: &Injected, findings: &[Named], robot: &Robot) -> HiddenRow {
    let share = |finding: usize| {
        let share = findings.get(finding).map_or(f64::NAN, |named| named.share_explained);
        percent(share)
    };
    let (found, class) = match (injected.finding, injected.one_of) {
        (Some(finding), _) => (format!("found, {} of the gap", share(finding)), "good"),
        (None, Some(finding)) => {
            // At the same joint its name is enough.
            let name = findings.get(finding).map_or_else(String::new, |f| match &f.at.joint {
                Some(_) if f.at.joint == injected.at.joint => f.at.effect.label(),
                _ => f.at.words(),
            });
            (format!("as {name}, {}", share(finding)), "good")
        }
        (None, None) => match injected.of_smallest.filter(|ratio| *ratio < 1.0) {
            None => ("not found".to_owned(), "bad"),
            Some(ratio) => {
                let ratio = percent(ratio);
                (format!("not found, {ratio} of the detectable size"), "part")
            }
        },
    };
    let sizes = injected.sizes.iter().map(|size| size_row(injected, size, robot)).collect();
    HiddenRow { hidden: injected.at.words(), found, class, sizes }
}

fn size_row(injected: &Injected, size: &Size, robot: &Robot) -> SizeRow {
    let parameters = injected.at.effect.entry().parameters;
    let known = parameters.iter().find(|parameter| parameter.name == size.name);
    let slides = injected.at.joint.as_ref().is_some_and(|joint| {
        // A slide is told by the unit of its position.
        JointUnits::of(robot, joint).position == "m"
    });
    let unit = known.map_or_else(String::new, |parameter| {
        unit(if slides { parameter.unit_prismatic } else { parameter.unit })
    });
    let space = if unit.is_empty() { "" } else { " " };
    let found = match &size.estimate {
        None => "-".to_owned(),
        Some(estimate) if !estimate.determined => "not determined by these logs".to_owned(),
        Some(estimate) => {
            let [value, low, high] =
                [estimate.value, estimate.ci95[0], estimate.ci95[1]].map(|x| significant(x, 3));
            format!("{value} ({low} to {high})")
        }
    };
    SizeRow {
        name: size.name.replace('_', " "),
        truth: format!("{}{space}{unit}", significant(size.truth, 3)),
        found,
    }
}

/// What was named beside what was put in, if anything, in a sentence.
pub(crate) fn stray_sentence(score: &Score) -> Option<String> {
    let names: Vec<String> = score.stray.iter().map(diagnosis::EffectAt::words).collect();
    (!names.is_empty()).then(|| format!("Named, but not put in: {}", names.join(", ")))
}

/// How the answer compares with the truth, in a sentence.
pub(crate) fn score_sentence(score: &Score) -> String {
    let found = score.injected.iter().filter(|injected| injected.one_of.is_some()).count();
    let effects = |count: usize| count_noun(count, "effect");
    match (score.injected.len(), score.findings.len()) {
        (0, 0) => "Nothing was put in, and nothing was named".to_owned(),
        (0, named) => format!("Nothing was put in, and {} named", effects(named)),
        (1, _) if found == 1 => "The effect that was put in was found".to_owned(),
        (2, _) if found == 2 => "Both effects that were put in were found".to_owned(),
        (all, _) => format!("{found} of {} that were put in were found", effects(all)),
    }
}
