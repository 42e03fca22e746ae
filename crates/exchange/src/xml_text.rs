use quick_xml::escape::escape;

/// Writes XML, one element per line.
#[derive(Debug, Default)]
pub struct XmlText {
    text: String,
    open: Vec<&'static str>,
}

/// Attributes by name.
pub type Attributes<'a> = &'a [(&'static str, String)];

impl XmlText {
    /// An empty document.
    pub fn new() -> Self {
        Self { text: "<?xml version=\"1.0\"?>\n".to_owned(), open: vec![] }
    }

    /// A comment; two hyphens in a row are separated, since XML forbids them in comments.
    pub fn comment(&mut self, words: &str) {
        let words = words.replace("--", "- -");
        self.line(&format!("<!-- {words} -->"));
    }

    /// An element without children.
    pub fn leaf(&mut self, name: &'static str, attributes: Attributes<'_>) {
        self.line(&format!("<{name}{}/>", attribute_text(attributes)));
    }

    /// An element that holds a text.
    pub fn text(&mut self, name: &'static str, attributes: Attributes<'_>, text: &str) {
        self.line(&format!(
            "<{name}{}>{}</{name}>",
            attribute_text(attributes),
            escape_value(text)
        ));
    }

    /// Opens an element.
    pub fn open(&mut self, name: &'static str, attributes: Attributes<'_>) {
        self.line(&format!("<{name}{}>", attribute_text(attributes)));
        self.open.push(name);
    }

    /// Closes the element that was opened last.
    pub fn close(&mut self) {
        if let Some(name) = self.open.pop() {
            self.line(&format!("</{name}>"));
        }
    }

    /// The text, with all elements closed.
    pub fn finish(mut self) -> String {
        while !self.open.is_empty() {
            self.close();
        }
        self.text
    }

    fn line(&mut self, line: &str) {
        self.text.push_str(&"  ".repeat(self.open.len()));
        self.text.push_str(line);
        self.text.push('\n');
    }
}

fn attribute_text(attributes: Attributes<'_>) -> String {
    let text = |(key, value): &(&str, String)| format!(" {key}=\"{}\"", escape_value(value));
    attributes.iter().map(text).collect()
}

/// A value as XML has it: ends of lines and tabs by their number, as a reader takes them for blanks otherwise, and
/// characters that no XML 1.0 can hold as `\u{1b}`.
pub fn escape_value(value: &str) -> String {
    let mut text = String::with_capacity(value.len());
    for c in escape(value).chars() {
        match c {
            '\t' | '\n' | '\r' => text.push_str(&format!("&#{};", u32::from(c))),
            '\0'..=' ' if c != ' ' => text.extend(c.escape_unicode()),
            '\u{fffe}' | '\u{ffff}' => text.extend(c.escape_unicode()),
            c => text.push(c),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_holds_what_xml_can_hold() {
        assert_eq!(escape_value("a\n\tb <&>'\""), "a&#10;&#9;b &lt;&amp;&gt;&apos;&quot;");
        assert_eq!(escape_value("\u{1b}\u{ffff}\u{9b}"), "\\u{1b}\\u{ffff}\u{9b}");
    }
}
