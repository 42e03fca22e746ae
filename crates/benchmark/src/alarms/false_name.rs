use catalogue::EffectKind;
use serde::Serialize;

use crate::panel::judgement::Judgement;

/// A kind of effect that is named in clean logs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FalseName {
    /// Code and name of the effect.
    pub effect: String,
    /// Trials in which it is named falsely.
    pub trials: usize,
}

impl FalseName {
    /// The kinds that are named falsely in some trial, the most frequent first.
    pub(super) fn all(clean: &[&Judgement]) -> Vec<Self> {
        let of = |kind: &EffectKind| {
            let named = |one: &&&Judgement| {
                one.findings.iter().any(|finding| !finding.is_true && finding.at.effect == *kind)
            };
            Self { effect: kind.label(), trials: clean.iter().filter(named).count() }
        };
        let mut all: Vec<Self> = EffectKind::ALL.iter().map(of).collect();
        all.retain(|name| name.trials > 0);
        all.sort_by(|a, b| b.trials.cmp(&a.trials).then_with(|| a.effect.cmp(&b.effect)));
        all
    }
}
