use catalogue::EffectKind;
use experiment::Estimated;
use serde::Serialize;

use crate::panel::judged_cause::JudgedCause;
use crate::panel::judged_finding::JudgedFinding;
use crate::panel::judgement::Judgement;
use crate::statistics::median::median;
use crate::statistics::rate::{Fraction, Rate};
use crate::tables::size_tally::SizeTally;

/// Causes of one kind, and findings of it, over the trials of a campaign whose logs are not spoilt.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct KindRow {
    /// Code and name of the kind; `all` for causes of every kind.
    pub kind: String,
    /// Number of visible causes.
    pub visible: usize,
    /// Share of them that a finding names: it is the cause, has it as a rival or bears it.
    pub named: Rate,
    /// Share of them that is ruled out with a reason.
    pub ruled_out: Rate,
    /// Share of them that plain least squares names.
    pub least_squares: Rate,
    /// Number of false findings of this kind, where the causes are known.
    pub false_findings: usize,
    /// Share of the findings of this kind of which the logs determine a size.
    pub told: Rate,
    /// Median width of the intervals of those, over the value.
    pub sharpness: Option<f64>,
    /// Share of them that are off in mass or centre of mass by more than the interval, by kg; of links alone.
    pub bodies_off: Rate,
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
                let causes = one.causes_to_name().filter(|cause| own(cause.at.effect));
                Fraction::of(causes.map(|cause| (is(cause), 1.0)))
            };
            Rate::over(judgements.iter().map(of))
        };
        let visible = judgements.iter().flat_map(Judgement::causes_to_name);
        let visible: Vec<&JudgedCause> = visible.filter(|cause| own(cause.at.effect)).collect();
        let sizes = visible.iter().flat_map(|cause| &cause.sizes);
        let estimates: Vec<&Estimated> = sizes.filter_map(|size| size.estimate.as_ref()).collect();
        let known = || judgements.iter().filter(|one| one.is_precision_known());
        let findings = known().flat_map(|one| &one.findings);
        let told = |one: &Judgement| {
            let own = one.unspoilt_findings().filter(|f| own(f.at.effect));
            Fraction::of(own.map(|f| (f.sharpness.is_some(), 1.0)))
        };
        let bodies_off = |one: &Judgement| {
            let bodies = one.findings.iter().filter(|f| own(f.at.effect)).filter_map(|f| f.body);
            Fraction::of(bodies.map(|body| (!body.holds, body.weight())))
        };
        let all = judgements.iter().flat_map(Judgement::unspoilt_findings);
        let sharpness =
            |finding: &JudgedFinding| finding.sharpness.filter(|_| own(finding.at.effect));
        Self {
            kind: kind.map_or("all".to_owned(), EffectKind::label),
            visible: visible.len(),
            named: rate(JudgedCause::is_named),
            ruled_out: rate(|cause| !cause.is_named() && cause.ruled_out.is_some()),
            least_squares: rate(|cause| cause.least_squares),
            false_findings: findings.filter(|f| !f.is_true && own(f.at.effect)).count(),
            told: Rate::over(judgements.iter().map(told)),
            sharpness: median(all.filter_map(sharpness).collect()),
            bodies_off: Rate::over(known().map(bodies_off)),
            sizes: SizeTally::new(&estimates),
        }
    }
}
