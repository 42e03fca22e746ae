//! Numbers that decide an answer are fields of the thresholds, where a test can vary one: a constant of a number in the
//! crates that decide is purely numerical, and has its reason here. So is a number inside a function that judges logs.

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
    ("diagnosis", "late_goals", "HALVINGS", "steps of a search"),
    ("diagnosis", "late_goals", "STEP_S", "step of a scan"),
    ("diagnosis", "late_goals", "STEPS", "length of a scan"),
    ("diagnosis", "select_model", "ROUNDS", "cap of a loop that ends when nothing changes"),
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
    ("diagnosis", "repeats", "FEW", "samples that are asked first"),
    ("diagnosis", "repeats", "PIECE", "samples between two looks at a sum"),
    ("diagnosis", "repeats", "ROUNDING", "rounding of a sum"),
    ("diagnosis", "select", "ROUNDS", "cap of a loop that ends when nothing changes"),
    ("diagnosis", "shapes", "AT_ONCE", "memory"),
    ("diagnosis", "structure", "KNOTS", "resolution of a piecewise linear function"),
    ("diagnosis", "structure", "LISTED", "length of a list in the report"),
    ("diagnosis", "structure", "SPREADS", "grid of a search"),
    ("diagnosis", "tone_finding", "HALF_WIDTH", "quantile of the normal distribution at .975"),
    ("diagnosis", "tone_fit", "ROUNDS", "iterations of Gauss-Newton, which converge in three"),
    ("diagnosis", "spectral_lines", "AROUND", "values of a median"),
    ("diagnosis", "spectral_lines", "BESIDE", "width of a line in the padded spectrum"),
    ("diagnosis", "tones", "NEAR", "grid on which the top of a line is found"),
    ("diagnosis", "run_parts", "ORDER", "order of a low-pass"),
    ("diagnosis", "tones", "PADDED", "resolution of a spectrum"),
    ("diagnosis", "torque_noise", "LOWEST", "first point of a figure"),
    ("diagnosis", "torque_noise", "PASSED", "value of an integral"),
    ("diagnosis", "torque_noise", "POINTS", "points of a figure"),
    ("diagnosis", "torque_noise", "POSTURES", "samples of a mean"),
    ("diagnosis", "turning_sum", "LANES", "terms summed side by side"),
    ("diagnosis", "uncertainty", "ROUNDING", "rounding of eigenvalues"),
    ("effects", "backlash", "SMALL", "where the column of a robot without a gap is taken"),
    ("effects", "backlash", "STEP", "step of a difference"),
    ("effects", "backlash", "TRIALS", "first values of a search, refined afterwards"),
    ("effects", "cable_spring", "LOOP_STEP", "longest step of an iteration"),
    ("effects", "cable_spring", "WAY", "where the column of a robot without a loop is taken"),
    ("effects", "compliance", "LEAST", "keeps a pivot from zero"),
    ("effects", "compliance", "RESISTANCE", "regularisation of an inversion at the resonance"),
    ("effects", "compliance", "LEAST_SWING", "stability of differences in time"),
    ("effects", "joint_elasticity", "DAMPING_STEP", "limits of one step of a fit"),
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
    ("inspection", "sentence", "MOST_SHARE", "digits of printed numbers"),
    ("inspection", "fit", "COLUMNS", "size of an array"),
    ("inspection", "judge", "NO_EFFORT", "a floor that nothing exceeds"),
    ("inspection", "normalised", "LARGEST", "what 100 is as degrees"),
    ("inspection", "pooled", "ROUNDS", "iterations of a weighting"),
    ("inspection", "motion_samples", "ROWS", "resolution of the samples"),
    ("inspection", "motion_samples", "SETTLING", "time over which a filter settles"),
    ("inspection", "scale", "LEAST", "shortest filter"),
    ("inspection", "scale", "LOOKED_AT", "samples of a mean"),
    ("inspection", "sentence", "MOST_STRETCHES", "length of a list in a sentence"),
    ("inspection", "sentence", "MOST_ZEROS", "length of a list in a sentence"),
    ("inspection", "spikes", "NORMAL_QUANTILE_55", "quantile of the normal distribution at .55"),
    ("inspection", "zeros", "RIDGE", "rounding of least squares"),
];

/// Where functions judge logs by numbers, and the crate that each is of.
const JUDGING: [(&str, &str); 5] = [
    ("diagnosis", "crates/diagnosis/src/oscillations"),
    ("diagnosis", "crates/diagnosis/src/outcome"),
    ("diagnosis", "crates/diagnosis/src/readiness"),
    ("diagnosis", "crates/diagnosis/src/search"),
    ("inspection", "crates/inspection/src"),
];

/// Numbers that stand in any formula: signs, halves, squares, degrees in half a turn, per cents, thousands.
const IN_FORMULAS: [f64; 7] = [0.0, 0.5, 1.0, 2.0, 100.0, 180.0, 1e3];

/// Largest number that only keeps rounding from counting.
const ROUNDING: f64 = 1e-6;

/// Other numbers inside functions that no answer hangs on, by the names of crate, file and number, and why.
const IN_FUNCTIONS: &[(&str, &str, &str, &str)] = &[
    ("diagnosis", "limits", "1.5", "growth of the steps of a search"),
    ("diagnosis", "limits", "1e-4", "tolerance of an iteration, and first step of a search"),
    ("diagnosis", "limits", "3.0", "thirds of a bracket"),
    ("diagnosis", "size", "0.001", "digits of a printed number"),
    ("diagnosis", "spectrum", "0.375", "mean square of a Hann window"),
    ("diagnosis", "tones", "0.1", "refinement of a grid"),
    ("diagnosis", "tones", "0.25", "spacing of a grid, which is refined"),
    ("diagnosis", "tones", "4.0", "number of points of that grid"),
    ("inspection", "motion_samples", "0.45", "keeps a cut-off below half the rate"),
    ("inspection", "sentence", "1e-2", "digits of a printed number"),
    ("inspection", "sentence", "1e5", "digits of a printed number"),
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

/// The product's part of a file without constants, comments and texts.
fn code(text: &str) -> String {
    let product = text.split("#[cfg(test)]").next().unwrap_or_default();
    let mut in_constant = false;
    let is_code = |line: &&str| {
        let start = line.trim_start();
        let start =
            start.strip_prefix("pub ").or(start.strip_prefix("pub(crate) ")).unwrap_or(start);
        let begins = start.starts_with("const ") && !start.starts_with("const fn");
        let is_code = !in_constant && !begins && !start.starts_with("//");
        in_constant = (in_constant || begins) && !line.trim_end().ends_with(';');
        is_code
    };
    let lines = product.lines().filter(is_code).collect::<Vec<_>>().join("\n");
    let lines = lines.replace("\\\"", "").replace("'\"'", "");
    lines.split('"').step_by(2).collect::<Vec<_>>().join("\"\"")
}

/// The decimal numbers of some code, as they are written.
fn decimals(code: &str) -> Vec<&str> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let bytes = code.as_bytes();
    let mut all = Vec::new();
    let mut at = 0;
    while let Some(start) = code[at..].find(|c: char| c.is_ascii_digit()).map(|found| at + found) {
        let digits =
            |from: usize| from + bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
        let is_digit = |k: usize| bytes.get(k).is_some_and(u8::is_ascii_digit);
        let mut end = digits(start);
        if bytes.get(end) == Some(&b'.') && is_digit(end + 1) {
            end = digits(end + 1);
        }
        if bytes.get(end) == Some(&b'e') {
            let power = end + 1 + usize::from(bytes.get(end + 1) == Some(&b'-'));
            end = if is_digit(power) { digits(power) } else { end };
        }
        let is_own = !code[..start].ends_with(|c: char| is_part(c) && c != '.')
            && (!code[..start].ends_with('.') || code[..start].ends_with(".."));
        let number = &code[start..end];
        if is_own && number.contains(['.', 'e']) {
            all.push(number);
        }
        at = end;
    }
    all
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

/// Crate, file and number of every decimal number that stands in no formula, of the functions that judge logs.
fn in_functions() -> BTreeSet<(String, String, String)> {
    let mut all = BTreeSet::new();
    for (name, folder) in JUDGING {
        let files = rust_files(folder);
        for file in files.iter().filter(|file| !["testing", "thresholds"].contains(&stem(file))) {
            let code = code(&text(file));
            let decides = |number: &&str| {
                let value: f64 = number.parse().unwrap_or(f64::NAN);
                let is_in_formula = |known: &f64| known.total_cmp(&value).is_eq();
                value > ROUNDING && !IN_FORMULAS.iter().any(is_in_formula)
            };
            let numbers = decimals(&code).into_iter().filter(decides);
            all.extend(numbers.map(|n| (name.to_owned(), stem(file).to_owned(), n.to_owned())));
        }
    }
    all
}

#[test]
fn a_number_inside_a_function_that_judges_logs_is_a_threshold() {
    let entry =
        |&(a, b, c, _): &(&str, &str, &str, &str)| (a.to_owned(), b.to_owned(), c.to_owned());
    let known: BTreeSet<_> = IN_FUNCTIONS.iter().map(entry).collect();
    let found = in_functions();
    let unknown = found.difference(&known).map(|(name, file, number)| {
        format!("{name}: {number} inside {file}.rs decides and is no field of a threshold")
    });
    let gone = known
        .difference(&found)
        .map(|(name, file, number)| format!("{name}: no {number} inside {file}.rs"));
    assert_kept(&unknown.chain(gone).collect::<Vec<_>>());
}

#[test]
fn decimal_numbers_of_functions_are_seen_and_texts_and_constants_are_not() {
    let text = "const A: f64 = 1.5;\npub const B: [f64; 2] = [\n    2.5,\n];\n// 3.5\nlet x = 4.5 * y.0 + z1.0;\n\
                f(\"5.5 \\\" 6.5\", 7e-3, 8, '\"', 9.0_f64, 0..10);\n#[cfg(test)]\nlet x = 11.5;";
    assert_eq!(decimals(&code(text)), ["4.5", "7e-3", "9.0"]);
}

#[test]
fn constants_of_numbers_are_seen_and_texts_and_tests_are_not() {
    let text = "const A: f64 = 1.0;\npub(crate) const B: [f64; 2] = [1.0; 2];\n    const C: (f64, f64) = X;\n\
                const D: [&str; 4] = E;\nconst fn f(x: f64) -> f64 { x }\n#[cfg(test)]\nconst F: usize = 1;";
    assert_eq!(numbers(text), ["A", "B", "C"]);
}
