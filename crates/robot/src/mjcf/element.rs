use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use crate::error::RobotError;
use crate::one_line::one_line;

/// Deepest nesting that is read.
const MAX_DEPTH: usize = 200;
/// Most elements that are read, with those of included files.
const MOST_ELEMENTS: usize = 1 << 20;

/// An element of an MJCF with all that is inside of it.
#[derive(Debug, Clone, Default)]
pub struct Element {
    pub name: String,
    pub attributes: Vec<(String, String)>,
    pub children: Vec<Element>,
    /// Line on which its tag ends, from 1, in the file that it stands in.
    pub line: usize,
}

impl Element {
    /// An attribute.
    pub fn get(&self, key: &str) -> Option<&str> {
        self.attributes.iter().find(|(name, _)| name == key).map(|(_, value)| value.as_str())
    }

    /// The children with a name.
    pub fn all<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Element> {
        self.children.iter().filter(move |child| child.name == name)
    }

    /// What an error calls it.
    pub fn label(&self) -> String {
        match self.get("name") {
            Some(name) => format!("{} {name}", self.name),
            None => format!("<{}>", self.name),
        }
    }

    /// An error about it.
    pub fn bad(&self, reason: impl Into<String>) -> RobotError {
        RobotError::BadElement { element: self.label(), line: self.line, reason: reason.into() }
    }

    /// Its text, on one line.
    pub fn to_xml(&self) -> String {
        let mut text = format!("<{}", self.name);
        for (key, value) in &self.attributes {
            text.push_str(&format!(" {key}=\"{}\"", quick_xml::escape::escape(value.as_str())));
        }
        text.push('>');
        self.children.iter().for_each(|child| text.push_str(&child.to_xml()));
        text.push_str(&format!("</{}>\n", self.name));
        text
    }
}

/// Whether a text is an MJCF: its first element is `<mujoco>`.
pub fn is_mjcf(text: &str) -> bool {
    let mut reader = Reader::from_str(text);
    loop {
        match reader.read_event() {
            Ok(Event::Start(tag) | Event::Empty(tag)) => return tag.name().as_ref() == b"mujoco",
            Ok(Event::Eof) | Err(_) => return false,
            Ok(_) => {}
        }
    }
}

/// The files of an MJCF: itself and those that it includes.
pub struct Files<'a> {
    /// The folder that names of files are read from.
    folder: &'a Path,
    /// Reads a file.
    read: &'a dyn Fn(&Path) -> Result<String, RobotError>,
    included: BTreeSet<PathBuf>,
    elements: usize,
}

impl<'a> Files<'a> {
    /// The files of an MJCF in `folder`.
    pub fn new(folder: &'a Path, read: &'a dyn Fn(&Path) -> Result<String, RobotError>) -> Self {
        Self { folder, read, included: BTreeSet::new(), elements: 0 }
    }

    /// Whether the file includes others.
    pub fn has_includes(&self) -> bool {
        !self.included.is_empty()
    }

    /// The root of a text, what it includes put in the place of `<include>`.
    ///
    /// # Errors
    ///
    /// [`RobotError::Malformed`], [`RobotError::BadElement`] for an include that is read twice, and
    /// what is wrong with an included file.
    pub fn root(&mut self, text: &str) -> Result<Element, RobotError> {
        let mut root = self.parse(text)?;
        self.expand(&mut root, 0)?;
        Ok(root)
    }

    fn expand(&mut self, element: &mut Element, depth: usize) -> Result<(), RobotError> {
        if depth > MAX_DEPTH {
            return Err(element.bad(format!("elements are nested more than {MAX_DEPTH} deep")));
        }
        let mut children = vec![];
        for mut child in std::mem::take(&mut element.children) {
            if child.name != "include" {
                self.expand(&mut child, depth + 1)?;
                children.push(child);
                continue;
            }
            let name = child.get("file").ok_or_else(|| child.bad("it names no file"))?;
            let path = self.folder.join(name);
            if !self.included.insert(path.clone()) {
                return Err(child.bad(format!("{name} is included twice, once was expected")));
            }
            let text = (self.read)(&path)?;
            let mut included = self.parse(&text).map_err(|e| e.in_file(&path))?;
            self.expand(&mut included, depth + 1)?;
            children.append(&mut included.children);
        }
        element.children = children;
        Ok(())
    }

    fn parse(&mut self, text: &str) -> Result<Element, RobotError> {
        let mut reader = Reader::from_str(text);
        let (mut open, mut root) = (Vec::<Element>::new(), None);
        let (mut line, mut counted) = (1, 0);
        loop {
            let event = reader.read_event();
            let at = usize::try_from(reader.buffer_position()).unwrap_or(text.len());
            let at = at.clamp(counted, text.len());
            line += text.as_bytes()[counted..at].iter().filter(|&&b| b == b'\n').count();
            counted = at;
            let malformed = |reason: String| RobotError::Malformed { line, reason };
            match event.map_err(|e| malformed(one_line(&e.to_string())))? {
                Event::Start(tag) => {
                    if open.len() == MAX_DEPTH {
                        let reason = format!("elements are nested more than {MAX_DEPTH} deep");
                        return Err(malformed(reason));
                    }
                    open.push(self.element(&tag, line)?);
                }
                Event::Empty(tag) => {
                    let element = self.element(&tag, line)?;
                    place(element, &mut open, &mut root);
                }
                Event::End(_) => {
                    if let Some(element) = open.pop() {
                        place(element, &mut open, &mut root);
                    }
                }
                Event::Eof => break,
                _ => {}
            }
        }
        if let Some(element) = open.last() {
            let reason = format!("the file ends inside <{}>", element.name);
            return Err(RobotError::Malformed { line, reason });
        }
        let reason = "no element was found, <mujoco> was expected".to_owned();
        root.ok_or(RobotError::Malformed { line, reason })
    }

    fn element(&mut self, tag: &BytesStart<'_>, line: usize) -> Result<Element, RobotError> {
        self.elements += 1;
        let malformed = |reason: String| RobotError::Malformed { line, reason };
        if self.elements > MOST_ELEMENTS {
            return Err(malformed(format!("there are more than {MOST_ELEMENTS} elements")));
        }
        let name = String::from_utf8_lossy(tag.name().as_ref()).into_owned();
        let mut attributes = vec![];
        for found in tag.attributes() {
            let found = found.map_err(|e| malformed(one_line(&e.to_string())))?;
            let value = found.unescape_value().map_err(|e| malformed(e.to_string()))?.into_owned();
            attributes.push((String::from_utf8_lossy(found.key.as_ref()).into_owned(), value));
        }
        Ok(Element { name, attributes, children: vec![], line })
    }
}

fn place(element: Element, open: &mut [Element], root: &mut Option<Element>) {
    match open.last_mut() {
        Some(parent) => parent.children.push(element),
        None => *root = root.take().or(Some(element)),
    }
}
