use std::fmt;

/// Red, green and blue (sRGB, 8 bit). Written as SVG and CSS read it: `#0072b2`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rgb(pub [u8; 3]);

impl fmt::Display for Rgb {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [r, g, b] = self.0;
        write!(f, "#{r:02x}{g:02x}{b:02x}")
    }
}

/// A colour on a light and on a dark ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Colour {
    /// On white: paper, a light page.
    pub on_white: Rgb,
    /// On nearly black: a dark page, the viewer of recordings.
    pub on_dark: Rgb,
}

impl Colour {
    /// The colour `0xrrggbb` on white and on dark.
    pub(crate) const fn new(on_white: u32, on_dark: u32) -> Self {
        Self { on_white: rgb(on_white), on_dark: rgb(on_dark) }
    }
}

const fn rgb(hex: u32) -> Rgb {
    let [_, r, g, b] = hex.to_be_bytes();
    Rgb([r, g, b])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour_is_written_as_pages_read_it() {
        assert_eq!(Colour::new(0x0072b2, 0).on_white, Rgb([0, 0x72, 0xb2]));
        assert_eq!(Rgb([0, 0x72, 0xb2]).to_string(), "#0072b2");
    }
}
