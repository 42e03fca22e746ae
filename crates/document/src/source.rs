use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A text that values come from.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TextSource {
    pub origin: TextOrigin,
    pub text: String,
}

/// Where a text comes from.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum TextOrigin {
    File(PathBuf),
    /// A text of the program, by its name.
    Text(String),
    /// The command line: the text is `path=value`.
    Assignment,
}

impl TextSource {
    /// The folder that paths in the text are relative to; empty for the current one.
    pub(crate) fn folder(&self) -> &Path {
        match &self.origin {
            TextOrigin::File(path) => path.parent().unwrap_or(Path::new("")),
            TextOrigin::Text(_) | TextOrigin::Assignment => Path::new(""),
        }
    }

    /// The file that it was read from.
    pub(crate) fn file(&self) -> Option<&Path> {
        match &self.origin {
            TextOrigin::File(path) => Some(path),
            TextOrigin::Text(_) | TextOrigin::Assignment => None,
        }
    }

    /// What stands before line and column; nothing for the command line.
    pub(crate) fn name(&self) -> Option<String> {
        match &self.origin {
            TextOrigin::File(path) => Some(path.display().to_string()),
            TextOrigin::Text(name) => Some(name.clone()),
            TextOrigin::Assignment => None,
        }
    }
}

/// A stretch of a text that values come from.
///
/// Displays as `file.toml:12:9`, or as the whole `--set path=value`.
#[derive(Debug, Clone, PartialEq)]
pub struct SourceSpan {
    pub(crate) source: Arc<TextSource>,
    span: Range<usize>,
}

impl SourceSpan {
    /// A span that reaches over the end, or into a character, is cut back.
    pub(crate) fn new(source: &Arc<TextSource>, span: Range<usize>) -> Self {
        let start = source.text.floor_char_boundary(span.start);
        let end = source.text.floor_char_boundary(span.end).max(start);
        Self { source: Arc::clone(source), span: start..end }
    }

    /// The bytes of the text, from 0.
    #[must_use]
    pub fn span(&self) -> Range<usize> {
        self.span.clone()
    }

    /// The line it starts in, from 1.
    #[must_use]
    pub fn line(&self) -> usize {
        self.before().matches('\n').count() + 1
    }

    /// The character of the line it starts at, from 1.
    #[must_use]
    pub fn column(&self) -> usize {
        self.before().rsplit('\n').next().unwrap_or_default().chars().count() + 1
    }

    /// The text itself.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.source.text[self.span()]
    }

    fn before(&self) -> &str {
        &self.source.text[..self.span.start]
    }
}

impl fmt::Display for SourceSpan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.source.name() {
            Some(name) => write!(f, "{name}:{}:{}", self.line(), self.column()),
            None => write!(f, "--set {}", printable(&self.source.text)),
        }
    }
}

/// A text whose control characters are written as numbers, so that a terminal does not obey them.
pub(crate) fn printable(text: &str) -> String {
    let shown = |c: char| if c.is_control() { c.escape_debug().to_string() } else { c.to_string() };
    text.chars().map(shown).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_columns_count_characters_from_one() {
        let text = "a = 1\nμ = 'é'  x\n".to_owned();
        let at = text.find('x').unwrap();
        let source = Arc::new(TextSource { origin: TextOrigin::Text("notes".to_owned()), text });
        assert_eq!(SourceSpan::new(&source, at..at + 1).to_string(), "notes:2:10");
        assert_eq!(SourceSpan::new(&source, 0..1).to_string(), "notes:1:1");
        assert_eq!(SourceSpan::new(&source, 900..901).to_string(), "notes:3:1");
        // Inside the two bytes of the first letter of line 2.
        assert_eq!(SourceSpan::new(&source, 7..7).to_string(), "notes:2:1");
    }
}
