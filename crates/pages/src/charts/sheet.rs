use askama::Template;

use crate::charts::chart::Ink;
use crate::charts::inks::{Medium, Palette};
use crate::charts::log_axis::round_px;
use crate::text::wrap::{shorten, wrap};

/// Width of a character of the text of a figure, on the wide side (px).
pub const CHARACTER_WIDTH: f64 = 6.7;

/// Left and right edge of what a figure shows, left of it the numbers of an axis (px).
pub const FIGURE_EDGES: [f64; 2] = [70.0, 876.0];

/// Left edge of titles and legends, height of a line, upper edge of the legend in a file and in
/// a page (px).
const LEFT: f64 = 24.0;
const LINE: f64 = 18.0;
const LEGEND: f64 = 88.0;
const LEGEND_IN_PAGE: f64 = 30.0;

/// Characters of the title and of a line below it.
const TITLE_CHARACTERS: usize = 68;
const LINE_CHARACTERS: usize = 118;

/// Something at a height of a drawing (px).
pub struct Stacked<T> {
    /// Its height.
    pub y: f64,
    /// The thing.
    pub item: T,
}

/// A name of the legend with its colour.
#[derive(Debug, Clone)]
pub struct LegendKey {
    /// The name.
    pub name: String,
    /// Whose colour.
    pub ink: Ink,
}

impl LegendKey {
    /// Whether it is that of the noise, which is a line across.
    pub fn is_noise(&self) -> bool {
        self.ink == Ink::Noise
    }

    /// The names of models with the colours that they have everywhere.
    pub fn of_models<'a>(names: impl Iterator<Item = &'a str> + Clone) -> Vec<Self> {
        let inks = Ink::of_models(names.clone());
        names.zip(inks).map(|(name, ink)| Self { name: name.to_owned(), ink }).collect()
    }
}

/// A name of the legend with its place (px).
struct PlacedLegendKey {
    x: f64,
    y: f64,
    name: String,
    colour: String,
}

/// The opening of every figure: a background, a title, lines below it and a legend.
#[derive(Template)]
#[template(path = "sheet.svg")]
pub struct FigureSheet {
    height: f64,
    medium: Medium,
    /// The colours of the figure.
    pub colours: Palette,
    title: String,
    subtitle: Vec<Stacked<String>>,
    legend: Vec<PlacedLegendKey>,
}

impl FigureSheet {
    /// A sheet that ends where its legend does.
    ///
    /// In a page the title only speaks to those who cannot see the figure: what stands above
    /// and below it is told by the page.
    pub fn new(title: &str, subtitle: &str, keys: Vec<LegendKey>, medium: Medium) -> Self {
        let subtitle = match medium {
            Medium::Alone => wrap(subtitle, LINE_CHARACTERS),
            Medium::Page => Vec::new(),
        };
        let top = match medium {
            Medium::Alone => LEGEND + LINE * (subtitle.len() as f64 - 1.0),
            Medium::Page => LEGEND_IN_PAGE,
        };
        let colours = medium.palette();
        let legend = legend(keys, top, &colours);
        Self {
            height: legend.last().map_or(top - LINE, |entry| entry.y),
            medium,
            colours,
            title: shorten(title, TITLE_CHARACTERS),
            subtitle: stack(subtitle, 60.0, LINE),
            legend,
        }
    }

    /// Where it ends (px).
    pub fn bottom(&self) -> f64 {
        self.height
    }

    /// The same, with room down to `bottom` (px).
    pub fn down_to(self, bottom: f64) -> Self {
        Self { height: round_px(bottom), ..self }
    }
}

/// Things below each other.
pub fn stack<T>(items: Vec<T>, top: f64, step: f64) -> Vec<Stacked<T>> {
    let at = |(i, item)| Stacked { y: top + step * i as f64, item };
    items.into_iter().enumerate().map(at).collect()
}

/// Names on as many lines as they need.
fn legend(keys: Vec<LegendKey>, top: f64, colours: &Palette) -> Vec<PlacedLegendKey> {
    let (mut x, mut y) = (LEFT, top);
    let place = |key: LegendKey| {
        let width = 25.0 + CHARACTER_WIDTH * key.name.chars().count() as f64 + 18.0;
        if x > LEFT && x + width > FIGURE_EDGES[1] {
            (x, y) = (LEFT, y + LINE);
        }
        let entry =
            PlacedLegendKey { x: round_px(x), y, colour: colours.of(key.ink), name: key.name };
        x += width;
        entry
    };
    keys.into_iter().map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_legend_takes_the_lines_that_it_needs() {
        let keys = |count, letters| {
            vec![LegendKey { name: "x".repeat(letters), ink: Ink::Model(0) }; count]
        };
        // 25 + 10 x 6.7 + 18 = 110 px each, seven of them between 24 and 876 px.
        let sheet = FigureSheet::new("t", "s", keys(8, 10), Medium::Alone);
        let places: Vec<[f64; 2]> = sheet.legend.iter().map(|k| [k.x, k.y]).collect();
        assert_eq!(places[..2], [[24.0, 88.0], [134.0, 88.0]]);
        assert_eq!(places[6..], [[684.0, 88.0], [24.0, 106.0]]);
        assert!((sheet.bottom() - 106.0).abs() < 1e-9);
        // A name that is wider than the sheet has a line of its own.
        let wide = FigureSheet::new("t", "s", keys(2, 200), Medium::Alone);
        assert!((wide.bottom() - 106.0).abs() < 1e-9);
    }
}
