use std::collections::BTreeSet;

use diagnosis::{EffectAt, Estimate, Finding};
use experiment::stored;
use population::TrueCause;
use serde::{Deserialize, Serialize};

use crate::panel::judged_body::JudgedBody;
use crate::panel::place::place;

/// A finding of a diagnosis, whether it is true, and how sharply it tells a size.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JudgedFinding {
    /// The effect and its place.
    #[serde(flatten, deserialize_with = "stored::place")]
    pub at: EffectAt,
    /// Share of the nominal residual's power that the finding explains.
    #[serde(deserialize_with = "stored::number")]
    pub share_explained: f64,
    /// Effects that explain the logs as well.
    #[serde(deserialize_with = "stored::places")]
    pub not_separable_from: Vec<EffectAt>,
    /// Whether the finding is true: it or one of its rivals is in the data, or it is a rival of a finding that is in
    /// the data.
    pub is_true: bool,
    /// Width of the 95 per cent interval over the value, of the determined parameter in which that is least; `None`
    /// where the logs determine none.
    pub sharpness: Option<f64>,
    /// What it says of a body, where it is about a link.
    pub body: Option<JudgedBody>,
}

/// An effect that a baseline names, and whether it is in the data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BaselineClaim {
    /// The effect and its place.
    #[serde(flatten, deserialize_with = "stored::place")]
    pub at: EffectAt,
    /// Whether the effect is in the data, of any size.
    pub is_true: bool,
}

impl JudgedFinding {
    /// The findings of a diagnosis, the largest share first, compared with the causes in the data.
    pub(super) fn all(findings: &[&Finding], all: &[TrueCause]) -> Vec<Self> {
        let causes: Vec<EffectAt> = all.iter().map(place).collect();
        let own: Vec<&EffectAt> =
            findings.iter().map(|f| &f.at).filter(|at| causes.contains(at)).collect();
        let beside = |f: &&&Finding| own.contains(&&f.at);
        let rivals: Vec<&EffectAt> =
            findings.iter().filter(beside).flat_map(|f| &f.not_separable_from).collect();
        let is_true = |f: &Finding| {
            causes.contains(&f.at)
                || f.not_separable_from.iter().any(|rival| causes.contains(rival))
                || rivals.contains(&&f.at)
        };
        let judge = |f: &&Finding| Self {
            at: f.at.clone(),
            share_explained: f.share_explained,
            not_separable_from: f.not_separable_from.clone(),
            is_true: is_true(f),
            sharpness: sharpness(f),
            body: JudgedBody::new(f, all),
        };
        findings.iter().map(judge).collect()
    }

    /// Its share as a weight; zero where the share is negative or NaN.
    pub fn weight(&self) -> f64 {
        if self.share_explained.is_finite() { self.share_explained.max(0.0) } else { 0.0 }
    }
}

/// Least relative width of the intervals of the determined parameters. A value of zero has the largest number.
fn sharpness(finding: &Finding) -> Option<f64> {
    let relative = |estimate: &Estimate| {
        let [low, high] = estimate.ci95;
        let width = (high - low) / estimate.value.abs();
        if width.is_finite() { width } else { f64::MAX }
    };
    let determined = finding.parameters.iter().filter(|estimate| estimate.determined);
    determined.map(relative).min_by(f64::total_cmp)
}

impl BaselineClaim {
    /// The effects that a baseline names, each once, compared with the causes in the data.
    pub(super) fn all(names: &[EffectAt], causes: &[EffectAt]) -> Vec<Self> {
        let mut seen = BTreeSet::new();
        let new = names.iter().filter(|at| seen.insert(at.words()));
        new.map(|at| Self { at: at.clone(), is_true: causes.contains(at) }).collect()
    }
}
