use askama::Template;

use crate::charts::chart::Ink;
use crate::charts::inks::{Medium, Palette};
use crate::charts::log_axis::{AxisTick, LogAxis};
use crate::charts::sheet::{FIGURE_EDGES, FigureSheet, LegendKey};
use crate::html::render::render_html;
use crate::output::error::ReportError;
use crate::text::numbers::significant;
use crate::text::wrap::shorten;

/// Height of a joint, and of what stands above the first and below the last (px).
const ROW: f64 = 36.0;
const ABOVE: f64 = 24.0;
const BELOW: f64 = 44.0;

/// Where in a row its dots lie, below its name (px).
const LINE: f64 = 24.0;

/// Powers of ten that the axis spans at most.
const MOST_DECADES: i32 = 8;

/// Characters of the name of a joint.
const NAME_CHARACTERS: usize = 48;

/// A number for every joint and model, as dots on a logarithmic axis, a row a joint.
pub struct Dots {
    /// What it shows, in a few words.
    pub title: String,
    /// More words, below the title.
    pub subtitle: String,
    /// The quantity, as it stands at the axis.
    pub axis: &'static str,
    /// The models.
    pub keys: Vec<LegendKey>,
    /// The joints.
    pub joints: Vec<JointDots>,
    /// A number to compare with, and what it means.
    pub mark: Option<(f64, &'static str)>,
}

/// The dots of one joint.
pub struct JointDots {
    /// Its name.
    pub name: String,
    /// One number a model; one that is not finite has no dot.
    pub values: Vec<f64>,
    /// The same quantity of the noise, where it is known.
    pub floor: Option<f64>,
}

impl Dots {
    /// The dots as SVG, for a page with a legend above it.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn draw(&self, medium: Medium) -> Result<String, ReportError> {
        let area = Area::new(self, medium);
        match medium {
            Medium::Page => render_html(&InPage { keys: self.keys(), area }),
            Medium::Alone => {
                let keys = self.keys();
                let sheet = FigureSheet::new(&self.title, &self.subtitle, keys, medium);
                let top = sheet.bottom() + ABOVE;
                let sheet = sheet.down_to(top + area.height + BELOW);
                render_html(&Alone { x: FIGURE_EDGES, top, sheet, area })
            }
        }
    }

    /// The names of the legend: the models, and the noise where it is known.
    fn keys(&self) -> Vec<LegendKey> {
        let floor = self.joints.iter().any(|joint| joint.floor.is_some());
        let noise = floor.then(|| LegendKey { name: "noise floor".to_owned(), ink: Ink::Noise });
        self.keys.iter().cloned().chain(noise).collect()
    }
}

/// In a page: a legend and an area as wide as the page.
#[derive(Template)]
#[template(path = "dots.html")]
struct InPage {
    keys: Vec<LegendKey>,
    area: Area,
}

/// In a file of its own.
#[derive(Template)]
#[template(path = "dots.svg")]
struct Alone {
    x: [f64; 2],
    top: f64,
    sheet: FigureSheet,
    area: Area,
}

/// The rows between the axes; numbers stand below.
#[derive(Template)]
#[template(path = "dots_area.svg")]
struct Area {
    words: String,
    axis: &'static str,
    colours: Palette,
    height: f64,
    /// Places are shares of the width (%).
    ticks: Vec<AxisTick>,
    mark: Option<(f64, &'static str)>,
    rows: Vec<Row>,
}

struct Row {
    /// Baseline of its name and height of its dots (px).
    name_y: f64,
    y: f64,
    name: String,
    /// From the least to the largest of its numbers (%).
    span: Option<[f64; 2]>,
    /// Where the noise lies, and what it is.
    floor: Option<(f64, String)>,
    dots: Vec<Dot>,
}

struct Dot {
    x: f64,
    colour: String,
    words: String,
}

impl Area {
    fn new(dots: &Dots, medium: Medium) -> Self {
        let floors = dots.joints.iter().filter_map(|joint| joint.floor);
        let values = dots.joints.iter().flat_map(|joint| joint.values.iter().copied());
        let axis = LogAxis::over_decades(values.chain(floors), MOST_DECADES, [0.0, 100.0]);
        let colours = medium.palette();
        let rows = dots.joints.iter().enumerate();
        let row = |(i, joint)| Row::new(&dots.keys, joint, axis.as_ref(), i, &colours);
        Self {
            words: format!("{}: {}, the numbers of every dot in the table", dots.title, dots.axis),
            axis: dots.axis,
            height: ROW * dots.joints.len() as f64,
            ticks: axis.map(|axis| axis.ticks()).unwrap_or_default(),
            mark: axis
                .zip(dots.mark)
                .filter(|(axis, m)| axis.holds(m.0))
                .map(|(axis, m)| (axis.at(m.0), m.1)),
            rows: rows.map(row).collect(),
            colours,
        }
    }
}

impl Row {
    fn new(
        keys: &[LegendKey],
        joint: &JointDots,
        axis: Option<&LogAxis>,
        index: usize,
        colours: &Palette,
    ) -> Self {
        let top = ROW * index as f64;
        let told =
            |name: &str, value: f64| format!("{}, {name}: {}", joint.name, significant(value, 3));
        let known = keys.iter().zip(&joint.values).filter(|(_, value)| value.is_finite());
        let dots: Vec<Dot> = axis
            .into_iter()
            .flat_map(|axis| {
                known.clone().map(|(key, &value)| Dot {
                    x: axis.at(value),
                    colour: colours.of(key.ink),
                    words: told(&key.name, value),
                })
            })
            .collect();
        let ends = dots.iter().map(|dot| dot.x);
        let span = ends.clone().reduce(f64::min).zip(ends.reduce(f64::max));
        let floor = axis.zip(joint.floor).filter(|(axis, floor)| axis.holds(*floor));
        Self {
            name_y: top + 13.0,
            y: top + LINE,
            name: shorten(&joint.name, NAME_CHARACTERS),
            span: span.map(|(low, high)| [low, high]),
            floor: floor.map(|(axis, floor)| (axis.at(floor), told("noise floor", floor))),
            dots,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::text_of_xml;

    /// Two joints and three models, one of which knows nothing of the second joint.
    fn dots() -> Dots {
        let key =
            |(index, name): (usize, &str)| LegendKey { name: name.into(), ink: Ink::Model(index) };
        let joint = |name: &str, values: [f64; 3]| JointDots {
            name: name.into(),
            values: values.to_vec(),
            floor: None,
        };
        Dots {
            title: "t".into(),
            subtitle: "s".into(),
            axis: "nMSE",
            keys: ["rbd", "gp", "gp-rbd"].into_iter().enumerate().map(key).collect(),
            joints: vec![
                joint("shoulder", [0.1, 0.01, 0.001]),
                joint("elbow", [f64::NAN, 0.02, 0.02]),
            ],
            mark: Some((0.01, "here")),
        }
    }

    #[test]
    fn a_dot_lies_where_its_number_does_and_what_is_not_a_number_has_none() {
        let mut dots = dots();
        dots.joints[0].floor = Some(0.001);
        let area = Area::new(&dots, Medium::Alone);
        let [shoulder, elbow] = &area.rows[..] else { panic!("two joints") };
        assert_eq!((shoulder.dots.len(), elbow.dots.len()), (3, 2));
        // 0.1, 0.01 and 0.001 on an axis from 0.0001 to 0.1.
        let places: Vec<f64> = shoulder.dots.iter().map(|dot| dot.x).collect();
        assert_eq!(places, [100.0, 66.7, 33.3]);
        assert_eq!(shoulder.span, Some([33.3, 100.0]));
        assert_eq!(shoulder.dots[1].words, "shoulder, gp: 0.0100");
        assert_eq!(shoulder.floor, Some((33.3, "shoulder, noise floor: 0.00100".into())));
        assert_eq!(area.mark, Some((66.7, "here")));
    }

    #[test]
    fn a_figure_without_a_number_has_rows_without_dots() {
        let mut dots = dots();
        dots.joints.iter_mut().for_each(|joint| joint.values.clear());
        let area = Area::new(&dots, Medium::Alone);
        assert!(area.rows.iter().all(|row| row.dots.is_empty() && row.span.is_none()));
        text_of_xml(&dots.draw(Medium::Alone).unwrap());
        dots.joints.clear();
        text_of_xml(&dots.draw(Medium::Alone).unwrap());
    }

    #[test]
    fn a_page_has_a_legend_and_its_own_colours() {
        let mut dots = dots();
        dots.joints[1].floor = Some(0.01);
        let page = dots.draw(Medium::Page).unwrap();
        for expected in ["</i>gp-rbd", "</i>noise floor", "var(--model2)"] {
            assert!(page.contains(expected), "{expected} is missing in {page}");
        }
        assert!(!page.contains("http"));
    }
}
