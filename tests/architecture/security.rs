//! Every test that SECURITY.md names for a claim exists.

use crate::assert_kept;
use crate::tree::text;

/// Fewest claims with a test.
const FEWEST: usize = 25;

/// The claims, files and tests of the table with the columns "claim" and "test".
fn claims(document: &str) -> Vec<(String, String, String)> {
    let rows = document.lines().skip_while(|line| *line != "| claim | test |").skip(2);
    let of_row = |row: &str| {
        let mut cells = row.trim_matches('|').rsplitn(2, " | ");
        let (test, claim) = (cells.next()?, cells.next()?);
        let mut names = test.split('`').filter(|part| !part.trim().is_empty());
        Some((claim.trim().to_owned(), names.next()?.to_owned(), names.next()?.to_owned()))
    };
    rows.take_while(|line| line.starts_with('|')).filter_map(of_row).collect()
}

/// Whether a source holds a test of that name.
fn holds_test(source: &str, name: &str) -> bool {
    let head = format!("fn {name}(");
    let lines: Vec<&str> = source.lines().map(str::trim).collect();
    lines.iter().enumerate().any(|(k, line)| {
        let attributes = lines[..k].iter().rev().take_while(|line| line.starts_with("#["));
        line.starts_with(&head) && attributes.clone().any(|line| *line == "#[test]")
    })
}

#[test]
fn every_claim_names_a_test_that_exists() {
    let claims = claims(&text("SECURITY.md"));
    let missing = claims.iter().filter(|(_, file, test)| !holds_test(&text(file), test));
    let told = |(claim, file, test): &(String, String, String)| {
        format!("SECURITY.md: {claim}: no test {test} in {file}")
    };
    assert_kept(&missing.map(told).collect::<Vec<_>>());
    assert!(claims.len() >= FEWEST, "{} claims have a test", claims.len());
}

#[test]
fn a_test_that_is_gone_is_noticed() {
    let document = "| claim | test |\n|---|---|\n| a, b | `a.rs` `holds` |\n\n| other | table |\n";
    let expected = ["a, b", "a.rs", "holds"].map(str::to_owned);
    assert_eq!(claims(document), [expected.into()]);
    assert!(holds_test("#[test]\n#[should_panic]\nfn holds() {}", "holds"));
    assert!(!holds_test("#[test]\nfn other() {}\nfn holds() {}", "holds"));
}
