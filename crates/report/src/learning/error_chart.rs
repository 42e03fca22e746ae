use askama::Template;

use super::chart::{CHARACTER, COLOURS, Placed};
use super::comparison::Comparison;
use super::log_axis::{LogAxis, Tick, rounded};
use crate::ReportError;
use crate::draw::Colours;
use crate::numbers::significant;
use crate::wrap::{shortened, wrapped};

/// Left and right edge of the bars, height of a panel of bars, and of what stands between two
/// panels (px).
const EDGES: [f64; 2] = [70.0, 876.0];
const PANEL: f64 = 210.0;
const BETWEEN: f64 = 54.0;

/// Upper edge of the legend, and height of a line of text (px).
const LEGEND: f64 = 88.0;
const LINE: f64 = 18.0;

/// Joints beside each other in one panel; more are spread over several.
const MOST_JOINTS: usize = 8;

/// Share of the width of a joint that its bars fill, and width of the widest bar (px).
const FILLED: f64 = 0.84;
const WIDEST: f64 = 18.0;

/// Powers of ten that the axis spans at most.
const MOST_DECADES: i32 = 8;

/// Characters of the title and of a line below it.
const TITLE_CHARACTERS: usize = 68;
const LINE_CHARACTERS: usize = 118;

#[derive(Template)]
#[template(path = "errors.svg")]
struct Drawing {
    height: f64,
    colours: Colours,
    title: String,
    subtitle: Vec<Placed<String>>,
    legend: Vec<LegendEntry>,
    panels: Vec<Panel>,
    left: f64,
    right: f64,
}

struct LegendEntry {
    x: f64,
    y: f64,
    colour: &'static str,
    name: String,
}

/// The bars of some joints.
struct Panel {
    top: f64,
    bottom: f64,
    ticks: Vec<Tick>,
    /// Where the variance of the effort lies, if it is on the axis.
    variance: Option<f64>,
    groups: Vec<Group>,
}

/// The bars of one joint.
struct Group {
    middle: f64,
    /// Its name, on one line or two.
    name: [String; 2],
    bars: Vec<Bar>,
}

struct Bar {
    x: f64,
    y: f64,
    width: f64,
    height: f64,
    colour: &'static str,
    words: String,
}

impl Comparison {
    /// `figure.svg`: the error of every model at every joint as bars on a logarithmic axis, as
    /// in figure 2 of Nguyen-Tuong & Peters 2010, in a drawing that stands alone.
    ///
    /// Shows the first ten models.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn figure(&self) -> Result<String, ReportError> {
        let drawing = Drawing::new(self);
        drawing.render().map_err(|e| ReportError::Format { format: "SVG", reason: e.to_string() })
    }

    fn subtitle(&self) -> String {
        format!(
            "MSE over variance of the effort on {} held-out samples, trained on {} of {}; logarithmic, lower is better",
            self.test.points, self.train.points, self.train.rows
        )
    }
}

impl Drawing {
    fn new(comparison: &Comparison) -> Self {
        let lines = wrapped(&comparison.subtitle(), LINE_CHARACTERS);
        let legend_top = LEGEND + LINE * (lines.len() as f64 - 1.0);
        let subtitle = lines.into_iter().enumerate();
        let subtitle = subtitle.map(|(i, item)| Placed { y: 60.0 + LINE * i as f64, item });
        let (legend, legend_bottom) = legend(comparison, legend_top);
        let panels = panels(comparison, legend_bottom + 22.0);
        let bottom = panels.last().map_or(legend_bottom, |panel| panel.bottom);
        Self {
            height: bottom + BETWEEN,
            colours: Colours::ON_WHITE,
            title: shortened(
                &format!("{}: error of learned models by joint", comparison.robot),
                TITLE_CHARACTERS,
            ),
            subtitle: subtitle.collect(),
            legend,
            panels,
            left: EDGES[0],
            right: EDGES[1],
        }
    }
}

/// The names of the models with their colours, on as many lines as they need, and the height
/// of the last one.
fn legend(comparison: &Comparison, top: f64) -> (Vec<LegendEntry>, f64) {
    let (mut x, mut y) = (24.0, top);
    let entries = comparison.models.iter().zip(COLOURS).map(|(model, colour)| {
        let width = 25.0 + CHARACTER * model.name.chars().count() as f64 + 18.0;
        if x + width > EDGES[1] {
            (x, y) = (24.0, y + LINE);
        }
        let entry = LegendEntry { x: rounded(x), y, colour, name: model.name.clone() };
        x += width;
        entry
    });
    let entries = entries.collect();
    (entries, y)
}

/// The joints in panels of about the same number, all with the same axis.
fn panels(comparison: &Comparison, top: f64) -> Vec<Panel> {
    let joints = comparison.joints.len();
    let rows = joints.div_ceil(MOST_JOINTS).max(1);
    let columns = joints.div_ceil(rows).max(1);
    let panels = (0..rows).map_while(|row| {
        let top = top + row as f64 * (PANEL + BETWEEN);
        let errors = comparison.models.iter().flat_map(|model| model.nmse.iter().copied());
        let axis = LogAxis::over_decades(errors, MOST_DECADES, [top + PANEL, top])?;
        let width = (EDGES[1] - EDGES[0]) / columns as f64;
        let members = (row * columns..joints.min((row + 1) * columns)).enumerate();
        Some(Panel {
            top,
            bottom: top + PANEL,
            ticks: axis.ticks(),
            variance: axis.holds(1.0).then(|| axis.at(1.0)),
            groups: members
                .map(|(place, joint)| {
                    group(comparison, joint, &axis, [EDGES[0] + width * place as f64, width])
                })
                .collect(),
        })
    });
    panels.collect()
}

/// The bars of one joint between `left` and `left + width`.
fn group(comparison: &Comparison, joint: usize, axis: &LogAxis, [left, width]: [f64; 2]) -> Group {
    let models = comparison.models.iter().zip(COLOURS);
    let step = (FILLED * width / models.len() as f64).min(WIDEST);
    let start = left + 0.5 * (width - step * models.len() as f64);
    let floor = axis.at(0.0);
    let name = &comparison.joints[joint].name;
    let bars = models.enumerate().filter_map(|(place, (model, colour))| {
        let nmse = *model.nmse.get(joint)?;
        nmse.is_finite().then(|| Bar {
            x: rounded(start + step * place as f64),
            y: axis.at(nmse),
            width: rounded(0.88 * step),
            height: rounded(floor - axis.at(nmse)),
            colour,
            words: format!("{name}, {}: {}", model.name, significant(nmse, 3)),
        })
    });
    let fits = ((width - 6.0) / CHARACTER) as usize;
    Group { middle: rounded(left + 0.5 * width), name: two_lines(name, fits), bars: bars.collect() }
}

/// A name on one line of `most` characters, or on two, broken behind the last `_`, `-` or `/`
/// that fits.
fn two_lines(name: &str, most: usize) -> [String; 2] {
    if name.chars().count() <= most {
        return [name.to_owned(), String::new()];
    }
    let ends = name.char_indices().take(most).map(|(at, c)| (at + c.len_utf8(), c));
    let (mut cut, mut whole) = (0, 0);
    for (end, c) in ends {
        whole = end;
        if matches!(c, '_' | '-' | '/') {
            cut = end;
        }
    }
    let (first, second) = name.split_at(if cut == 0 { whole } else { cut });
    [first.to_owned(), shortened(second, most)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learning::sample;
    use crate::sample::text_of_xml;

    #[test]
    fn a_bar_is_as_high_as_its_error_and_what_is_not_a_number_has_none() {
        let drawing = Drawing::new(&sample::comparison());
        let [shoulder, elbow] = &drawing.panels[0].groups[..] else { panic!("two joints") };
        assert_eq!((shoulder.bars.len(), elbow.bars.len()), (3, 2));
        // 0.1, 0.01 and 0.001 on an axis from 0.0001 to 0.1.
        let heights: Vec<f64> = shoulder.bars.iter().map(|bar| bar.height).collect();
        assert_eq!(heights, [210.0, 140.0, 70.0]);
        assert_eq!(shoulder.bars[1].words, "shoulder, gp: 0.0100");
    }

    #[test]
    fn a_long_name_is_broken_where_its_parts_meet() {
        let lines = |name: &str| two_lines(name, 8).map(|line| line.to_owned());
        assert_eq!(lines("elbow"), ["elbow", ""]);
        assert_eq!(lines("j2_shoulder"), ["j2_", "shoulder"]);
        assert_eq!(lines("schultergelenk"), ["schulter", "gelenk"]);
        assert_eq!(lines("left_shoulder_pitch"), ["left_", "shoulde…"]);
    }

    #[test]
    fn the_figure_is_xml_that_stands_alone() {
        let mut comparison = sample::comparison();
        comparison.joints[0].name = "<b>&".into();
        let svg = comparison.figure().unwrap();
        let text = text_of_xml(&svg);
        for expected in ["arm: error of learned models by joint", "elbow", "gp-rbd", "0.01"] {
            assert!(text.contains(expected), "{expected} is missing in {text}");
        }
        assert_eq!(svg.matches("http").count(), 1, "only the name space");
        assert!(!svg.contains("NaN") && !svg.contains("<b>"));
    }

    #[test]
    fn many_joints_take_several_panels_and_no_number_takes_none() {
        let mut comparison = sample::comparison();
        comparison.joints = vec![comparison.joints[0].clone(); 20];
        comparison.models.iter_mut().for_each(|model| model.nmse = vec![0.1; 20]);
        let drawing = Drawing::new(&comparison);
        let counts: Vec<usize> = drawing.panels.iter().map(|p| p.groups.len()).collect();
        assert_eq!(counts, [7, 7, 6]);
        comparison.models.clear();
        assert!(Drawing::new(&comparison).panels.is_empty());
        text_of_xml(&comparison.figure().unwrap());
    }
}
