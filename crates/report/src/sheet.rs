use askama::Template;

use crate::chart::Ink;
use crate::inks::{Colours, Place};
use crate::log_axis::rounded;
use crate::wrap::{shortened, wrapped};

/// Width of a character of the text of a figure, on the wide side (px).
pub const CHARACTER: f64 = 6.7;

/// Left and right edge of what a figure shows, left of it the numbers of an axis (px).
pub const EDGES: [f64; 2] = [70.0, 876.0];

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
pub struct Placed<T> {
    /// Its height.
    pub y: f64,
    /// The thing.
    pub item: T,
}

/// A name of the legend with its colour.
#[derive(Debug, Clone)]
pub struct Key {
    /// The name.
    pub name: String,
    /// Whose colour.
    pub ink: Ink,
}

impl Key {
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
pub struct PlacedKey {
    x: f64,
    y: f64,
    name: String,
    colour: String,
}

/// The opening of every figure: a background, a title, lines below it and a legend.
#[derive(Template)]
#[template(path = "sheet.svg")]
pub struct Sheet {
    height: f64,
    place: Place,
    /// The colours of the figure.
    pub colours: Colours,
    title: String,
    subtitle: Vec<Placed<String>>,
    legend: Vec<PlacedKey>,
}

impl Sheet {
    /// A sheet that ends where its legend does.
    ///
    /// In a page the title only speaks to those who cannot see the figure: what stands above
    /// and below it is told by the page.
    pub fn new(title: &str, subtitle: &str, keys: Vec<Key>, place: Place) -> Self {
        let subtitle = match place {
            Place::Alone => wrapped(subtitle, LINE_CHARACTERS),
            Place::Page => Vec::new(),
        };
        let top = match place {
            Place::Alone => LEGEND + LINE * (subtitle.len() as f64 - 1.0),
            Place::Page => LEGEND_IN_PAGE,
        };
        let colours = place.colours();
        let legend = legend(keys, top, &colours);
        Self {
            height: legend.last().map_or(top - LINE, |entry| entry.y),
            place,
            colours,
            title: shortened(title, TITLE_CHARACTERS),
            subtitle: placed(subtitle, 60.0, LINE),
            legend,
        }
    }

    /// Where it ends (px).
    pub fn bottom(&self) -> f64 {
        self.height
    }

    /// The same, with room down to `bottom` (px).
    pub fn down_to(self, bottom: f64) -> Self {
        Self { height: rounded(bottom), ..self }
    }
}

/// Things below each other.
pub fn placed<T>(items: Vec<T>, top: f64, step: f64) -> Vec<Placed<T>> {
    let at = |(i, item)| Placed { y: top + step * i as f64, item };
    items.into_iter().enumerate().map(at).collect()
}

/// Names on as many lines as they need.
fn legend(keys: Vec<Key>, top: f64, colours: &Colours) -> Vec<PlacedKey> {
    let (mut x, mut y) = (LEFT, top);
    let place = |key: Key| {
        let width = 25.0 + CHARACTER * key.name.chars().count() as f64 + 18.0;
        if x > LEFT && x + width > EDGES[1] {
            (x, y) = (LEFT, y + LINE);
        }
        let entry = PlacedKey { x: rounded(x), y, colour: colours.of(key.ink), name: key.name };
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
        let keys =
            |count, letters| vec![Key { name: "x".repeat(letters), ink: Ink::Model(0) }; count];
        // 25 + 10 x 6.7 + 18 = 110 px each, seven of them between 24 and 876 px.
        let sheet = Sheet::new("t", "s", keys(8, 10), Place::Alone);
        let places: Vec<[f64; 2]> = sheet.legend.iter().map(|k| [k.x, k.y]).collect();
        assert_eq!(places[..2], [[24.0, 88.0], [134.0, 88.0]]);
        assert_eq!(places[6..], [[684.0, 88.0], [24.0, 106.0]]);
        assert!((sheet.bottom() - 106.0).abs() < 1e-9);
        // A name that is wider than the sheet has a line of its own.
        let wide = Sheet::new("t", "s", keys(2, 200), Place::Alone);
        assert!((wide.bottom() - 106.0).abs() < 1e-9);
    }
}
