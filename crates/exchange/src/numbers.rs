//! Numbers as these files have them: the shortest text that is read as the same number.

use nalgebra::Matrix3;

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

/// A number with four digits, for sentences.
pub fn size(value: f64) -> String {
    if value.abs() > 0.0 && !(1e-3..1e5).contains(&value.abs()) {
        return format!("{value:.3e}");
    }
    let rounded = format!("{value:.4}");
    rounded.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A time (s) in ms, from 1 ms on without what is below .01 ms.
pub fn milliseconds(time_s: f64) -> f64 {
    let ms = 1e3 * time_s;
    if ms.abs() < 1.0 { ms } else { (1e2 * ms).round() / 1e2 }
}

/// The entries of a moment of inertia (kg·m²) by the names that URDF and SDF give them.
pub fn moments(about_com: &Matrix3<f64>) -> [(&'static str, String); 6] {
    let i = about_com;
    let named = [
        ("ixx", i.m11),
        ("ixy", i.m12),
        ("ixz", i.m13),
        ("iyy", i.m22),
        ("iyz", i.m23),
        ("izz", i.m33),
    ];
    named.map(|(name, value)| (name, number(value)))
}
