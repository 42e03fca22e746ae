use std::fmt;

use catalogue::EffectKind;
use serde::Serialize;

use crate::damage::answer::{DamageAnswer, NamedSizes};

/// What damage has made of an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum DamageOutcome {
    /// The same verdict and names, and sizes whose intervals meet.
    Right,
    /// The damage is told, at the place where it is.
    Told,
    /// Something is left open, or the logs are refused for another reason.
    Open,
    /// Nothing is left open and no name is new, but one is missing or has another size.
    Changed,
    /// Nothing is left open, and a name is new: the fault.
    Wrong,
}

/// Whether an answer tells the damage.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Telling {
    /// A warning or refusal names it.
    Told,
    /// Nothing names it.
    Untold,
}

impl DamageOutcome {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Right, Self::Told, Self::Open, Self::Changed, Self::Wrong];

    /// The outcome of an answer to spoilt logs, beside that to the same logs before; `telling` says whether it tells the
    /// damage, and `is_damage` whether an effect is the damage by another name.
    pub(crate) fn new(
        before: &DamageAnswer,
        after: &DamageAnswer,
        telling: Telling,
        is_damage: impl Fn(EffectKind) -> bool,
    ) -> Self {
        let is_new = |name: &&NamedSizes| !before.names.iter().any(|known| known.covers(name));
        let is_kept = |name: &NamedSizes| {
            after.names.iter().any(|found| name.covers(found) && name.agrees(found))
        };
        let new = after.names.iter().filter(is_new);
        let (damage, new): (Vec<&NamedSizes>, Vec<_>) = new.partition(|n| is_damage(n.at.effect));
        let names_it = !damage.is_empty() && new.is_empty();
        let same = damage.is_empty() && new.is_empty() && before.names.iter().all(is_kept);
        match (
            same && before.verdict == after.verdict,
            names_it || telling == Telling::Told,
            after.is_closed(),
            !new.is_empty(),
        ) {
            (true, ..) => Self::Right,
            (false, true, ..) => Self::Told,
            (false, false, false, _) => Self::Open,
            (false, false, true, false) => Self::Changed,
            (false, false, true, true) => Self::Wrong,
        }
    }

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::Told => "told",
            Self::Open => "open",
            Self::Changed => "changed",
            Self::Wrong => "wrong",
        }
    }
}

impl fmt::Display for DamageOutcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

#[cfg(test)]
mod tests {
    use catalogue::EffectKind;
    use diagnosis::{EffectAt, Verdict};

    use super::Telling::{Told, Untold};
    use super::*;

    fn name(joint: &str, size: [f64; 2]) -> NamedSizes {
        let at = EffectAt {
            effect: EffectKind::CoulombFriction,
            joint: Some(joint.to_owned()),
            link: None,
        };
        NamedSizes { at, rivals: Vec::new(), sizes: vec![("level", size)] }
    }

    fn answer(verdict: Verdict, names: &[NamedSizes]) -> DamageAnswer {
        DamageAnswer { verdict, names: names.to_vec(), said: Vec::new() }
    }

    #[test]
    fn a_new_name_is_wrong_where_nothing_is_left_open_and_nothing_told() {
        let explained = |names: &[NamedSizes]| answer(Verdict::Explained, names);
        let before = explained(&[name("elbow", [0.9, 1.1])]);
        let of = |after: &DamageAnswer, told| DamageOutcome::new(&before, after, told, |_| false);
        assert_eq!(of(&before, Told), DamageOutcome::Right);
        assert_eq!(of(&explained(&[name("elbow", [1.0, 1.3])]), Untold), DamageOutcome::Right);
        assert_eq!(of(&explained(&[name("elbow", [1.2, 1.3])]), Untold), DamageOutcome::Changed);
        assert_eq!(of(&explained(&[]), Untold), DamageOutcome::Changed);
        let both = [name("elbow", [0.9, 1.1]), name("wrist", [0.1, 0.2])];
        assert_eq!(of(&explained(&both), Untold), DamageOutcome::Wrong);
        assert_eq!(of(&explained(&both), Told), DamageOutcome::Told);
        assert_eq!(of(&answer(Verdict::PartlyExplained, &both), Untold), DamageOutcome::Open);
        assert_eq!(of(&answer(Verdict::DataInadequate, &[]), Untold), DamageOutcome::Open);
    }

    #[test]
    fn a_rival_of_a_name_is_no_new_one() {
        let mut first = name("elbow", [0.9, 1.1]);
        first.rivals.push(name("wrist", [0.0, 0.0]).at);
        let before = answer(Verdict::Explained, &[first]);
        let after = answer(Verdict::Explained, &[name("wrist", [0.95, 1.0])]);
        assert_eq!(DamageOutcome::new(&before, &after, Untold, |_| false), DamageOutcome::Right);
    }

    /// Friction in place of the damage stands for an effect that the damage is.
    #[test]
    fn a_name_that_is_the_damage_tells_it_where_no_other_is_new() {
        let before = answer(Verdict::Consistent, &[]);
        let mut other = name("wrist", [0.1, 0.2]);
        other.at.effect = EffectKind::TorqueConstant;
        let is_damage = |effect| effect == EffectKind::TorqueConstant;
        let of = |names: &[NamedSizes]| {
            let after = answer(Verdict::Explained, names);
            DamageOutcome::new(&before, &after, Untold, is_damage)
        };
        assert_eq!(of(&[]), DamageOutcome::Changed);
        assert_eq!(of(std::slice::from_ref(&other)), DamageOutcome::Told);
        assert_eq!(of(&[other, name("elbow", [0.9, 1.1])]), DamageOutcome::Wrong);
    }
}
