use serde::{Deserialize, Serialize};

/// What is claimed of some numbers, and whether they bear it out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Claim {
    /// What is claimed, without a full stop.
    pub statement: String,
    /// In how many of the cases it has to be so.
    pub scope: Scope,
    /// Whether it is.
    pub verdict: ClaimVerdict,
    /// What was looked at.
    pub cases: Vec<ClaimCase>,
}

/// In how many cases a claim has to be so.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scope {
    /// In every one.
    Every,
    /// In more than half of them.
    Most,
}

/// Whether a claim is borne out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ClaimVerdict {
    /// It is.
    Holds,
    /// It is not.
    DoesNotHold,
    /// There are no numbers to judge it by.
    NotJudged,
}

/// One number and the limit that a claim sets it:
///
/// ```text
/// value <= limit
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ClaimCase {
    /// What the number is of, such as a model.
    pub subject: String,
    /// Where, such as at a joint.
    pub place: String,
    /// The number; none where there is none, which bears out nothing.
    pub value: Option<f64>,
    /// The most that it may be; none likewise.
    pub limit: Option<f64>,
    /// What it is compared with, if it is with another number, and that number.
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

    /// The cases in which it is not so, the worst first.
    pub fn failing(&self) -> Vec<&ClaimCase> {
        let mut failing: Vec<&ClaimCase> = self.cases.iter().filter(|case| !case.holds()).collect();
        failing.sort_by(|a, b| b.strain().total_cmp(&a.strain()));
        failing
    }

    /// The case in which it is so by the least.
    pub fn narrowest(&self) -> Option<&ClaimCase> {
        let held = self.cases.iter().filter(|case| case.holds());
        held.max_by(|a, b| a.strain().total_cmp(&b.strain()))
    }
}

impl ClaimCase {
    /// A number that may be as large as `limit`.
    pub fn within(subject: &str, place: &str, value: Option<f64>, limit: f64) -> Self {
        Self {
            subject: subject.to_owned(),
            place: place.to_owned(),
            value,
            limit: Some(limit),
            other: None,
        }
    }

    /// A number that may be as large as another times `factor` and `margin` more.
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

    /// The number as a multiple of the one that it is compared with.
    pub fn times(&self) -> Option<f64> {
        let (_, other) = self.other.as_ref()?;
        Some(self.value? / other)
    }

    /// The number as a share of its limit; without end where there is none.
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
