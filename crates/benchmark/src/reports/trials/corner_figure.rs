use askama::Template;
use colours::Role;
use pages::{FigureSheet, Ink, LegendKey, Medium, Palette, ReportError, round_px};

use crate::statistics::rate::Rate;
use crate::statistics::share::Share;
use crate::tables::panel_row::PanelRow;
use crate::tables::panel_tally::PanelTally;

/// Left and right edge of what is shown, height of a row, and of the room above the first (px).
const SHOWN: [f64; 2] = [220.0, 856.0];
const ROW: f64 = 34.0;
const AXIS: f64 = 24.0;
/// From one mark of a row to the next (px).
const NEXT: f64 = 9.0;

#[derive(Template)]
#[template(path = "corners.svg")]
struct Drawing {
    sheet: FigureSheet,
    edges: [f64; 2],
    top: f64,
    bottom: f64,
    ticks: Vec<(f64, String)>,
    rows: Vec<DrawnRow>,
}

/// Trials with one property in common.
struct DrawnRow {
    y: f64,
    name: String,
    /// Whether a line separates it from the row above.
    is_first: bool,
    marks: Vec<Mark>,
}

/// A share and its interval.
struct Mark {
    y: f64,
    x: f64,
    ends: [f64; 2],
    colour: String,
    words: String,
}

/// Recall of the causes and share of false assurances, side by side of a population, as a drawing for a page that
/// shows the weakest corner at a glance.
///
/// # Errors
///
/// [`ReportError::Format`].
pub fn corner_figure(tally: &PanelTally) -> Result<String, ReportError> {
    let colours = Medium::Page.palette();
    let key = |name: &str, role| LegendKey { name: name.to_owned(), ink: Ink::Role(role) };
    let keys = vec![
        key("findings that are true", Role::Extended),
        key("visible causes that are named", Role::Measured),
        key("false assurance", Role::Nominal),
    ];
    let sheet = FigureSheet::new("Precision, recall and false assurance", "", keys, Medium::Page);
    let top = sheet.bottom() + AXIS;
    let mut thing = None;
    let rows = tally.rows.iter().enumerate().map(|(place, row)| {
        let y = top + ROW * place as f64;
        let is_first = thing.replace(row.side.thing()).is_some_and(|last| last != row.side.thing());
        let name = format!("{} ({})", row.side, row.trials);
        DrawnRow { y: round_px(y), name, is_first, marks: marks(row, y, &colours) }
    });
    let rows: Vec<DrawnRow> = rows.collect();
    let bottom = round_px(top + ROW * rows.len() as f64);
    let tick = |tenth: u32| (at(f64::from(tenth) / 5.0), format!("{} %", 20 * tenth));
    let drawing = Drawing {
        sheet: sheet.down_to(bottom + 14.0),
        edges: SHOWN,
        top: round_px(top),
        bottom,
        ticks: (0..=5).map(tick).collect(),
        rows,
    };
    drawing.render().map_err(|e| ReportError::Format { format: "SVG", reason: e.to_string() })
}

fn marks(row: &PanelRow, y: f64, colours: &Palette) -> Vec<Mark> {
    let of_rate = |rate: &Rate| Some((rate.value?, rate.interval?, rate.words()));
    let of_share = |share: &Share| {
        let value = share.count as f64 / share.of.max(1) as f64;
        Some((value, share.interval?, share.words()))
    };
    let shown = [
        ("findings that are true", colours.extended_model(), of_rate(&row.named.precision)),
        ("visible causes that are named", colours.measurement(), of_rate(&row.named.recall)),
        ("false assurance", colours.nominal(), of_share(&row.false_assurance)),
    ];
    let mark = |(place, (name, colour, share)): (usize, (&str, _, Option<_>))| {
        let (value, interval, words): (f64, [f64; 2], String) = share?;
        Some(Mark {
            y: round_px(y + 8.0 + NEXT * place as f64),
            x: at(value),
            ends: interval.map(at),
            colour,
            words: format!("{}: {name} {words}", row.side),
        })
    };
    shown.into_iter().enumerate().filter_map(mark).collect()
}

/// Position of a share (px).
fn at(share: f64) -> f64 {
    round_px(SHOWN[0] + (SHOWN[1] - SHOWN[0]) * share)
}
