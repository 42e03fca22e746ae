//! Edits the differences of a robot into the text of its URDF.

use std::collections::BTreeMap;

use nalgebra::Isometry3;
use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, Writer};
use robot::{Inertia, Link, Loaded, Robot};

use crate::error::ExchangeError;
use crate::fate::Fate;
use crate::numbers::{moments, number, numbers};
use crate::quantity::DriveQuantity;
use crate::unsupported::fate_of_unsupported;
use crate::urdf::inertial::{from_urdf, with_change};
use crate::urdf::joint_change::JointChange;
use crate::urdf::tag::{pose, text, value};

/// The text with every difference of `robot` edited in.
pub fn edit(loaded: &Loaded, robot: &Robot, source: &str) -> Result<String, ExchangeError> {
    let mut edit = Edit::new(loaded, robot);
    let mut reader = Reader::from_str(source);
    loop {
        let malformed = |reason: String, at| ExchangeError::Malformed { at, reason };
        let at = reader.buffer_position();
        let event = reader.read_event().map_err(|e| malformed(e.to_string(), at))?;
        if matches!(event, Event::Eof) {
            break;
        }
        edit.take(event).map_err(|reason| malformed(reason, at))?;
    }
    if let Some((joint, _)) = edit.joints.iter().find(|(_, change)| !change.found) {
        return Err(ExchangeError::JointAbsent { joint: joint.clone() });
    }
    Ok(String::from_utf8_lossy(&edit.writer.into_inner()).into_owned())
}

/// How a URDF represents a quantity of a joint.
pub fn fate(quantity: DriveQuantity) -> Fate {
    match quantity {
        DriveQuantity::Viscous => Fate::exact("<dynamics damping>"),
        DriveQuantity::Coulomb => Fate::exact("<dynamics friction>"),
        DriveQuantity::EncoderOffset => Fate::exact("<origin> of the joint, <limit>"),
        other => fate_of_unsupported(other),
    }
}

/// Inertias of a body before and after.
struct LinkChange<'a> {
    old: &'a Inertia,
    new: &'a Inertia,
    written: bool,
}

/// The element of the robot that is being read.
enum Current {
    Joint(String),
    Link(String),
    /// Its inertia, as far as it was read.
    Inertial(String, Own),
    Other,
}

/// `<inertial>` of the file.
struct Own {
    mass: f64,
    pose: Isometry3<f64>,
    moments: [f64; 6],
}

impl Own {
    fn new() -> Self {
        Self { mass: 0.0, pose: Isometry3::identity(), moments: [0.0; 6] }
    }

    fn read(&mut self, tag: &BytesStart<'_>) {
        match tag.name().as_ref() {
            b"mass" => self.mass = value(tag, "value"),
            b"origin" => self.pose = pose(tag),
            b"inertia" => {
                let keys = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
                self.moments = keys.map(|key| value(tag, key));
            }
            _ => {}
        }
    }
}

/// How a tag opens its element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    /// It holds something.
    Holds,
    /// It ends with the tag.
    Empty,
}

impl Form {
    fn event(self, tag: BytesStart<'_>) -> Event<'_> {
        match self {
            Self::Holds => Event::Start(tag),
            Self::Empty => Event::Empty(tag),
        }
    }
}

struct Edit<'a> {
    writer: Writer<Vec<u8>>,
    joints: BTreeMap<String, JointChange>,
    links: BTreeMap<String, LinkChange<'a>>,
    depth: usize,
    current: Current,
    /// Depth of an element that is left out with all that is inside of it.
    skipped_from: Option<usize>,
}

impl<'a> Edit<'a> {
    fn new(loaded: &'a Loaded, robot: &'a Robot) -> Self {
        let nominal = loaded.robot_in_urdf.links();
        let offsets = loaded.robot.links().iter().map(|link| link.actuator.encoder_offset);
        let pairs = robot.links().iter().zip(nominal);
        let joints = pairs.clone().zip(offsets).map(|((new, old), offset)| {
            (new.joint.name.clone(), JointChange::new(new, old, offset))
        });
        let links = pairs.filter(|(new, old)| new.inertia != old.inertia);
        let change = |(new, old): (&'a Link, &'a Link)| {
            let change = LinkChange { old: &old.inertia, new: &new.inertia, written: false };
            (new.name.clone(), change)
        };
        Self {
            writer: Writer::new(vec![]),
            joints: joints.collect(),
            links: links.map(change).collect(),
            depth: 0,
            current: Current::Other,
            skipped_from: None,
        }
    }

    fn take(&mut self, event: Event<'_>) -> Result<(), String> {
        match event {
            Event::Start(tag) => {
                self.read(&tag);
                let kept = self.skipped_from.is_none() && self.open(&tag, Form::Holds)?;
                if !kept && self.skipped_from.is_none() {
                    self.skipped_from = Some(self.depth);
                }
                self.depth += 1;
                Ok(())
            }
            Event::Empty(tag) => {
                self.read(&tag);
                if self.skipped_from.is_none() {
                    self.open(&tag, Form::Empty)?;
                }
                Ok(())
            }
            Event::End(tag) => {
                self.depth = self.depth.saturating_sub(1);
                self.close()?;
                match self.skipped_from {
                    Some(from) if from == self.depth => self.skipped_from = None,
                    Some(_) => {}
                    None => self.write(Event::End(tag))?,
                }
                Ok(())
            }
            // What stands inside of an element that is read anew goes with it.
            _ if self.skipped_from.is_some() => Ok(()),
            other => self.write(other),
        }
    }

    /// Reads a tag inside an inertia.
    fn read(&mut self, tag: &BytesStart<'_>) {
        if let (Current::Inertial(_, own), 3) = (&mut self.current, self.depth) {
            own.read(tag);
        }
    }

    /// Writes a tag, changed where it must be; `false` where its element is left out.
    fn open(&mut self, tag: &BytesStart<'_>, form: Form) -> Result<bool, String> {
        let name = String::from_utf8_lossy(tag.name().as_ref()).into_owned();
        if self.depth == 1 {
            self.current = self.element(&name, tag);
            if let (Current::Link(link), Form::Empty) = (&self.current, form) {
                let link = link.clone();
                self.write(Event::Start(tag.to_owned()))?;
                self.inertial(&link, &Own::new())?;
                self.write(Event::End(tag.to_end()))?;
                return Ok(true);
            }
        }
        if self.depth == 2 {
            match &self.current {
                Current::Link(link) if name == "inertial" && self.links[link].written => {}
                Current::Link(link) if name == "inertial" => {
                    let link = link.clone();
                    if form == Form::Empty {
                        self.inertial(&link, &Own::new())?;
                    } else {
                        self.current = Current::Inertial(link, Own::new());
                        self.skipped_from = Some(self.depth);
                    }
                    return Ok(false);
                }
                Current::Joint(joint) => {
                    let change = self.joints.get_mut(joint);
                    if let Some(tag) = change.and_then(|change| change.replacement(&name, tag)) {
                        self.write(form.event(tag))?;
                        return Ok(true);
                    }
                }
                _ => {}
            }
        }
        let tag = tag.to_owned();
        self.write(form.event(tag))?;
        Ok(true)
    }

    fn element(&mut self, name: &str, tag: &BytesStart<'_>) -> Current {
        let called = text(tag, "name").unwrap_or_default();
        match name {
            "joint" => match self.joints.get_mut(&called) {
                Some(change) => {
                    change.found = true;
                    Current::Joint(called)
                }
                None => Current::Other,
            },
            "link" if self.links.contains_key(&called) => Current::Link(called),
            _ => Current::Other,
        }
    }

    /// Before the end of an element is written.
    fn close(&mut self) -> Result<(), String> {
        match std::mem::replace(&mut self.current, Current::Other) {
            Current::Inertial(link, own) if self.depth == 2 => {
                self.inertial(&link, &own)?;
                self.current = Current::Link(link);
            }
            Current::Link(link) if self.depth == 1 => {
                if !self.links[&link].written {
                    self.indent("  ")?;
                    self.inertial(&link, &Own::new())?;
                    self.indent("\n  ")?;
                }
            }
            Current::Joint(joint) if self.depth == 1 => {
                let missing = self.joints.get(&joint).map(JointChange::missing);
                for tag in missing.into_iter().flatten() {
                    self.indent("  ")?;
                    self.write(Event::Empty(tag))?;
                    self.indent("\n  ")?;
                }
            }
            other => self.current = other,
        }
        Ok(())
    }

    fn inertial(&mut self, link: &str, own: &Own) -> Result<(), String> {
        let Some(change) = self.links.get_mut(link) else { return Ok(()) };
        change.written = true;
        let own = from_urdf(own.mass, &own.pose, own.moments);
        let new = with_change(&own, change.old, change.new);
        let i = &new.about_com;
        let origin = BytesStart::new("origin")
            .with_attributes([("xyz", numbers(new.com_in_link.iter()).as_str()), ("rpy", "0 0 0")]);
        let mass = BytesStart::new("mass").with_attributes([("value", number(new.mass).as_str())]);
        let moments = moments(i);
        let moments = moments.iter().map(|(key, value)| (*key, value.as_str()));
        let inertia = BytesStart::new("inertia").with_attributes(moments);
        let inertial = BytesStart::new("inertial");
        self.write(Event::Start(inertial.borrow()))?;
        for tag in [origin, mass, inertia] {
            self.indent("\n      ")?;
            self.write(Event::Empty(tag))?;
        }
        self.indent("\n    ")?;
        self.write(Event::End(inertial.to_end()))
    }

    fn indent(&mut self, blanks: &str) -> Result<(), String> {
        self.write(Event::Text(quick_xml::events::BytesText::from_escaped(blanks)))
    }

    fn write(&mut self, event: Event<'_>) -> Result<(), String> {
        self.writer.write_event(event).map_err(|e| e.to_string())
    }
}
