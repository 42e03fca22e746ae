//! What every page is made of: charts, tables, text and files. Nothing here knows of robots or diagnoses.
//!
//! ```text
//! Chart, Dots, FigureSheet   -> SVG, in a page or in a file
//! text_grid(), HtmlGrid      -> a table in a terminal, in a page
//! significant(), wrap(), ..  -> numbers, units and lines of text
//! page.html, render_page()   -> a page that opens offline, with style, script and contents
//! write_folder(), to_json()  -> files, written whole
//! ```
//!
//! A crate with pages of its own names `templates` of this crate in its `askama.toml`; its templates
//! then extend `page.html`.

// Templates name `pages::..`, which has to mean this crate here as well.
extern crate self as pages;

mod charts;
mod html;
mod output;
#[cfg(test)]
mod sample;
mod tables;
mod text;

pub use charts::chart::{Axis, AxisBegin, Chart, CurveShape, Ink, Series};
pub use charts::decimate::{column_extremes, percentile_bands};
pub use charts::dots::{Dots, JointDots};
pub use charts::inks::{Medium, Palette};
pub use charts::log_axis::{AxisTick, LogAxis, round_px};
pub use charts::sheet::{CHARACTER_WIDTH, FIGURE_EDGES, FigureSheet, LegendKey, Stacked, stack};
pub use html::page::render_page;
pub use html::render::{escape_json, render_html};
pub use html::script::{PAGE_SCRIPT, script_policy};
pub use html::style::page_style;
pub use output::error::ReportError;
pub use output::files::{sha256_of, write_folder};
pub use output::json::{to_json, with_schema};
pub use output::provenance::{FileHash, Provenance, quote_argument};
pub use output::schema::written_schema;
pub use tables::grid::{Cell, GridColumn, TABLE_DIGITS, mark_least, text_grid};
pub use tables::html_grid::HtmlGrid;
pub use text::names::{count_noun, join_names};
pub use text::numbers::{decimals_for, percent, percent_range, significant, unit, with_decimals};
pub use text::terminal::{
    BOLD, FAINT, TERMINAL_WIDTH, push_entry, push_first_warnings, push_notes, push_warnings,
    without_escapes,
};
pub use text::wrap::{pack, shorten, wrap};
