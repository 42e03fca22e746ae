use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use files::FileError;

use crate::error::DocumentError;
use crate::key_path::KeyPath;
use crate::node::{Node, Value};
use crate::source::{SourceSpan, TextOrigin, TextSource};

/// The key of a file that names the files it extends.
pub(crate) const EXTENDS: &str = "extends";

/// Most files in a row that extend one another.
const LONGEST_CHAIN: usize = 16;
/// Most files read for one document; one that is extended twice counts twice.
const MOST_FILES: usize = 256;
/// Most bytes of one document, all its files together.
const MOST_BYTES: usize = 16 << 20;

/// The document in a file, laid over the files that it extends.
///
/// Of a text that is no TOML nothing is shown, unless the name of the file says that it should be.
pub(crate) fn read(path: &Path) -> Result<Node, DocumentError> {
    let unreadable = |reason| DocumentError::Unreadable { path: path.to_owned(), reason };
    let mut reader = Reader { chain: Vec::new(), files: MOST_FILES, bytes: MOST_BYTES };
    let text = reader.open(path).map_err(unreadable)?;
    if path.extension().is_none_or(|extension| extension != "toml") {
        refuse_other(&text).map_err(unreadable)?;
    }
    reader.layers(path, text)
}

/// The document in a file that the file `own` names, laid over the files that it extends. Nothing of a text that is no
/// TOML is shown.
///
/// # Errors
///
/// A sentence about the file, and inside the mistakes of what it extends.
pub(crate) fn read_named(
    file: &Path,
    own: Option<&Path>,
) -> Result<Result<Node, DocumentError>, String> {
    let place = |path: &Path| fs::canonicalize(path).ok();
    if own.is_some_and(|own| place(own).is_some_and(|own| place(file) == Some(own))) {
        return Err("it names itself, another file was expected".to_owned());
    }
    let mut reader = Reader { chain: Vec::new(), files: MOST_FILES, bytes: MOST_BYTES };
    let text = reader.open(file)?;
    refuse_other(&text)?;
    Ok(reader.layers(file, text))
}

/// The document in a text, `extends` among its keys.
pub(crate) fn parse(source: &Arc<TextSource>) -> Result<Node, DocumentError> {
    Node::document(source).map_err(|(span, message)| {
        DocumentError::at(SourceSpan::new(source, span), KeyPath::root(), &message, None)
    })
}

/// What `extends` says, taken out of a document.
pub(crate) fn take_extends(root: &mut Node) -> Option<Node> {
    match &mut root.value {
        Value::Table(table) => table.remove(EXTENDS),
        _ => None,
    }
}

/// What is being read, and how much more may be.
struct Reader {
    /// The file asked for, one that it extends, and so on to the file in hand; canonical.
    chain: Vec<PathBuf>,
    files: usize,
    bytes: usize,
}

impl Reader {
    fn layers(&mut self, path: &Path, text: String) -> Result<Node, DocumentError> {
        let source = Arc::new(TextSource { origin: TextOrigin::File(path.to_owned()), text });
        let mut top = parse(&source)?;
        let mut below = None;
        for base in take_extends(&mut top).map_or(Ok(Vec::new()), bases)? {
            let file = source.folder().join(&base.name);
            let text = self.open(&file).map_err(|reason| base.refuse(&file, &reason))?;
            refuse_other(&text).map_err(|reason| base.refuse(&file, &reason))?;
            below = Some(laid_over(below, self.layers(&file, text)?));
        }
        self.chain.pop();
        Ok(laid_over(below, top))
    }

    /// The text of a file, which from here on is the last of the chain; or why there is none.
    fn open(&mut self, path: &Path) -> Result<String, String> {
        let canonical =
            fs::canonicalize(path).map_err(|error| FileError::from(error).to_string())?;
        if self.chain.contains(&canonical) {
            return Err("it would extend itself".to_owned());
        }
        if self.chain.len() == LONGEST_CHAIN {
            return Err(format!("more than {LONGEST_CHAIN} files in a row extend one another"));
        }
        self.files = self
            .files
            .checked_sub(1)
            .ok_or_else(|| format!("more than {MOST_FILES} files would make up one document"))?;
        self.chain.push(canonical);
        self.text(path)
    }

    fn text(&mut self, path: &Path) -> Result<String, String> {
        let text = files::text(path, self.bytes as u64).map_err(|error| match error {
            FileError::TooLarge { .. } => {
                format!("the document has more than {} MiB", MOST_BYTES >> 20)
            }
            other => other.to_string(),
        })?;
        self.bytes -= text.len();
        Ok(text)
    }
}

/// Refuses a text that is no TOML, whatever it is, with the line at which it stops to be TOML.
fn refuse_other(text: &str) -> Result<(), String> {
    let Err(error) = toml::from_str::<toml::Table>(text) else { return Ok(()) };
    let start = text.floor_char_boundary(error.span().map_or(0, |span| span.start));
    Err(format!("line {} is no TOML", text[..start].matches('\n').count() + 1))
}

fn laid_over(below: Option<Node>, node: Node) -> Node {
    match below {
        Some(below) => below.extend_by(node),
        None => node,
    }
}

/// A file that another one extends, and where that says so.
struct Base {
    name: String,
    place: SourceSpan,
    path: KeyPath,
}

impl Base {
    fn refuse(&self, file: &Path, reason: &str) -> DocumentError {
        let message = format!("{} cannot be extended: {reason}", file.display());
        DocumentError::at(self.place.clone(), self.path.clone(), &message, None)
    }
}

/// The files that `extends` names: one, or several of which later ones count more.
fn bases(extends: Node) -> Result<Vec<Base>, DocumentError> {
    let path = KeyPath::root().key(EXTENDS);
    let Value::Array(entries) = extends.value else {
        return Ok(vec![base(extends, path)?]);
    };
    let numbered = entries.into_iter().enumerate();
    numbered.map(|(index, entry)| base(entry, path.index(index))).collect()
}

fn base(node: Node, path: KeyPath) -> Result<Base, DocumentError> {
    let place = node.place();
    let message = format!("expected the name of a file, found {}", node.describe());
    match node.value {
        Value::String(name) if !name.is_empty() => Ok(Base { name, place, path }),
        _ => Err(DocumentError::at(place, path, &message, None)),
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use tempfile::TempDir;

    use crate::document::Document;
    use crate::error::DocumentError;
    use crate::key_path::KeyPath;

    /// A folder with these files.
    fn folder(files: &[(&str, &str)]) -> TempDir {
        let folder = TempDir::new().unwrap();
        for (name, text) in files {
            let path = folder.path().join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        }
        folder
    }

    fn mistake(folder: &TempDir) -> DocumentError {
        Document::read(folder.path().join("top.toml")).unwrap_err()
    }

    #[test]
    fn tables_are_merged_by_key_and_the_rest_is_replaced() {
        let folder = folder(&[
            ("top.toml", "extends = [\"a.toml\", \"sub/b.toml\"]\nx.top = 1\n[[list]]\nt = 1\n"),
            ("a.toml", "x = { top = 2, a = 2, both = 2 }\nlist = [1, 2, 3]\nscalar = 2\n"),
            ("sub/b.toml", "extends = \"../c.toml\"\nx = { both = 3 }\nscalar = { b = 3 }\n"),
            ("c.toml", "x = { both = 4, c = 4 }\nscalar = { c = 4 }\n"),
        ]);
        let document = Document::read(folder.path().join("top.toml")).unwrap();
        let expected = "[[list]]\nt = 1\n\n[scalar]\nb = 3\nc = 4\n\n\
                        [x]\na = 2\nboth = 3\nc = 4\ntop = 1\n";
        assert_eq!(document.to_toml(), expected);
        let x = KeyPath::root().key("x");
        let of = |path: &KeyPath| document.directory_of(path).to_owned();
        assert_eq!(of(&x.key("c")), folder.path().join("sub/.."));
        assert_eq!(of(&x.key("both")), folder.path().join("sub"));
        assert_eq!(of(&x), folder.path());
        assert_eq!(of(&x.key("nothing").key("there")), folder.path());
    }

    #[test]
    fn a_mistake_is_shown_in_the_file_that_the_value_comes_from() {
        let folder =
            folder(&[("top.toml", "extends = \"a.toml\"\nb = 1"), ("a.toml", "# A.\na = 'x'\n")]);
        let document = Document::read(folder.path().join("top.toml")).unwrap();
        let error = document.parse::<std::collections::BTreeMap<String, f64>>().unwrap_err();
        let expected =
            format!("{}:2:5: a: expected a number", folder.path().join("a.toml").display());
        assert!(error.to_string().starts_with(&expected), "{error}");
    }

    #[test]
    fn a_file_that_cannot_be_extended_is_told_where_it_is_named() {
        let cases = [
            ("\"gone.toml\"", "\"gone.toml\"", "there is no such file"),
            ("[\"a.toml\", \"folder\"]", "\"folder\"", "it is a folder"),
            ("\"top.toml\"", "\"top.toml\"", "it would extend itself"),
            ("\"bytes.toml\"", "\"bytes.toml\"", "line 2 is not UTF-8"),
            ("3", "3", "expected the name of a file, found 3"),
            ("[\"a.toml\", \"\"]", "\"\"", "expected the name of a file"),
        ];
        for (extends, underlined, message) in cases {
            let folder = folder(&[
                ("top.toml", &format!("# Top.\nextends = {extends}\n")),
                ("a.toml", ""),
                ("folder/b.toml", ""),
            ]);
            std::fs::write(folder.path().join("bytes.toml"), b"a = 1\nb = '\xff'").unwrap();
            let error = mistake(&folder);
            assert_eq!(error.place().unwrap().text(), underlined, "{error}");
            assert!(error.to_string().contains(message), "{error}");
        }
    }

    #[test]
    fn a_cycle_is_found_but_a_base_may_be_extended_twice() {
        let cycle = folder(&[
            ("top.toml", "extends = \"a.toml\""),
            ("a.toml", "extends = \"sub/../b.toml\""),
            ("b.toml", "extends = \"a.toml\""),
            ("sub/empty", ""),
        ]);
        let error = mistake(&cycle).to_string();
        assert!(error.contains("b.toml:1:11: extends: ") && error.contains("itself"), "{error}");
        let diamond = folder(&[
            ("top.toml", "extends = [\"a.toml\", \"b.toml\"]"),
            ("a.toml", "extends = \"c.toml\""),
            ("b.toml", "extends = \"c.toml\""),
            ("c.toml", "c = 1"),
        ]);
        let document = Document::read(diamond.path().join("top.toml")).unwrap();
        assert_eq!(document.to_toml(), "c = 1\n");
    }

    #[test]
    fn a_chain_of_16_files_is_read_and_one_of_17_is_not() {
        let chain = |length: usize| {
            let mut files = vec![("top.toml".to_owned(), "extends = \"2\"".to_owned())];
            files.extend((2..length).map(|i| (i.to_string(), format!("extends = \"{}\"", i + 1))));
            files.push((length.to_string(), String::new()));
            let files: Vec<_> = files.iter().map(|(n, t)| (n.as_str(), t.as_str())).collect();
            folder(&files)
        };
        assert!(Document::read(chain(16).path().join("top.toml")).is_ok());
        assert!(mistake(&chain(17)).to_string().contains("more than 16 files in a row"));
    }

    #[test]
    fn files_that_multiply_and_files_that_are_too_large_are_refused() {
        let mut files = vec![("top.toml".to_owned(), "extends = [\"0\", \"0\"]".to_owned())];
        for i in 0..14 {
            files.push((i.to_string(), format!("extends = [\"{0}\", \"{0}\"]", i + 1)));
        }
        files.push(("14".to_owned(), String::new()));
        let files: Vec<_> = files.iter().map(|(n, t)| (n.as_str(), t.as_str())).collect();
        assert!(mistake(&folder(&files)).to_string().contains("more than 256 files"));

        let large = folder(&[("top.toml", &" ".repeat((16 << 20) + 1))]);
        assert!(mistake(&large).to_string().ends_with("the document has more than 16 MiB"));
        let parts = [("top.toml", "extends = [\"a\", \"a\"]"), ("a", &"\n".repeat(9 << 20))];
        assert!(mistake(&folder(&parts)).to_string().contains("more than 16 MiB"));
    }

    #[test]
    fn what_is_no_file_is_unreadable() {
        let folder = folder(&[]);
        let unreadable = |name: &str| match Document::read(folder.path().join(name)) {
            Err(DocumentError::Unreadable { reason, .. }) => reason,
            other => panic!("{other:?}"),
        };
        assert!(unreadable("gone.toml").starts_with("there is no such file"));
        assert_eq!(unreadable("."), "it is a folder, a file was expected");
    }

    #[test]
    fn nesting_beyond_the_limit_is_an_error() {
        let mut text = "x = ".to_owned();
        let dots = ["a"; 79].join(".");
        for _ in 0..78 {
            write!(text, "{{ {dots} = ").unwrap();
        }
        write!(text, "1{}", "}".repeat(78)).unwrap();
        let error = Document::from_text("deep", &text).unwrap_err();
        assert!(error.to_string().contains("expected at most 128 levels"), "{error}");
        let brackets = format!("x = {}", "[".repeat(1 << 20));
        let error = Document::from_text("deep", &brackets).unwrap_err();
        assert!(error.to_string().contains("max recursion depth"), "{error}");
        let mut document = Document::from_text("a", "").unwrap();
        assert!(document.set(&format!("{}=1", vec!["a"; 1 << 20].join("."))).is_err());
    }

    #[test]
    fn a_text_has_no_folder_to_extend_from() {
        let error = Document::from_text("built in", "extends = \"a.toml\"").unwrap_err();
        assert_eq!(error.to_string(), "built in:1:1: extends: nothing can be extended here");
    }
}
