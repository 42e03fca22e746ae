/// Colours of up to ten models, told apart by eyes that see few colours (Petroff 2021).
pub const COLOURS: [&str; 10] = [
    "#3f90da", "#ffa90e", "#bd1f01", "#832db6", "#a96b59", "#92dadd", "#e76300", "#b9ac70",
    "#94a4a2", "#717581",
];

/// Width of a character of the text of a figure, on the wide side (px).
pub const CHARACTER: f64 = 6.7;

/// Something at a height of a drawing (px).
pub struct Placed<T> {
    /// Its height.
    pub y: f64,
    /// The thing.
    pub item: T,
}
