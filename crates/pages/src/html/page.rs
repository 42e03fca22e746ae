use askama::Template;

use crate::html::render::render_html;
use crate::output::error::ReportError;

/// Where a page lists its contents.
const CONTENTS: &str = "<nav></nav>";

/// A whole page: its headings have anchors and its contents lead to them.
///
/// # Errors
///
/// [`ReportError::Format`].
pub fn render_page(template: &impl Template) -> Result<String, ReportError> {
    Ok(with_contents(&render_html(template)?))
}

/// The page with an anchor at every heading of a section and a link to each in its contents.
fn with_contents(page: &str) -> String {
    let mut anchors: Vec<(String, &str)> = Vec::new();
    let mut pieces = page.split("<h2>");
    let mut body = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let title = piece.split_once("</h2>").map_or("", |(title, _)| title);
        let namesakes = anchors.iter().filter(|(_, other)| *other == title).count();
        let ending = if namesakes == 0 { String::new() } else { format!("-{}", namesakes + 1) };
        let anchor = heading_anchor(title) + &ending;
        body.push_str(&format!("<h2 id=\"{anchor}\">{piece}"));
        anchors.push((anchor, title));
    }
    let link = |(anchor, title): &(String, &str)| format!("<a href=\"#{anchor}\">{title}</a>\n");
    let links: String = anchors.iter().map(link).collect();
    body.replacen(CONTENTS, &format!("<nav aria-label=\"Contents\">\n{links}</nav>"), 1)
}

/// A name for an address: `What is left` becomes `what-is-left`.
pub fn heading_anchor(title: &str) -> String {
    let words = title.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_lowercase).collect::<Vec<_>>().join("-")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_heading_has_an_anchor_of_its_own_and_a_link() {
        let page = with_contents("<nav></nav><h2>What is left</h2>a<h2>Trials</h2><h2>Trials</h2>");
        assert_eq!(
            page,
            "<nav aria-label=\"Contents\">\n<a href=\"#what-is-left\">What is left</a>\n\
             <a href=\"#trials\">Trials</a>\n<a href=\"#trials-2\">Trials</a>\n</nav>\
             <h2 id=\"what-is-left\">What is left</h2>a<h2 id=\"trials\">Trials</h2>\
             <h2 id=\"trials-2\">Trials</h2>"
        );
    }
}
