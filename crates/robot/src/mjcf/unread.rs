//! What of a file is passed over: looks and helpers in silence, the rest by name.

use std::collections::BTreeMap;

use crate::mjcf::element::Element;
use crate::warning::RobotWarning;

/// Elements of the root that say nothing of the motion of the arm alone.
const HARMLESS: [&str; 12] = [
    "asset",
    "compiler",
    "contact",
    "custom",
    "default",
    "keyframe",
    "option",
    "sensor",
    "size",
    "statistic",
    "visual",
    "extension",
];

/// Elements of a body that are read, or say nothing of its motion.
const IN_BODY: [&str; 9] =
    ["body", "inertial", "joint", "freejoint", "geom", "site", "camera", "light", "frame"];

/// Everything that may matter and is passed over, by what it is.
#[derive(Debug, Default)]
pub struct Unread {
    counts: BTreeMap<String, usize>,
}

impl Unread {
    /// Counts something.
    pub fn add(&mut self, what: impl Into<String>) {
        *self.counts.entry(what.into()).or_default() += 1;
    }

    /// Counts what of the root is not read.
    pub fn of_root(&mut self, root: &Element) {
        for child in &root.children {
            match child.name.as_str() {
                "worldbody" | "actuator" | "equality" => {}
                "tendon" | "deformable" => {
                    child
                        .children
                        .iter()
                        .for_each(|c| self.add(format!("<{}> of <{}>", c.name, child.name)));
                }
                name if HARMLESS.contains(&name) => {}
                name => self.add(format!("<{name}>")),
            }
        }
        for option in root.all("option") {
            for key in ["wind", "density", "viscosity"] {
                let zero = |text: &str| text.split_whitespace().all(|t| t.parse() == Ok(0.0));
                if option.get(key).is_some_and(|text| !zero(text)) {
                    self.add(format!("{key} of <option>"));
                }
            }
        }
        if root.all("compiler").any(|c| c.get("settotalmass").is_some()) {
            self.add("settotalmass of <compiler>");
        }
    }

    /// Counts what of a body is not read.
    pub fn of_body(&mut self, body: &Element) {
        for child in body.children.iter().filter(|c| !IN_BODY.contains(&c.name.as_str())) {
            self.add(format!("<{}>", child.name));
        }
        for key in ["gravcomp", "mocap"] {
            if body.get(key).is_some_and(|text| text != "false" && text.parse() != Ok(0.0)) {
                self.add(format!("{key} of <body>"));
            }
        }
    }

    /// A warning for each.
    pub fn warnings(self) -> impl Iterator<Item = RobotWarning> {
        self.counts.into_iter().map(|(what, count)| RobotWarning::NotUnderstood { what, count })
    }
}
