use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use crate::error::RobotError;
use crate::one_line::one_line;
use crate::warning::RobotWarning;

/// Deepest nesting of elements; a URDF needs six.
const MAX_DEPTH: usize = 64;
/// Longest start tag (bytes); looking for attributes given twice costs its square.
const LONGEST_TAG: usize = 16 << 10;
/// Children of a link and of a joint that matter here. Shapes and meshes do not.
const KEPT_IN_LINK: [&str; 1] = ["inertial"];
const KEPT_IN_JOINT: [&str; 7] =
    ["origin", "parent", "child", "axis", "limit", "dynamics", "mimic"];
/// Attributes that hold one number or several.
const NUMERIC: [&str; 18] = [
    "xyz",
    "rpy",
    "quat_xyzw",
    "value",
    "ixx",
    "ixy",
    "ixz",
    "iyy",
    "iyz",
    "izz",
    "lower",
    "upper",
    "effort",
    "velocity",
    "damping",
    "friction",
    "multiplier",
    "offset",
];

/// The part of a URDF that says how the robot moves.
#[derive(Debug, Default)]
pub(super) struct Outline {
    /// The start tag `<robot ...>`.
    pub robot_tag: String,
    pub links: Vec<Element>,
    pub joints: Vec<Element>,
    pub warnings: Vec<RobotWarning>,
}

/// A link or a joint, reduced to the children that matter.
#[derive(Debug)]
pub(super) struct Element {
    /// `link forearm`.
    pub label: String,
    /// Line of the start tag, from 1.
    pub line: usize,
    pub xml: String,
    /// Names of the children that are kept.
    children: Vec<String>,
}

impl Element {
    /// Whether the link declares an inertia; `urdf-rs` reads a missing one as zero.
    pub fn has_inertial(&self) -> bool {
        self.children.iter().any(|c| c == "inertial")
    }
}

/// Reads the outline of a URDF and refuses text that is not well-formed.
///
/// # Errors
///
/// [`RobotError::Malformed`] and [`RobotError::BadElement`].
pub(super) fn outline(text: &str) -> Result<Outline, RobotError> {
    let mut reader = Reader::from_str(text);
    let mut scan = Scan { line: 1, ..Scan::default() };
    let mut counted = 0;
    loop {
        let event = reader.read_event();
        // The line on which the tag just read ends: tags rarely span lines.
        let at = if event.is_err() { reader.error_position() } else { reader.buffer_position() };
        let at = usize::try_from(at).unwrap_or(text.len()).clamp(counted, text.len());
        scan.line += text.as_bytes()[counted..at].iter().filter(|&&b| b == b'\n').count();
        counted = at;
        match event {
            Ok(Event::Start(tag)) => scan.open(&tag)?,
            Ok(Event::Empty(tag)) => {
                scan.open(&tag)?;
                scan.close();
            }
            Ok(Event::End(_)) => scan.close(),
            Ok(Event::Eof) => return scan.finish(),
            Ok(_) => {}
            Err(error) => return Err(scan.refuse(one_line(&error.to_string()))),
        }
    }
}

#[derive(Default)]
struct Scan {
    line: usize,
    open: Vec<String>,
    /// Depth of the element that is being left out, with all its children.
    skipped_from: Option<usize>,
    current: Option<Element>,
    outline: Outline,
}

impl Scan {
    fn open(&mut self, tag: &BytesStart<'_>) -> Result<(), RobotError> {
        let depth = self.open.len();
        let name = String::from_utf8_lossy(tag.name().as_ref()).into_owned();
        if depth == MAX_DEPTH {
            return Err(self.refuse(format!("elements are nested more than {MAX_DEPTH} deep")));
        }
        if tag.len() > LONGEST_TAG {
            return Err(self.refuse(format!("a tag has more than {LONGEST_TAG} bytes")));
        }
        if name.starts_with("xacro:") {
            let reason = format!(
                "<{name}> was found, expand the file with xacro first: xacro FILE > robot.urdf"
            );
            return Err(self.refuse(reason));
        }
        let kept = self.skipped_from.is_none() && self.keep(depth, &name, tag)?;
        if !kept && self.skipped_from.is_none() {
            self.skipped_from = Some(depth);
        }
        self.open.push(name);
        Ok(())
    }

    /// Takes the element into the outline; `false` when it is none of its parts.
    fn keep(&mut self, depth: usize, name: &str, tag: &BytesStart<'_>) -> Result<bool, RobotError> {
        let xml = format!("<{}>", String::from_utf8_lossy(tag));
        if depth == 0 {
            return self.keep_root(name, xml);
        }
        let Some(element) = &mut self.current else {
            if name != "link" && name != "joint" {
                return Ok(false);
            }
            let label = format!("{name} {}", attribute(tag, "name"));
            self.current = Some(Element { label, line: self.line, xml, children: vec![] });
            return Ok(true);
        };
        let in_link = self.open.get(1).is_some_and(|n| n == "link");
        let known = if in_link { &KEPT_IN_LINK[..] } else { &KEPT_IN_JOINT[..] };
        if depth == 2 && !known.contains(&name) {
            return Ok(false);
        }
        if depth == 2 {
            // urdfdom takes the first of several, and some published files rely on it.
            if element.children.iter().any(|c| c == name) {
                let (element, child, line) = (element.label.clone(), name.to_owned(), self.line);
                self.outline.warnings.push(RobotWarning::Repeated { element, child, line });
                return Ok(false);
            }
            element.children.push(name.to_owned());
        }
        element.xml.push_str(&xml);
        numbers_only(tag).map_err(|reason| RobotError::BadElement {
            element: element.label.clone(),
            line: self.line,
            reason,
        })?;
        Ok(true)
    }

    fn keep_root(&mut self, name: &str, xml: String) -> Result<bool, RobotError> {
        if !self.outline.robot_tag.is_empty() {
            return Err(self.refuse(format!("a second root <{name}>, one was expected")));
        }
        if name != "robot" {
            return Err(self.refuse(format!("the root is <{name}>, <robot> was expected")));
        }
        self.outline.robot_tag = xml;
        Ok(true)
    }

    fn close(&mut self) {
        let Some(name) = self.open.pop() else { return };
        let depth = self.open.len();
        if let Some(from) = self.skipped_from {
            if from == depth {
                self.skipped_from = None;
            }
            return;
        }
        if let Some(element) = &mut self.current {
            element.xml.push_str(&format!("</{name}>"));
        }
        if depth == 1 {
            let list =
                if name == "link" { &mut self.outline.links } else { &mut self.outline.joints };
            list.extend(self.current.take());
        }
    }

    fn finish(self) -> Result<Outline, RobotError> {
        match self.open.last() {
            Some(name) => Err(self.refuse(format!("the file ends inside <{name}>"))),
            None if self.outline.robot_tag.is_empty() => {
                Err(self.refuse("no element was found, <robot> was expected".to_owned()))
            }
            None => Ok(self.outline),
        }
    }

    fn refuse(&self, reason: String) -> RobotError {
        RobotError::Malformed { line: self.line, reason }
    }
}

/// An attribute of a tag, or words that say that there is none.
pub(super) fn attribute(tag: &BytesStart<'_>, name: &str) -> String {
    let found = tag.try_get_attribute(name).ok().flatten();
    found
        .and_then(|a| a.unescape_value().ok().map(|v| v.into_owned()))
        .unwrap_or_else(|| "without a name".to_owned())
}

/// Refuses an attribute that should hold numbers and holds something else.
fn numbers_only(tag: &BytesStart<'_>) -> Result<(), String> {
    for found in tag.attributes() {
        let found = found.map_err(|e| one_line(&e.to_string()))?;
        let key = String::from_utf8_lossy(found.key.as_ref());
        let value = found.unescape_value().map_err(|e| one_line(&e.to_string()))?;
        let numbers = value.split_whitespace().all(|t| t.parse::<f64>().is_ok());
        if NUMERIC.contains(&key.as_ref()) && (!numbers || value.trim().is_empty()) {
            let tag = String::from_utf8_lossy(tag.name().as_ref()).into_owned();
            let value: String = value.chars().take(40).collect();
            return Err(format!("<{tag} {key}=\"{value}\"> was found, a number was expected"));
        }
    }
    Ok(())
}
