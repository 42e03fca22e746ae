use std::ops::RangeInclusive;

use experiment::{Claim, ClaimCase, ClaimVerdict};

use pages::{BOLD, TABLE_DIGITS, TERMINAL_WIDTH, count_noun, significant, wrap};

/// Cases that a claim which does not hold is told with at most.
const MOST_CASES: usize = 3;

/// Ratios that tell something; beyond them the smaller number counts as none.
const SHOWN_TIMES: RangeInclusive<f64> = 0.001..=1000.0;

/// What the numbers of claims are, as they are printed.
#[derive(Debug, Clone, Copy)]
pub struct ClaimUnit {
    /// What they are multiplied by.
    pub scale: f64,
    /// Their unit then, empty for pure numbers.
    pub unit: &'static str,
}

impl ClaimUnit {
    /// Mean square errors over variances.
    pub const NMSE: Self = Self { scale: 1.0, unit: "" };
    /// Times (us).
    pub const MICROSECONDS: Self = Self { scale: 1.0, unit: "µs" };

    fn format(self, value: Option<f64>) -> String {
        let number = significant(self.scale * value.unwrap_or(f64::NAN), TABLE_DIGITS);
        if self.unit.is_empty() { number } else { format!("{number} {}", self.unit) }
    }
}

/// A claim in words.
pub struct ClaimRow {
    /// What is claimed.
    pub statement: String,
    /// Whether it holds.
    pub verdict: &'static str,
    /// Class of the verdict in the style sheet.
    pub class: &'static str,
    /// In how many cases, and where not, or where by the least.
    pub finding: String,
}

/// Claims in words.
pub fn claim_rows(claims: &[Claim], unit: ClaimUnit) -> Vec<ClaimRow> {
    let row = |claim: &Claim| {
        let (verdict, class) = match claim.verdict {
            ClaimVerdict::Holds => ("holds", "good"),
            ClaimVerdict::DoesNotHold => ("does not hold", "bad"),
            ClaimVerdict::NotJudged => ("not judged", "open"),
        };
        let finding = finding(claim, unit);
        ClaimRow { statement: claim.statement.clone(), verdict, class, finding }
    };
    claims.iter().map(row).collect()
}

/// In how many cases a claim is so, where not, or where by the least.
fn finding(claim: &Claim, unit: ClaimUnit) -> String {
    let failing = claim.failing();
    let (all, held) = (claim.cases.len(), claim.cases.len() - failing.len());
    if all == 0 {
        return "there are no numbers to judge it by".to_owned();
    }
    let narrowest = || {
        let case = claim.narrowest().map(|case| describe(case, unit));
        case.map_or_else(String::new, |case| format!(", narrowest {case}"))
    };
    if failing.is_empty() {
        return format!("in all of {}{}", count_noun(all, "case"), narrowest());
    }
    let cases: Vec<String> =
        failing.iter().take(MOST_CASES).map(|case| describe(case, unit)).collect();
    let more = match failing.len() - cases.len() {
        0 => String::new(),
        more => format!("; and {more} more"),
    };
    format!("in {held} of {}, not {}{more}", count_noun(all, "case"), cases.join("; "))
}

/// A number with its place, and what it is held against.
fn describe(case: &ClaimCase, unit: ClaimUnit) -> String {
    let value = unit.format(case.value);
    let beside = match (&case.other, case.times().filter(|times| SHOWN_TIMES.contains(times))) {
        (Some((other, number)), Some(times)) => format!(
            ", {} times the {} of {other}",
            significant(times, TABLE_DIGITS),
            unit.format(Some(*number))
        ),
        (Some((other, number)), None) => {
            format!(" beside {} of {other}", unit.format(Some(*number)))
        }
        (None, _) => String::new(),
    };
    format!("{} at {}: {value}{beside}", case.subject, case.place)
}

/// How many of some claims hold, in a sentence.
pub fn claims_sentence(claims: &[Claim]) -> String {
    let held = claims.iter().filter(|claim| claim.verdict == ClaimVerdict::Holds).count();
    let names = match claims.len() {
        1 => "the claim",
        _ => "the claims",
    };
    format!("{held} of {} of {names} hold on this arm", claims.len())
}

/// One sentence a claim, for a terminal.
pub fn claim_text(claims: &[Claim], unit: ClaimUnit) -> String {
    let mut out = String::new();
    for ClaimRow { statement, verdict, finding, .. } in claim_rows(claims, unit) {
        let sentence = format!("{verdict}: {statement} ({finding}).");
        let lines = wrap(&sentence, TERMINAL_WIDTH - 2);
        for (i, line) in lines.iter().enumerate() {
            let lead = if i == 0 { "" } else { "  " };
            let line = match line.strip_prefix(verdict).filter(|_| i == 0) {
                Some(rest) => format!("{BOLD}{verdict}{BOLD:#}{rest}"),
                None => line.clone(),
            };
            out.push_str(&format!("{lead}{line}\n"));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use experiment::Scope;

    use super::*;
    use pages::without_escapes;

    fn case(joint: &str, value: f64) -> ClaimCase {
        ClaimCase::beside(("gp-rbd", Some(value)), ("gp", Some(0.02)), joint, (1.0, 0.0))
    }

    #[test]
    fn a_claim_that_holds_is_told_where_it_does_by_the_least() {
        let claim = Claim::new("x is less", Scope::Every, vec![case("a", 0.01), case("b", 0.015)]);
        let row = &claim_rows(&[claim], ClaimUnit::NMSE)[0];
        assert_eq!((row.verdict, row.class), ("holds", "good"));
        assert_eq!(
            row.finding,
            "in all of 2 cases, narrowest gp-rbd at b: 0.0150, 0.750 times the 0.0200 of gp"
        );
    }

    #[test]
    fn a_claim_that_does_not_is_told_where_and_by_how_much_the_worst_first() {
        let cases = [0.03, 0.05, 0.04, 0.021, 0.01];
        let cases = cases.iter().enumerate().map(|(i, &v)| case(&format!("j{i}"), v)).collect();
        let claim = Claim::new("x is less", Scope::Every, cases);
        let text = without_escapes(&claim_text(&[claim], ClaimUnit::MICROSECONDS));
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(
            text,
            "does not hold: x is less (in 1 of 5 cases, not gp-rbd at j1: 0.0500 µs, 2.50 times the \
             0.0200 µs of gp; gp-rbd at j2: 0.0400 µs, 2.00 times the 0.0200 µs of gp; gp-rbd at j0: \
             0.0300 µs, 1.50 times the 0.0200 µs of gp; and 1 more)."
        );
    }

    #[test]
    fn a_number_that_is_not_there_is_a_dash_and_no_case_is_said() {
        let absent = ClaimCase::within("gp", "elbow", None, 1.0);
        let claims = [
            Claim::new("x", Scope::Every, vec![absent]),
            Claim::new("y", Scope::Every, Vec::new()),
        ];
        let rows = claim_rows(&claims, ClaimUnit::NMSE);
        assert_eq!(rows[0].finding, "in 0 of 1 case, not gp at elbow: -");
        assert_eq!(rows[1].verdict, "not judged");
        let far = ClaimCase::beside(("gp", Some(0.2)), ("rbd", Some(1e-5)), "elbow", (1.0, 0.01));
        let far = &claim_rows(&[Claim::new("z", Scope::Every, vec![far])], ClaimUnit::NMSE)[0];
        assert_eq!(far.finding, "in 0 of 1 case, not gp at elbow: 0.200 beside 1.00e-5 of rbd");
        assert_eq!(claims_sentence(&claims), "0 of 2 of the claims hold on this arm");
    }
}
