//! How far apart colours are for eyes with three cones and with two.

use crate::colour::Rgb;

/// Linear sRGB as seen without one of the cones: Machado, Oliveira & Fernandes, *A Physiologically-based
/// Model for Simulation of Color Vision Deficiency*, IEEE TVCG 15(6), 2009, severity 1.0; and as it is.
const EYES: [[[f64; 3]; 3]; 4] = [
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    [
        [0.152286, 1.052583, -0.204868],
        [0.114503, 0.786281, 0.099216],
        [-0.003882, -0.048116, 1.051998],
    ],
    [
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ],
    [
        [1.255528, -0.076749, -0.178779],
        [-0.078411, 0.930809, 0.147602],
        [0.004733, 0.691367, 0.303900],
    ],
];

/// Linear sRGB to CIE XYZ over the white point D65 (IEC 61966-2-1).
const XYZ: [[f64; 3]; 3] = [
    [0.4124564 / 0.95047, 0.3575761 / 0.95047, 0.1804375 / 0.95047],
    [0.2126729, 0.7151522, 0.0721750],
    [0.0193339 / 1.08883, 0.1191920 / 1.08883, 0.9503041 / 1.08883],
];

/// Contrast of WCAG 2.1: `(L1 + 0.05) / (L2 + 0.05)` of the relative luminances, 1 to 21.
pub fn contrast(a: Rgb, b: Rgb) -> f64 {
    let [a, b] = [a, b].map(|colour| times(XYZ, linear(colour))[1] + 0.05);
    a.max(b) / a.min(b)
}

/// Least CIE76 difference of two colours over all eyes.
pub fn least_difference(a: Rgb, b: Rgb) -> f64 {
    let difference = |eye| {
        let [a, b] = [a, b].map(|colour| lab(times(eye, linear(colour))));
        a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
    };
    EYES.into_iter().map(difference).fold(f64::INFINITY, f64::min)
}

fn linear(colour: Rgb) -> [f64; 3] {
    colour.0.map(|c| {
        let c = f64::from(c) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    })
}

fn times(matrix: [[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row.iter().zip(v).map(|(a, b)| a * b).sum())
}

/// CIE L*a*b* of a linear colour.
fn lab(linear: [f64; 3]) -> [f64; 3] {
    let f = |t: f64| {
        let edge = 6.0 / 29.0_f64;
        if t > edge.powi(3) { t.cbrt() } else { t / (3.0 * edge * edge) + 4.0 / 29.0 }
    };
    let [x, y, z] = times(XYZ, linear.map(|c| c.clamp(0.0, 1.0))).map(f);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

#[test]
fn black_on_white_has_the_contrast_and_the_difference_of_the_standards() {
    let (black, white) = (Rgb([0; 3]), Rgb([255; 3]));
    assert!((contrast(black, white) - 21.0).abs() < 1e-4);
    assert!((least_difference(black, white) - 100.0).abs() < 0.1);
}
