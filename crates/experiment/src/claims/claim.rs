use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A claim about some numbers, and whether the numbers support it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Claim {
    /// The claim in words, without a full stop.
    pub statement: String,
    /// In how many of the cases the claim must hold.
    pub scope: Scope,
    /// Whether the claim holds.
    pub verdict: ClaimVerdict,
    /// The numbers that the claim is judged by.
    pub cases: Vec<ClaimCase>,
}

/// In how many cases a claim must hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Scope {
    /// In every case.
    Every,
    /// In more than half of the cases.
    Most,
}

/// Whether a claim holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ClaimVerdict {
    /// The claim holds.
    Holds,
    /// The claim does not hold.
    DoesNotHold,
    /// There are no numbers to judge the claim by.
    NotJudged,
}

/// One number and the limit that a claim sets for it:
///
/// ```text
/// value <= limit
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ClaimCase {
    /// What the number describes, such as a model.
    pub subject: String,
    /// Where the number was taken, such as at a joint.
    pub place: String,
    /// The number. A case without one fails.
    pub value: Option<f64>,
    /// The largest value that the claim allows. A case without one fails.
    pub limit: Option<f64>,
    /// Name and value of the number that the limit is derived from, if there is one.
    pub other: Option<(String, f64)>,
}

impl Claim {
    /// Judges a claim.
    pub fn new(statement: impl Into<String>, scope: Scope, cases: Vec<ClaimCase>) -> Self {
        let held = cases.iter().filter(|case| case.holds()).count();
        let is_so = match scope {
            Scope::Every => held == cases.len(),
            Scope::Most => 2 * held > cases.len(),
        };
        let verdict = match (cases.is_empty(), is_so) {
            (true, _) => ClaimVerdict::NotJudged,
            (false, true) => ClaimVerdict::Holds,
            (false, false) => ClaimVerdict::DoesNotHold,
        };
        Self { statement: statement.into(), scope, verdict, cases }
    }

    /// The cases that fail, the worst first.
    pub fn failing(&self) -> Vec<&ClaimCase> {
        let mut failing: Vec<&ClaimCase> = self.cases.iter().filter(|case| !case.holds()).collect();
        failing.sort_by(|a, b| b.strain().total_cmp(&a.strain()));
        failing
    }

    /// Of the cases that hold, the one nearest to its limit.
    pub fn narrowest(&self) -> Option<&ClaimCase> {
        let held = self.cases.iter().filter(|case| case.holds());
        held.max_by(|a, b| a.strain().total_cmp(&b.strain()))
    }
}

impl ClaimCase {
    /// A case that holds up to `limit`.
    pub fn within(subject: &str, place: &str, value: Option<f64>, limit: f64) -> Self {
        Self {
            subject: subject.to_owned(),
            place: place.to_owned(),
            value,
            limit: Some(limit),
            other: None,
        }
    }

    /// A case that holds up to `factor` times another number plus `margin`.
    pub fn beside(
        (subject, value): (&str, Option<f64>),
        (other, other_value): (&str, Option<f64>),
        place: &str,
        (factor, margin): (f64, f64),
    ) -> Self {
        Self {
            subject: subject.to_owned(),
            place: place.to_owned(),
            value,
            limit: other_value.map(|number| factor * number + margin),
            other: other_value.map(|number| (other.to_owned(), number)),
        }
    }

    /// Whether the number is within its limit.
    pub fn holds(&self) -> bool {
        matches!((self.value, self.limit), (Some(value), Some(limit)) if value <= limit)
    }

    /// The number as a multiple of the number that it is compared with.
    pub fn times(&self) -> Option<f64> {
        let (_, other) = self.other.as_ref()?;
        Some(self.value? / other)
    }

    /// The number as a share of its limit; infinite where either is missing.
    fn strain(&self) -> f64 {
        match (self.value, self.limit) {
            (Some(value), Some(limit)) => value / limit,
            _ => f64::INFINITY,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn case(value: f64) -> ClaimCase {
        ClaimCase::within("gp", "elbow", Some(value), 1.0)
    }

    #[test]
    fn a_claim_about_every_case_fails_at_one_and_one_about_most_at_half() {
        let verdict = |scope, values: &[f64]| {
            Claim::new("", scope, values.iter().map(|&v| case(v)).collect()).verdict
        };
        assert_eq!(verdict(Scope::Every, &[0.5, 1.0]), ClaimVerdict::Holds);
        assert_eq!(verdict(Scope::Every, &[0.5, 1.1]), ClaimVerdict::DoesNotHold);
        assert_eq!(verdict(Scope::Most, &[0.5, 1.1]), ClaimVerdict::DoesNotHold);
        assert_eq!(verdict(Scope::Most, &[0.5, 1.1, 0.2]), ClaimVerdict::Holds);
        assert_eq!(verdict(Scope::Every, &[]), ClaimVerdict::NotJudged);
        assert_eq!(verdict(Scope::Most, &[f64::NAN]), ClaimVerdict::DoesNotHold);
    }

    #[test]
    fn the_worst_failure_and_the_narrowest_success_are_found() {
        let claim = Claim::new("", Scope::Every, [0.2, 3.0, 0.9, 5.0].map(case).to_vec());
        let values: Vec<_> = claim.failing().iter().map(|case| case.value).collect();
        assert_eq!(values, [Some(5.0), Some(3.0)]);
        assert_eq!(claim.narrowest().unwrap().value, Some(0.9));
    }

    #[test]
    fn a_number_is_held_against_another_with_factor_and_margin() {
        let case =
            |value| ClaimCase::beside(("a", Some(value)), ("b", Some(2.0)), "elbow", (1.1, 0.3));
        assert!(case(2.5).holds() && !case(2.6).holds());
        assert_eq!(case(3.0).times(), Some(1.5));
        let unknown = ClaimCase::beside(("a", Some(1.0)), ("b", None), "elbow", (1.1, 0.0));
        assert!(!unknown.holds() && unknown.times().is_none());
    }
}
