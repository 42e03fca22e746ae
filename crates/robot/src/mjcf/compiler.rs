use nalgebra::{UnitQuaternion, Vector3};

use crate::error::RobotError;
use crate::mjcf::element::Element;

/// Where the inertia of a body comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InertiaSource {
    /// `<inertial>`, or the shapes where there is none.
    Either,
    /// `<inertial>` alone.
    Inertial,
    /// The shapes alone.
    Shapes,
}

/// `<compiler>`: how the numbers of the file are meant.
#[derive(Debug, Clone)]
pub struct Compiler {
    degrees: bool,
    /// Axes of Euler angles; capital letters are axes that stay.
    sequence: [char; 3],
    /// Whether a range alone limits a joint.
    pub autolimits: bool,
    pub inertia: InertiaSource,
    /// Folder of the meshes.
    pub mesh_folder: String,
}

impl Compiler {
    /// What the file says.
    ///
    /// # Errors
    ///
    /// [`RobotError::BadElement`] for a sequence of Euler angles that is none.
    pub fn new(root: &Element) -> Result<Self, RobotError> {
        let mut compiler = Self {
            degrees: true,
            sequence: ['x', 'y', 'z'],
            autolimits: true,
            inertia: InertiaSource::Either,
            mesh_folder: String::new(),
        };
        for element in root.all("compiler") {
            compiler.learn(element)?;
        }
        Ok(compiler)
    }

    fn learn(&mut self, element: &Element) -> Result<(), RobotError> {
        if let Some(angle) = element.get("angle") {
            self.degrees = angle != "radian";
        }
        if let Some(text) = element.get("eulerseq") {
            let letters: Vec<char> = text.chars().collect();
            let known = letters.iter().all(|c| "xyzXYZ".contains(*c));
            let sequence: Option<[char; 3]> = letters.try_into().ok();
            self.sequence = sequence.filter(|_| known).ok_or_else(|| {
                element.bad(format!("eulerseq=\"{text}\" was found, three of xyzXYZ were expected"))
            })?;
        }
        if let Some(text) = element.get("autolimits") {
            self.autolimits = text == "true";
        }
        match element.get("inertiafromgeom") {
            Some("true") => self.inertia = InertiaSource::Shapes,
            Some("false") => self.inertia = InertiaSource::Inertial,
            Some(_) => self.inertia = InertiaSource::Either,
            None => {}
        }
        if let Some(folder) = element.get("meshdir").or_else(|| element.get("assetdir")) {
            self.mesh_folder = folder.to_owned();
        }
        Ok(())
    }

    /// An angle of the file (rad).
    pub fn radians(&self, angle: f64) -> f64 {
        if self.degrees { angle.to_radians() } else { angle }
    }

    /// Turns about three axes, one after the other: small letters are axes that turn along.
    pub fn euler(&self, angles: [f64; 3]) -> UnitQuaternion<f64> {
        let pairs = self.sequence.iter().zip(angles);
        pairs.fold(UnitQuaternion::identity(), |so_far, (axis, angle)| {
            let direction = match axis.to_ascii_lowercase() {
                'x' => Vector3::x_axis(),
                'y' => Vector3::y_axis(),
                _ => Vector3::z_axis(),
            };
            let turn = UnitQuaternion::from_axis_angle(&direction, self.radians(angle));
            if axis.is_ascii_uppercase() { turn * so_far } else { so_far * turn }
        })
    }
}
