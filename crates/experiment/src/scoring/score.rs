use diagnosis::{Diagnosis, EffectAt, Finding, RuledOut, Verdict};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simulator::Truth;

use crate::scoring::size::Size;
use crate::scoring::smallest::of_smallest;
use crate::scoring::stored;

/// How well a diagnosis names the injected effects.
///
/// Of `k` injected effects, the `k` findings with the largest shares should be these effects.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Score {
    /// The seed of all random draws.
    pub seed: u64,
    /// The injected effects.
    #[serde(rename = "put_in")]
    pub injected: Vec<Injected>,
    /// Whether the diagnosis looked for the effects; if not, the right answer is that something is unknown.
    pub looked_for: bool,
    /// The verdict over all joints.
    #[serde(deserialize_with = "stored::verdict")]
    pub verdict: Verdict,
    /// The findings, the largest share first.
    pub findings: Vec<Named>,
    /// Whether the first findings are the injected effects at their places. Without an injected effect, whether there
    /// are no findings.
    pub exactly: bool,
    /// Whether the injected effects are the first findings or rivals of these.
    pub as_one_of: bool,
    /// Findings that are neither injected effects nor rivals of a finding that is one.
    #[serde(deserialize_with = "stored::places")]
    pub stray: Vec<EffectAt>,
}

/// An injected effect.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Injected {
    /// The effect and its place.
    #[serde(flatten, deserialize_with = "stored::place")]
    pub at: EffectAt,
    /// Index of the finding that names the effect.
    pub finding: Option<usize>,
    /// Index of the first finding that is the effect or has it as a rival.
    pub one_of: Option<usize>,
    /// The parameters of the effect.
    pub sizes: Vec<Size>,
    /// Size of the effect over the smallest size that the logs would have shown, where the diagnosis states that.
    pub of_smallest: Option<f64>,
}

/// A finding of a diagnosis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Named {
    /// The effect and its place.
    #[serde(flatten, deserialize_with = "stored::place")]
    pub at: EffectAt,
    /// Share of the nominal residual's power that goes with it.
    #[serde(deserialize_with = "stored::number")]
    pub share_explained: f64,
    /// Effects that explain the logs as well.
    #[serde(deserialize_with = "stored::places")]
    pub not_separable_from: Vec<EffectAt>,
}

impl Score {
    /// Scores a diagnosis against the injected effects.
    pub fn new(diagnosis: &Diagnosis, truth: &[Truth], seed: u64) -> Self {
        let mut findings: Vec<&Finding> = diagnosis.findings.iter().collect();
        findings.sort_by(|a, b| b.share_explained.total_cmp(&a.share_explained));
        let find_injected = |truth| Injected::new(truth, &findings, &diagnosis.ruled_out);
        let injected: Vec<Injected> = truth.iter().map(find_injected).collect();
        let among_first = |of: fn(&Injected) -> Option<usize>| match injected.len() {
            0 => findings.is_empty(),
            k => injected.iter().all(|p| of(p).is_some_and(|finding| finding < k)),
        };
        let is_true = |at: &EffectAt| injected.iter().any(|p| p.at == *at);
        let is_excused = |finding: &Finding| {
            let mut names = std::iter::once(&finding.at).chain(&finding.not_separable_from);
            let of_a_true_one = |f: &&&Finding| is_true(&f.at);
            let mut rivals =
                findings.iter().filter(of_a_true_one).flat_map(|f| &f.not_separable_from);
            names.any(is_true) || rivals.any(|rival| *rival == finding.at)
        };
        let stray = findings.iter().filter(|f| !is_excused(f)).map(|f| f.at.clone()).collect();
        Self {
            seed,
            looked_for: true,
            verdict: diagnosis.verdict,
            exactly: among_first(|p| p.finding),
            as_one_of: among_first(|p| p.one_of),
            stray,
            findings: findings.into_iter().map(Named::new).collect(),
            injected,
        }
    }

    /// Share of the nominal residual's power that the true findings explain.
    pub fn explained_share(&self) -> f64 {
        let own = self.injected.iter().filter_map(|p| p.finding);
        own.map(|finding| self.findings[finding].share_explained).sum()
    }

    /// Whether every injected effect is among the findings or their rivals.
    pub fn is_found(&self) -> bool {
        self.injected.iter().all(|p| p.one_of.is_some())
    }

    /// Whether the logs show the injected effects. The answer is no where an effect is missed, no false effect is
    /// named, and the diagnosis states that the effect is too small to be found.
    pub fn visible(&self) -> bool {
        let large = |p: &Injected| p.of_smallest.is_none_or(|ratio| ratio >= 1.0);
        self.is_found() || !self.stray.is_empty() || self.injected.iter().all(large)
    }

    /// Whether the diagnosis leaves structure open and names no false effect: the right answer to
    /// an effect without a model.
    pub fn unknown(&self) -> bool {
        let open = matches!(self.verdict, Verdict::Unexplained | Verdict::PartlyExplained);
        open && self.stray.is_empty()
    }

    /// The trial in one line, such as `TR01 backlash at elbow, seed 7: unexplained, named nothing`.
    pub fn words(&self) -> String {
        let all = |words: Vec<String>, join: &str, none: &str| {
            if words.is_empty() { none.to_owned() } else { words.join(join) }
        };
        let injected = self.injected.iter().map(|p| p.at.words()).collect();
        let named = self.findings.iter().map(Named::words).collect();
        let (injected, named) = (all(injected, " and ", "clean"), all(named, "; ", "nothing"));
        format!("{injected}, seed {}: {}, named {named}", self.seed, self.verdict.words())
    }
}

impl Injected {
    fn new(truth: &Truth, findings: &[&Finding], ruled_out: &[RuledOut]) -> Self {
        let (effect, joint, link) = (truth.effect, truth.joint.clone(), truth.link.clone());
        let at = EffectAt { effect, joint, link };
        let finding = findings.iter().position(|f| f.at == at);
        let one_of = |f: &&Finding| f.at == at || f.not_separable_from.contains(&at);
        let one_of = findings.iter().position(one_of);
        let estimates = finding.map_or(&[][..], |f| &findings[f].parameters);
        let sizes = Size::all(truth, estimates);
        let of_smallest = of_smallest(truth, (&at, &sizes), ruled_out);
        Self { finding, one_of, of_smallest, sizes, at }
    }
}

impl Named {
    fn new(finding: &Finding) -> Self {
        Self {
            at: finding.at.clone(),
            share_explained: finding.share_explained,
            not_separable_from: finding.not_separable_from.clone(),
        }
    }

    fn words(&self) -> String {
        let names = std::iter::once(&self.at).chain(&self.not_separable_from);
        let names: Vec<String> = names.map(EffectAt::words).collect();
        format!("{} ({:.0} %)", names.join(" or "), 100.0 * self.share_explained)
    }
}
