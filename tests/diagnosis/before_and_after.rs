//! What a diagnosis makes of an effect that an earlier diagnosis of the same log did not have.

use diagnosis::{Diagnosis, EffectAt, Estimate, Finding};

use crate::grafts::Size;

/// How the effect is named.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Named {
    /// It is the largest of the new or changed findings.
    First,
    /// It is new, or its size has changed by what was put in.
    Any,
    /// A new or changed finding says that it may as well be it.
    Rival,
    /// Nothing of that.
    Missed,
}

/// What came of an effect that was put in.
pub struct Seen {
    pub named: Named,
    /// Findings that are new, and neither the effect nor what may as well be it.
    pub strays: Vec<EffectAt>,
    size: f64,
    change: Option<Change>,
}

/// A change of a size, and half of its 95 % interval.
#[derive(Clone, Copy)]
struct Change {
    by: f64,
    half: f64,
}

impl Change {
    /// Whether it is what was put in, and not nothing.
    fn is(self, size: f64) -> bool {
        (self.by - size).abs() <= self.half && self.by.abs() > self.half
    }
}

impl Seen {
    /// What was put in, what was found of it, how it was named and what else appeared.
    pub fn words(&self) -> String {
        let found = self.change.map_or("-".to_owned(), |c| format!("{:.4} +- {:.4}", c.by, c.half));
        let named = format!("{:?}", self.named);
        let strays: Vec<String> = self.strays.iter().map(EffectAt::words).collect();
        format!("{:>8.4}  {found:<18}  {named:<6}  {}", self.size, strays.join(", "))
    }
}

/// Whether a diagnosis named neither the effect of a finding nor anything that may as well be it.
pub fn is_new(before: &Diagnosis, finding: &Finding) -> bool {
    !before
        .findings
        .iter()
        .any(|f| f.at == finding.at || f.not_separable_from.contains(&finding.at))
}

/// Whether a finding was none before, or is of another size: two intervals of a parameter do
/// not meet.
fn is_changed(before: &Diagnosis, finding: &Finding) -> bool {
    let Some(same) = before.findings.iter().find(|f| f.at == finding.at) else { return true };
    let apart = |(a, b): (&Estimate, &Estimate)| {
        a.determined && b.determined && (a.noise95[0] > b.noise95[1] || b.noise95[0] > a.noise95[1])
    };
    finding.parameters.iter().zip(&same.parameters).any(apart)
}

/// The size of a finding, half of its interval, and its nominal size.
fn sized(finding: &Finding, size: Size) -> Option<[f64; 3]> {
    let of = |name: &str| finding.parameters.iter().find(|p| p.name == name);
    let numbers = |e: &Estimate| [e.value, 0.5 * (e.noise95[1] - e.noise95[0]), e.nominal];
    match size {
        Size::Of(name) => Some(numbers(of(name)?)),
        Size::Between(name, other) => {
            let ([v, h, n], [w, g, m]) = (numbers(of(name)?), numbers(of(other)?));
            Some([v - w, h.hypot(g), n - m])
        }
    }
}

/// The change of the size of an effect: where it is no finding, it is nominal to within what
/// would have been found.
fn change([before, after]: [&Diagnosis; 2], at: &EffectAt, size: Size) -> Option<Change> {
    let of = |d: &Diagnosis| sized(d.findings.iter().find(|f| f.at == *at)?, size);
    let (a, b) = (of(before), of(after));
    let [_, _, nominal] = a.or(b)?;
    let unseen = |d: &Diagnosis| {
        let of = d.ruled_out.iter().find(|r| r.at == *at);
        [nominal, of.and_then(|r| r.smallest_detectable).unwrap_or(0.0), nominal]
    };
    let [a, b] = [a.unwrap_or_else(|| unseen(before)), b.unwrap_or_else(|| unseen(after))];
    Some(Change { by: b[0] - a[0], half: a[1].hypot(b[1]) })
}

/// What the second of two diagnoses makes of an effect of a size that the first did not have.
pub fn seen(two: [&Diagnosis; 2], at: &EffectAt, (parameter, size): (Size, f64)) -> Seen {
    let [before, after] = two;
    let changed: Vec<&Finding> = after.findings.iter().filter(|f| is_changed(before, f)).collect();
    let change = change(two, at, parameter);
    let own = after.findings.iter().find(|f| f.at == *at);
    let found = own.is_some_and(|f| is_new(before, f)) || change.is_some_and(|c| c.is(size));
    let first = changed.first().is_none_or(|f| f.at == *at);
    let named = match (found, first) {
        (true, true) => Named::First,
        (true, false) => Named::Any,
        _ if changed.iter().any(|f| f.not_separable_from.contains(at)) => Named::Rival,
        _ => Named::Missed,
    };
    let is_it = |f: &Finding| {
        let rival_of_own = own.is_some_and(|own| own.not_separable_from.contains(&f.at));
        f.at == *at || f.not_separable_from.contains(at) || rival_of_own
    };
    let strays = changed.iter().filter(|f| is_new(before, f) && !is_it(f));
    Seen { named, strays: strays.map(|f| f.at.clone()).collect(), size, change }
}
