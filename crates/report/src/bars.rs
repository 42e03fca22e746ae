use askama::Template;

use crate::ReportError;
use crate::inks::{Colours, Place};
use crate::log_axis::{LogAxis, Tick, rounded};
use crate::numbers::significant;
use crate::sheet::{CHARACTER, EDGES, Key, Sheet};
use crate::wrap::shortened;

/// Height of a panel of bars, and of what stands between two panels (px).
const PANEL: f64 = 210.0;
const BETWEEN: f64 = 54.0;

/// Joints beside each other in one panel; more are spread over several.
const MOST_JOINTS: usize = 8;

/// Share of the width of a joint that its bars fill, and width of the widest bar (px).
const FILLED: f64 = 0.84;
const WIDEST: f64 = 18.0;

/// Powers of ten that the axis spans at most.
const MOST_DECADES: i32 = 8;

/// A number for every joint and model, as bars on a logarithmic axis.
pub struct Bars {
    /// What it shows, in a few words.
    pub title: String,
    /// More words, below the title.
    pub subtitle: String,
    /// The quantity, as it stands at the axis.
    pub axis: &'static str,
    /// The models.
    pub keys: Vec<Key>,
    /// The joints.
    pub joints: Vec<JointBars>,
    /// A number to compare with, and what it means.
    pub mark: Option<(f64, &'static str)>,
}

/// The bars of one joint.
pub struct JointBars {
    /// Its name.
    pub name: String,
    /// One number a model; one that is not finite has no bar.
    pub values: Vec<f64>,
}

impl Bars {
    /// The bars as SVG.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn svg(&self, place: Place) -> Result<String, ReportError> {
        let drawing = Drawing::new(self, place);
        drawing.render().map_err(|e| ReportError::Format { format: "SVG", reason: e.to_string() })
    }
}

#[derive(Template)]
#[template(path = "bars.svg")]
struct Drawing {
    sheet: Sheet,
    edges: [f64; 2],
    axis: &'static str,
    panels: Vec<Panel>,
}

/// The bars of some joints.
struct Panel {
    top: f64,
    bottom: f64,
    ticks: Vec<Tick>,
    /// Where the number to compare with lies, if it is on the axis, and its words.
    mark: Option<(f64, &'static str)>,
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
    colour: String,
    words: String,
}

impl Drawing {
    fn new(bars: &Bars, place: Place) -> Self {
        let sheet = Sheet::new(&bars.title, &bars.subtitle, bars.keys.clone(), place);
        let panels = panels(bars, sheet.bottom() + 22.0, &place.colours());
        let bottom = panels.last().map_or(sheet.bottom(), |panel| panel.bottom);
        Self { sheet: sheet.down_to(bottom + BETWEEN), edges: EDGES, axis: bars.axis, panels }
    }
}

/// The joints in panels of about the same number, all with the same axis.
fn panels(bars: &Bars, top: f64, colours: &Colours) -> Vec<Panel> {
    let joints = bars.joints.len();
    let rows = joints.div_ceil(MOST_JOINTS).max(1);
    let columns = joints.div_ceil(rows).max(1);
    let panels = bars.joints.chunks(columns).enumerate().map_while(|(row, members)| {
        let top = top + row as f64 * (PANEL + BETWEEN);
        let values = bars.joints.iter().flat_map(|joint| joint.values.iter().copied());
        let axis = LogAxis::over_decades(values, MOST_DECADES, [top + PANEL, top])?;
        let width = (EDGES[1] - EDGES[0]) / columns as f64;
        let left = |place: usize| EDGES[0] + width * place as f64;
        let groups = members.iter().enumerate();
        Some(Panel {
            top,
            bottom: top + PANEL,
            ticks: axis.ticks(),
            mark: bars.mark.filter(|m| axis.holds(m.0)).map(|(at, words)| (axis.at(at), words)),
            groups: groups
                .map(|(i, j)| group((&bars.keys, colours), j, &axis, [left(i), width]))
                .collect(),
        })
    });
    panels.collect()
}

/// The bars of one joint between `left` and `left + width`.
fn group(
    (keys, colours): (&[Key], &Colours),
    joint: &JointBars,
    axis: &LogAxis,
    [left, width]: [f64; 2],
) -> Group {
    let step = (FILLED * width / keys.len() as f64).min(WIDEST);
    let start = left + 0.5 * (width - step * keys.len() as f64);
    let floor = axis.at(0.0);
    let known = keys.iter().zip(&joint.values).enumerate().filter(|(_, (_, v))| v.is_finite());
    let bars = known.map(|(place, (key, &value))| Bar {
        x: rounded(start + step * place as f64),
        y: axis.at(value),
        width: rounded(0.88 * step),
        height: rounded(floor - axis.at(value)),
        colour: colours.of(key.ink),
        words: format!("{}, {}: {}", joint.name, key.name, significant(value, 3)),
    });
    let fits = ((width - 6.0) / CHARACTER) as usize;
    let name = two_lines(&joint.name, fits);
    Group { middle: rounded(left + 0.5 * width), name, bars: bars.collect() }
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
    use crate::chart::Ink;

    /// Two joints and three models, one of which knows nothing of the second joint.
    fn bars() -> Bars {
        let key = |(index, name): (usize, &str)| Key { name: name.into(), ink: Ink::Model(index) };
        let joint =
            |name: &str, values: [f64; 3]| JointBars { name: name.into(), values: values.to_vec() };
        Bars {
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
    fn a_bar_is_as_high_as_its_number_and_what_is_not_a_number_has_none() {
        let drawing = Drawing::new(&bars(), Place::Alone);
        let panel = &drawing.panels[0];
        let [shoulder, elbow] = &panel.groups[..] else { panic!("two joints") };
        assert_eq!((shoulder.bars.len(), elbow.bars.len()), (3, 2));
        // 0.1, 0.01 and 0.001 on an axis from 0.0001 to 0.1.
        let heights: Vec<f64> = shoulder.bars.iter().map(|bar| bar.height).collect();
        assert_eq!(heights, [210.0, 140.0, 70.0]);
        assert_eq!(shoulder.bars[1].words, "shoulder, gp: 0.0100");
        assert_eq!(panel.mark, Some((panel.bottom - 140.0, "here")));
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
    fn many_joints_take_several_panels_and_no_number_takes_none() {
        let mut bars = bars();
        bars.joints =
            (0..20).map(|i| JointBars { name: format!("j{i}"), values: vec![0.1; 3] }).collect();
        let drawing = Drawing::new(&bars, Place::Alone);
        let counts: Vec<usize> = drawing.panels.iter().map(|p| p.groups.len()).collect();
        assert_eq!(counts, [7, 7, 6]);
        bars.joints.iter_mut().for_each(|joint| joint.values.clear());
        assert!(Drawing::new(&bars, Place::Alone).panels.is_empty());
        bars.joints.clear();
        assert!(Drawing::new(&bars, Place::Alone).panels.is_empty());
    }
}
