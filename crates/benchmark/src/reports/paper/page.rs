use askama::Template;
use experiment::Claim;
use pages::{GridColumn, HtmlGrid, Provenance, ReportError, escape_json, render_html, render_page};
use report::{ClaimRow, ClaimUnit, claim_rows, claims_sentence};

/// The content of the page of a figure.
pub(super) struct Contents<'a> {
    /// The figure of the paper, in a few words.
    pub kicker: String,
    /// The claims about the figure.
    pub claims: &'a [Claim],
    /// The quantity of the claims' numbers.
    pub quantity: ClaimUnit,
    /// The drawings with their tables.
    pub drawings: Vec<Drawing>,
    /// Remarks on the numbers.
    pub remarks: &'a [String],
    /// Program, command and inputs behind the results.
    pub provenance: &'a Provenance,
    /// Name and text of the JSON.
    pub json: (&'static str, String),
}

/// A drawing and the numbers behind it.
pub(super) struct Drawing {
    pub title: String,
    pub words: String,
    pub svg: String,
    pub table: String,
}

#[derive(Template)]
#[template(path = "figure_of_paper.html")]
struct Page<'a> {
    kicker: String,
    sentence: String,
    claims: Vec<ClaimRow>,
    drawings: Vec<Drawing>,
    remarks: &'a [String],
    id: &'static str,
    provenance: &'a Provenance,
    json: String,
}

/// The page as one file that opens offline and without scripts.
pub(super) fn page(contents: Contents) -> Result<String, ReportError> {
    let (id, json) = contents.json;
    render_page(&Page {
        kicker: contents.kicker,
        sentence: claims_sentence(contents.claims),
        claims: claim_rows(contents.claims, contents.quantity),
        drawings: contents.drawings,
        remarks: contents.remarks,
        id,
        provenance: &contents.provenance.without_folders(),
        json: escape_json(&json),
    })
}

/// A table of a page from the columns of one for a terminal.
pub(super) fn table(
    corner: &str,
    labels: &[String],
    columns: &[GridColumn],
) -> Result<String, ReportError> {
    let row = |(i, label): (usize, &String)| {
        let cells = columns.iter().filter_map(|column| column.cells.get(i).cloned());
        (label.clone(), cells.collect())
    };
    render_html(&HtmlGrid {
        corner: corner.to_owned(),
        header: columns.iter().map(|column| column.header.trim().to_owned()).collect(),
        rows: labels.iter().enumerate().map(row).collect(),
    })
}
