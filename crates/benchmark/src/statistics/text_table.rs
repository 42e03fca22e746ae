use comfy_table::{CellAlignment, ContentArrangement, Table, presets};

/// A table of texts, whose first column names the rows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextTable {
    /// The title.
    pub title: String,
    /// The names of the columns.
    pub header: Vec<String>,
    /// The rows.
    pub rows: Vec<Vec<String>>,
}

impl TextTable {
    /// The table without lines. All columns except the first are right-aligned, with `padding` before each.
    pub fn text(&self, padding: u16) -> String {
        let mut table = Table::new();
        table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Disabled);
        table.set_header(&self.header).add_rows(&self.rows);
        for (index, column) in table.column_iter_mut().enumerate() {
            column.set_padding((padding, 1));
            let alignment = if index == 0 { CellAlignment::Left } else { CellAlignment::Right };
            column.set_cell_alignment(alignment);
        }
        let lines = table.lines().map(|line| format!("{}\n", line.trim_end()));
        format!("{}\n{}", self.title, lines.collect::<String>())
    }
}
