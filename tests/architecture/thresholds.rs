//! Numbers that decide an answer are fields of the thresholds, where a test can vary one: a constant of a number in the
//! crates that decide is purely numerical, and has its reason here.

use std::collections::BTreeSet;

use crate::assert_kept;
use crate::tree::{rust_files, text};

/// The crates that decide.
const DECIDING: [&str; 3] = ["diagnosis", "effects", "inspection"];

/// Constants that no answer hangs on, by the names of crate, file and constant, and why.
const NUMERICAL: &[(&str, &str, &str, &str)] = &[
    ("diagnosis", "accept", "EXCHANGES", "cap of a loop that ends when nothing changes"),
    ("diagnosis", "along", "EVALUATION_RATE", "sampling rate, far above the band"),
    ("diagnosis", "along", "IN_BAND", "rounding of a projection"),
    ("diagnosis", "along", "ORDER", "order of a low-pass"),
    ("diagnosis", "along", "REGRESSION_RATE", "sampling rate, just above twice the band"),
    ("diagnosis", "along", "THINNING", "cut-off of an anti-aliasing filter"),
    ("diagnosis", "constancy", "FUNCTIONS", "number of functions in an array"),
    ("diagnosis", "dataset", "ROUNDS", "cap of a loop that ends when nothing changes"),
    ("diagnosis", "fitted_model", "CONVERGED", "tolerance of an iteration"),
    ("diagnosis", "fitted_model", "ROUNDS", "cap of a loop that ends when it converges"),
    ("diagnosis", "fitted_model", "SHORTEST", "shortest step of an iteration"),
    ("diagnosis", "limits", "TRIALS", "resolution of the first scan, which is refined afterwards"),
    (
        "diagnosis",
        "second_encoders",
        "NOISE_OF_REST",
        "keeps a quotient of two sums of noise from being taken",
    ),
    ("diagnosis", "select", "ROUNDS", "cap of a loop that ends when nothing changes"),
    ("diagnosis", "shapes", "AT_ONCE", "memory"),
    ("diagnosis", "structure", "KNOTS", "resolution of a piecewise linear function"),
    ("diagnosis", "structure", "LISTED", "length of a list in the report"),
    ("diagnosis", "structure", "SPREADS", "grid of a search"),
    ("diagnosis", "tone_finding", "HALF_WIDTH", "quantile of the normal distribution at .975"),
    ("diagnosis", "tone_fit", "ROUNDS", "iterations of Gauss-Newton, which converge in three"),
    ("diagnosis", "tones", "AROUND", "values of a median"),
    ("diagnosis", "tones", "BESIDE", "width of a line in the padded spectrum"),
    ("diagnosis", "tones", "ORDER", "order of a low-pass"),
    ("diagnosis", "tones", "PADDED", "resolution of a spectrum"),
    ("diagnosis", "torque_noise", "LOWEST", "first point of a figure"),
    ("diagnosis", "torque_noise", "PASSED", "value of an integral"),
    ("diagnosis", "torque_noise", "POINTS", "points of a figure"),
    ("diagnosis", "torque_noise", "POSTURES", "samples of a mean"),
    ("diagnosis", "uncertainty", "ROUNDING", "rounding of eigenvalues"),
    ("effects", "backlash", "SMALL", "where the column of a robot without a gap is taken"),
    ("effects", "backlash", "STEP", "step of a difference"),
    ("effects", "backlash", "TRIALS", "first values of a search, refined afterwards"),
    ("effects", "cable_spring", "LOOP_STEP", "longest step of an iteration"),
    ("effects", "cable_spring", "WAY", "where the column of a robot without a loop is taken"),
    ("effects", "compliance", "LEAST", "keeps a pivot from zero"),
    ("effects", "compliance", "RESISTANCE", "regularisation of an inversion at the resonance"),
    ("effects", "differential_coupling", "RATIOS", "first values of a search, refined afterwards"),
    (
        "effects",
        "direction",
        "BRIEF_S",
        "definition of a reversal, which every column of dry friction shares",
    ),
    ("effects", "friction_temperature_drift", "SHARE_SPEED", "speed of a figure that is reported"),
    ("effects", "friction_temperature_drift", "TIME_STEP", "longest step of an iteration"),
    (
        "effects",
        "friction_temperature_drift",
        "TRIALS_S",
        "first values of a search, refined afterwards",
    ),
    ("effects", "position_dependent_friction", "APART", "spacing of the first values of a search"),
    (
        "effects",
        "presliding_friction",
        "SMALL",
        "where the column of a robot without a way is taken",
    ),
    ("effects", "presliding_friction", "WAY_STEP", "longest step of an iteration"),
    ("effects", "stribeck_friction", "SHARES", "first values of a search, refined afterwards"),
    ("effects", "stribeck_friction", "VELOCITY_STEP", "longest step of an iteration"),
    ("effects", "transmission", "IMPACT_PERIODS", "response of the low-pass, in periods"),
    ("effects", "feedforward", "MOST_STATES", "size of an array"),
    ("effects", "feedforward", "SPACING_S", "step of an integration"),
    ("effects", "lead", "CROSSING_ACCELERATION", "of a compensation, which no diagnosis asks"),
    ("effects", "lead", "H", "step of an integration"),
    ("effects", "lead", "SPACING_S", "step of an integration"),
    ("effects", "differential_coupling", "STEP", "step of a difference"),
    ("effects", "differential_coupling", "WAYS", "the two signs"),
    ("effects", "joint_elasticity", "STEP", "step of a difference"),
    ("effects", "presliding_friction", "STEP", "step of a difference"),
    ("effects", "rigid_bodies", "BATCH", "memory"),
    ("effects", "transmission", "DEPARTURES", "cap of a loop"),
    ("effects", "transmission", "HALVINGS", "iterations of a bisection"),
    ("effects", "transmission", "ROUNDS", "iterations of a fixed point"),
    ("inspection", "fit", "COLUMNS", "size of an array"),
    ("inspection", "judge", "NO_EFFORT", "a floor that nothing exceeds"),
    ("inspection", "pooled", "ROUNDS", "iterations of a weighting"),
    ("inspection", "motion_samples", "ROWS", "resolution of the samples"),
    ("inspection", "motion_samples", "SETTLING", "time over which a filter settles"),
    ("inspection", "scale", "LEAST", "shortest filter"),
    ("inspection", "scale", "LOOKED_AT", "samples of a mean"),
    ("inspection", "sentence", "MOST_STRETCHES", "length of a list in a sentence"),
];

/// Names of the constants of a number in the product's part of a file.
fn numbers(text: &str) -> Vec<&str> {
    let product = text.split("#[cfg(test)]").next().unwrap_or_default();
    let name = |line: &'_ str| -> Option<(usize, usize)> {
        let declared = line.trim_start();
        let start = line.len() - declared.len();
        let declared = declared
            .strip_prefix("pub")
            .map_or(declared, |rest| rest.strip_prefix("(crate)").unwrap_or(rest).trim_start());
        let rest = declared.strip_prefix("const ")?;
        let (name, rest) = rest.split_once(':')?;
        let kind = rest.split('=').next().unwrap_or_default();
        let is_number = ["f64", "f32", "usize", "isize", "u32", "i32", "u64", "i64"]
            .iter()
            .any(|number| kind.contains(number));
        let is_text = kind.contains("str");
        let is_constant =
            name.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_');
        let at = start + line[start..].find(name)?;
        (is_constant && is_number && !is_text).then_some((at, at + name.len()))
    };
    product.lines().filter_map(|line| name(line).map(|(from, to)| &line[from..to])).collect()
}

/// The name of a file without its folder and ending.
fn stem(path: &str) -> &str {
    let name = path.rsplit('/').next().unwrap_or(path);
    name.strip_suffix(".rs").unwrap_or(name)
}

/// Crate, file and name of every constant of a number in the crates that decide.
fn constants() -> BTreeSet<(String, String, String)> {
    let mut all = BTreeSet::new();
    for name in DECIDING {
        let files = rust_files(&format!("crates/{name}/src"));
        for file in files.iter().filter(|file| stem(file) != "testing") {
            let text = text(file);
            let numbers = numbers(&text).into_iter();
            all.extend(numbers.map(|n| (name.to_owned(), stem(file).to_owned(), n.to_owned())));
        }
    }
    all
}

fn known() -> BTreeSet<(String, String, String)> {
    let entry = |a: &str, b: &str, c: &str| (a.to_owned(), b.to_owned(), c.to_owned());
    NUMERICAL.iter().map(|(name, file, number, _)| entry(name, file, number)).collect()
}

#[test]
fn a_number_that_decides_is_a_threshold() {
    let known = known();
    let unknown = constants().into_iter().filter(|constant| !known.contains(constant));
    let broken = unknown.map(|(name, file, number)| {
        format!("{name}: {number} of {file}.rs decides and is no field of a threshold")
    });
    assert_kept(&broken.collect::<Vec<_>>());
}

#[test]
fn a_numerical_constant_that_is_gone_is_not_listed() {
    let constants = constants();
    let gone = known().into_iter().filter(|constant| !constants.contains(constant));
    let broken = gone.map(|(name, file, number)| format!("{name}: no {number} in {file}.rs"));
    assert_kept(&broken.collect::<Vec<_>>());
}

#[test]
fn constants_of_numbers_are_seen_and_texts_and_tests_are_not() {
    let text = "const A: f64 = 1.0;\npub(crate) const B: [f64; 2] = [1.0; 2];\n    const C: (f64, f64) = X;\n\
                const D: [&str; 4] = E;\nconst fn f(x: f64) -> f64 { x }\n#[cfg(test)]\nconst F: usize = 1;";
    assert_eq!(numbers(text), ["A", "B", "C"]);
}
