//! Numbers as these files have them: the shortest text that is read as the same number.

/// One number.
pub fn number(value: f64) -> String {
    // An addition turns -0 into 0.
    let value = value + 0.0;
    let is_small = value.abs() > 0.0 && value.abs() < 1e-4;
    if is_small || value.abs() >= 1e15 { format!("{value:e}") } else { format!("{value}") }
}

/// Numbers with blanks between them.
pub fn numbers<'a>(values: impl IntoIterator<Item = &'a f64>) -> String {
    values.into_iter().map(|v| number(*v)).collect::<Vec<_>>().join(" ")
}

/// A size in words: four digits.
pub fn size(value: f64) -> String {
    if value.abs() > 0.0 && !(1e-3..1e5).contains(&value.abs()) {
        return format!("{value:.3e}");
    }
    let rounded = format!("{value:.4}");
    rounded.trim_end_matches('0').trim_end_matches('.').to_owned()
}
