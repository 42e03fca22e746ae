use catalogue::EffectKind;
use experiment::Estimated;
use serde::Serialize;

use crate::panel::judged_cause::JudgedCause;
use crate::panel::judgement::Judgement;
use crate::statistics::rate::{Fraction, Rate};
use crate::tables::tally::SizeTally;

/// Causes of one kind over the trials of a population.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct KindRow {
    /// Code and name of the kind; `all` for causes of every kind.
    pub kind: String,
    /// Number of visible causes.
    pub visible: usize,
    /// Share of them that is a finding or a rival of one.
    pub named: Rate,
    /// Share of them that the two questions name.
    pub two_questions: Rate,
    /// Share of them that plain least squares names.
    pub least_squares: Rate,
    /// Number of false findings of this kind, where the causes are known.
    pub false_findings: usize,
    /// Errors of the sizes, where a finding names a visible cause itself.
    pub sizes: SizeTally,
}

impl KindRow {
    /// One row for each kind that is visible or falsely named in some trial, by code, and one for all.
    pub(super) fn all(judgements: &[Judgement]) -> Vec<Self> {
        let mut kinds = EffectKind::ALL.to_vec();
        kinds.sort_by_key(|kind| kind.code());
        let rows = kinds.into_iter().map(|kind| Self::new(Some(kind), judgements));
        let rows = rows.filter(|row| row.visible > 0 || row.false_findings > 0);
        rows.chain([Self::new(None, judgements)]).collect()
    }

    fn new(kind: Option<EffectKind>, judgements: &[Judgement]) -> Self {
        let own = |effect: EffectKind| kind.is_none_or(|kind| kind == effect);
        let rate = |is: fn(&JudgedCause) -> bool| {
            let of = |one: &Judgement| {
                let causes = one.visible().filter(|cause| own(cause.at.effect));
                Fraction::of(causes.map(|cause| (is(cause), 1.0)))
            };
            Rate::over(judgements.iter().map(of))
        };
        let visible = judgements.iter().flat_map(Judgement::visible);
        let visible: Vec<&JudgedCause> = visible.filter(|cause| own(cause.at.effect)).collect();
        let sizes = visible.iter().flat_map(|cause| &cause.sizes);
        let estimates: Vec<&Estimated> = sizes.filter_map(|size| size.estimate.as_ref()).collect();
        let known = judgements.iter().filter(|one| one.is_all_known());
        let findings = known.flat_map(|one| &one.findings);
        Self {
            kind: kind.map_or("all".to_owned(), EffectKind::label),
            visible: visible.len(),
            named: rate(JudgedCause::is_named),
            two_questions: rate(|cause| cause.two_questions),
            least_squares: rate(|cause| cause.least_squares),
            false_findings: findings.filter(|f| !f.is_true && own(f.at.effect)).count(),
            sizes: SizeTally::new("all", &estimates),
        }
    }
}
