use nalgebra::Isometry3;
use quick_xml::events::BytesStart;
use robot::Link;

use crate::numbers::{number, numbers};
use crate::quantity::levels;
use crate::reported::motion;
use crate::urdf::tag::{pose, text};

/// The changes at a joint of a URDF.
pub struct JointChange {
    /// Viscous friction and the level of dry friction.
    dynamics: Option<[f64; 2]>,
    /// Motion by which its origin is multiplied from the right.
    moved: Option<Isometry3<f64>>,
    /// Lowest and highest position where these move with it.
    position: Option<(f64, f64)>,
    /// Largest effort.
    effort: Option<f64>,
    /// Whether the file has the joint.
    pub found: bool,
    has_dynamics: bool,
    has_origin: bool,
}

impl JointChange {
    /// The changes from the nominal link to the reported one; `offset` is that of its encoder.
    pub fn new(new: &Link, old: &Link, offset: f64) -> Self {
        let drive = |link: &Link| [link.actuator.viscous, levels(&link.actuator).0];
        let differs = |a: f64, b: f64| (a - b).abs() > 0.0;
        let (now, before) = (drive(new), drive(old));
        let dynamics = (0..2).any(|i| differs(now[i], before[i])).then_some(now);
        let moved = (offset.abs() > 0.0).then(|| motion(&old.joint, -offset));
        let effort =
            new.joint.limits.effort.filter(|limit| old.joint.limits.effort != Some(*limit));
        Self {
            dynamics,
            moved,
            position: new.joint.limits.position.filter(|_| moved.is_some()),
            effort,
            found: false,
            has_dynamics: false,
            has_origin: false,
        }
    }

    /// The replacement of a tag inside the joint, if it changes.
    pub fn replacement(&mut self, name: &str, tag: &BytesStart<'_>) -> Option<BytesStart<'static>> {
        match name {
            "dynamics" if !self.has_dynamics => {
                self.has_dynamics = true;
                self.dynamics.map(dynamics)
            }
            "origin" if !self.has_origin => {
                self.has_origin = true;
                self.moved.map(|moved| origin(&(pose(tag) * moved)))
            }
            "limit" => self.limit(tag),
            _ => None,
        }
    }

    /// The tags that the joint lacks at its end.
    pub fn missing(&self) -> Vec<BytesStart<'static>> {
        let own = self.dynamics.filter(|_| !self.has_dynamics).map(dynamics);
        let moved = self.moved.filter(|_| !self.has_origin).map(|moved| origin(&moved));
        moved.into_iter().chain(own).collect()
    }

    fn limit(&self, tag: &BytesStart<'_>) -> Option<BytesStart<'static>> {
        let changes = [
            ("lower", self.position.map(|(low, _)| low)),
            ("upper", self.position.map(|(_, high)| high)),
            ("effort", self.effort),
        ];
        changes.iter().find_map(|(_, value)| *value)?;
        let mut limit = BytesStart::new("limit");
        for key in ["lower", "upper", "effort", "velocity"] {
            let new = changes.iter().find(|(name, _)| *name == key).and_then(|(_, value)| *value);
            if let Some(value) = new.map(number).or_else(|| text(tag, key)) {
                limit.push_attribute((key, value.as_str()));
            }
        }
        Some(limit)
    }
}

fn dynamics([damping, friction]: [f64; 2]) -> BytesStart<'static> {
    let (damping, friction) = (number(damping), number(friction));
    BytesStart::new("dynamics")
        .with_attributes([("damping", damping.as_str()), ("friction", friction.as_str())])
}

fn origin(pose: &Isometry3<f64>) -> BytesStart<'static> {
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    let (xyz, rpy) = (numbers(pose.translation.vector.iter()), numbers(&[roll, pitch, yaw]));
    BytesStart::new("origin").with_attributes([("xyz", xyz.as_str()), ("rpy", rpy.as_str())])
}
