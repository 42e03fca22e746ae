use askama::Template;
use colours::Role;
use pages::{FigureSheet, Ink, LegendKey, Medium, Palette, ReportError, round_px};

use crate::tables::confusion::Confusion;
use crate::tables::tally::TrialGroup;

/// Left and right edge of the cells, height of a row, room for the names of the columns and what
/// is left between two cells (px).
const CELLS: [f64; 2] = [262.0, 876.0];
const ROW: f64 = 21.0;
const NAMES: f64 = 62.0;
const BETWEEN: f64 = 1.0;
/// Width of the widest cell (px).
const WIDEST: f64 = 60.0;
/// Opacity of the fullest cell, through which its number is read.
const DARKEST: f64 = 0.6;

#[derive(Template)]
#[template(path = "confusion.svg")]
struct Drawing {
    sheet: FigureSheet,
    columns: Vec<(f64, &'static str)>,
    columns_y: f64,
    names_x: f64,
    rows: Vec<DrawnRow>,
}

/// The injected effects, and the cells of their row.
struct DrawnRow {
    y: f64,
    name: String,
    cells: Vec<DrawnCell>,
}

/// Number of trials in which something was named first.
struct DrawnCell {
    x: f64,
    width: f64,
    colour: String,
    opacity: f64,
    count: usize,
    words: String,
}

/// The first finding against the injected effects, as a drawing for a page. The more opaque a cell, the larger its
/// share of the trials of its row.
///
/// # Errors
///
/// [`ReportError::Format`].
pub fn confusion_figure(confusion: &Confusion) -> Result<String, ReportError> {
    let colours = Medium::Page.palette();
    let key = |name: &str, role| LegendKey { name: name.to_owned(), ink: Ink::Role(role) };
    let keys = vec![
        key("the right effect", Role::Extended),
        key("another effect", Role::Nominal),
        key("nothing", Role::Measured),
    ];
    let sheet =
        FigureSheet::new("What was named first for what was put in", "", keys, Medium::Page);
    let top = sheet.bottom() + NAMES + 14.0;
    let wide = (CELLS[1] - CELLS[0]) / confusion.named.len().max(1) as f64;
    let wide = wide.min(WIDEST);
    let left_edge = |column: usize| CELLS[0] + wide * column as f64;
    let rows =
        confusion.injected.iter().enumerate().map(|(place, (injected, own, counts))| DrawnRow {
            y: top + ROW * place as f64,
            name: injected.to_string(),
            cells: counts
                .iter()
                .enumerate()
                .map(|(column, &count)| DrawnCell {
                    x: round_px(left_edge(column)),
                    width: round_px(wide - BETWEEN),
                    colour: colour(&colours, *injected, *own, (column, confusion.named.len())),
                    opacity: round_px(
                        DARKEST * count as f64 / counts.iter().sum::<usize>().max(1) as f64,
                    ),
                    count,
                    words: format!(
                        "{injected}: {} named first in {count} of {}",
                        confusion.named[column],
                        counts.iter().sum::<usize>()
                    ),
                })
                .collect(),
        });
    let rows: Vec<DrawnRow> = rows.collect();
    let names = confusion.named.iter().enumerate();
    let drawing = Drawing {
        columns: names
            .map(|(i, name)| (round_px(left_edge(i) + 0.5 * wide + 4.0), *name))
            .collect(),
        columns_y: top - 8.0,
        names_x: CELLS[0] - 10.0,
        sheet: sheet.down_to(top + ROW * rows.len() as f64 + 14.0),
        rows,
    };
    drawing.render().map_err(|e| ReportError::Format { format: "SVG", reason: e.to_string() })
}

/// Either of two injected effects may be named first, so that neither has a column of its own.
fn colour(
    colours: &Palette,
    injected: TrialGroup,
    own: Option<usize>,
    (column, columns): (usize, usize),
) -> String {
    match own {
        Some(own) if own == column => colours.extended_model(),
        _ if column + 1 == columns => colours.measurement(),
        None if injected == TrialGroup::Two => colours.soft.to_owned(),
        _ => colours.nominal(),
    }
}
