use std::path::PathBuf;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet, normalize_untrusted_str};
use files::{shorten, shorten_words};

use crate::key_path::KeyPath;
use crate::source::{SourceSpan, TextOrigin, printable};

/// How an assignment is given on the command line.
const SET: &str = "--set ";

/// Why a document cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DocumentError {
    /// The file that was asked for cannot be read.
    #[error("{}: {reason}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What was found instead of a text.
        reason: String,
    },
    /// A text is not a [`KeyPath`].
    #[error("key path {text}, column {column}: {reason}")]
    NotAKeyPath {
        /// The text.
        text: String,
        /// The character where reading ended, from 1.
        column: usize,
        /// What was found and what was expected.
        reason: String,
    },
    /// Something in a text is not what was expected.
    #[error("{place}: {}{message}", subject(path))]
    Mistake {
        /// Where it stands.
        place: Box<SourceSpan>,
        /// Where it stands in the document; the root for what has no place there.
        path: KeyPath,
        /// What was found and what was expected.
        message: String,
        /// What may be done about it.
        help: Option<String>,
    },
}

/// Whether a text contains colour codes for a terminal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coloring {
    /// No colour codes.
    Plain,
    /// ANSI colour codes.
    Ansi,
}

impl DocumentError {
    /// A mistake with a sentence in one line, in which nothing controls the terminal.
    pub(crate) fn at(
        place: SourceSpan,
        path: KeyPath,
        message: &str,
        help: Option<String>,
    ) -> Self {
        let message = shorten_words(&printable(message)).into_owned();
        Self::Mistake { place: Box::new(place), path, message, help }
    }

    /// The mistake as a compiler shows it: the lines of the file, the value underlined.
    ///
    /// ```text
    /// error: unknown key `level`, did you mean `level_nm`?
    ///  --> friction.toml:6:39
    ///   |
    /// 6 | coulomb_friction = { joint = "elbow", level = 0.6 }
    ///   |                                       ^^^^^ effect.1.coulomb_friction.level
    ///   |
    ///   = help: expected `joint` or `level_nm`
    /// ```
    ///
    /// The text ends without a line break.
    #[must_use]
    pub fn render(&self, coloring: Coloring) -> String {
        let renderer = match coloring {
            Coloring::Plain => Renderer::plain(),
            Coloring::Ansi => Renderer::styled(),
        };
        let Self::Mistake { place, path, message, help } = self else {
            let title = Level::ERROR.primary_title(self.to_string());
            return renderer.render(&[Group::with_title(title)]);
        };
        let source = &place.source;
        let (text, shift) = match source.origin {
            TextOrigin::Assignment => (format!("{SET}{}", source.text), SET.len()),
            _ => (source.text.clone(), 0),
        };
        let span = place.span();
        let label = (!path.segments().is_empty()).then(|| shorten(&path.to_string()).into_owned());
        let underline = AnnotationKind::Primary.span(span.start + shift..span.end + shift);
        let snippet = Snippet::source(text).path(source.name()).annotation(underline.label(label));
        let mut group = Level::ERROR.primary_title(message).element(snippet);
        if let Some(help) = help {
            group = group
                .element(Level::HELP.message(wrap(&normalize_untrusted_str(&shorten_words(help)))));
        }
        // The renderer shows the other control characters, these it lets through.
        renderer.render(&[group]).replace(|c| matches!(c, '\u{80}'..='\u{9f}'), "\u{fffd}")
    }

    /// Where in a text the mistake is, if it is in one.
    #[must_use]
    pub fn place(&self) -> Option<&SourceSpan> {
        match self {
            Self::Mistake { place, .. } => Some(place),
            Self::Unreadable { .. } | Self::NotAKeyPath { .. } => None,
        }
    }
}

/// What the parser says, with the end of a line or a value in words.
pub(crate) fn syntax(error: &toml::de::Error) -> String {
    let message = error.message();
    let message = message.strip_suffix(", expected nothing").unwrap_or(message);
    message.replace("expected newline, `#`", "expected the end of the line")
}

/// A text in lines that a terminal holds.
fn wrap(text: &str) -> String {
    const WIDTH: usize = 88;
    let mut lines = String::new();
    let mut column = 0;
    for word in text.split_inclusive(' ') {
        let length = word.chars().count();
        if column > 0 && column + length > WIDTH {
            lines.truncate(lines.trim_end().len());
            lines.push('\n');
            column = 0;
        }
        lines.push_str(word);
        column += length;
    }
    lines
}

fn subject(path: &KeyPath) -> String {
    if path.segments().is_empty() { String::new() } else { format!("{path}: ") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_help_is_broken_between_words() {
        let words = "expected `viscous_friction` or ".repeat(12);
        let lines = wrap(&words);
        assert!(lines.lines().count() > 3 && lines.lines().all(|line| line.len() <= 88), "{lines}");
        assert_eq!(lines.replace('\n', " "), words);
        assert_eq!(wrap("short"), "short");
    }
}
