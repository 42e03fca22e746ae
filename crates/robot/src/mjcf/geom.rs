//! Shapes: what they look like, and the inertia of bodies that have no other.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::path::PathBuf;

use nalgebra::{Isometry3, Matrix3, Translation3, Unit, Vector3};

use crate::error::RobotError;
use crate::mjcf::element::Element;
use crate::mjcf::view::{View, rotation_of_z_to};
use crate::structure::inertia::Inertia;
use crate::structure::looks::{Shape, Visual};

/// Density of a shape that does not say another (kg/m³).
const DENSITY: f64 = 1000.0;
/// Shapes of this group and above are for contact, and not drawn.
const FIRST_HIDDEN_GROUP: f64 = 3.0;

/// Files and scales of meshes by name.
pub type Meshes = BTreeMap<String, (PathBuf, Vector3<f64>)>;

/// A shape of a body.
pub struct Geom {
    pub body_from_shape: Isometry3<f64>,
    kind: String,
    size: Vec<f64>,
    mass: Option<f64>,
    density: f64,
}

impl Geom {
    /// The shape that an element describes.
    pub fn new(view: &View<'_>) -> Result<Self, RobotError> {
        let mut size = view.numbers("size", 3)?.unwrap_or_default();
        let mut pose = view.pose()?;
        let default = if view.text("mesh").is_some() { "mesh" } else { "sphere" };
        let kind = view.text("type").unwrap_or(default).to_owned();
        if let Some([a, b, c, d, e, f]) = view.exactly::<6>("fromto")? {
            let (from, to) = (Vector3::new(a, b, c), Vector3::new(d, e, f));
            let along = Unit::try_new(from - to, 0.0)
                .ok_or_else(|| view.element.bad("fromto has two equal ends"))?;
            let middle = Translation3::from(0.5 * (from + to));
            pose = Isometry3::from_parts(middle, rotation_of_z_to(&along));
            let half = 0.5 * (to - from).norm();
            let last = if matches!(kind.as_str(), "capsule" | "cylinder") { 1 } else { 2 };
            size.resize(last, size.first().copied().unwrap_or_default());
            size.push(half);
        }
        Ok(Self {
            body_from_shape: pose,
            kind,
            size,
            mass: view.number("mass")?,
            density: view.number("density")?.unwrap_or(DENSITY),
        })
    }

    /// Its inertia in the frame of the body; `None` where its volume is that of a file.
    pub fn inertia(&self) -> Option<Inertia> {
        if self.mass.is_some_and(|mass| mass <= 0.0) || self.density <= 0.0 && self.mass.is_none() {
            return Some(Inertia::zero());
        }
        let (volume, moments) = self.of_unit_mass()?;
        let mass = self.mass.unwrap_or(self.density * volume);
        let own = Inertia {
            mass,
            com_in_link: Vector3::zeros(),
            about_com: Matrix3::from_diagonal(&(mass * moments)),
        };
        Some(own.in_frame(&self.body_from_shape))
    }

    /// Volume (m³) and principal moments per mass (m²).
    fn of_unit_mass(&self) -> Option<(f64, Vector3<f64>)> {
        let at = |i: usize| self.size.get(i).copied();
        match self.kind.as_str() {
            "plane" => Some((0.0, Vector3::zeros())),
            "sphere" => {
                let r = at(0)?;
                Some((4.0 / 3.0 * PI * r.powi(3), Vector3::repeat(0.4 * r * r)))
            }
            "ellipsoid" => {
                let [a, b, c] = [at(0)?, at(1)?, at(2)?];
                let moments = Vector3::new(b * b + c * c, a * a + c * c, a * a + b * b) / 5.0;
                Some((4.0 / 3.0 * PI * a * b * c, moments))
            }
            "box" => {
                let [a, b, c] = [at(0)?, at(1)?, at(2)?];
                let moments = Vector3::new(b * b + c * c, a * a + c * c, a * a + b * b) / 3.0;
                Some((8.0 * a * b * c, moments))
            }
            "cylinder" => {
                let [r, h] = [at(0)?, at(1)?];
                let across = r * r / 4.0 + h * h / 3.0;
                Some((2.0 * PI * r * r * h, Vector3::new(across, across, 0.5 * r * r)))
            }
            "capsule" => Some(capsule(at(0)?, at(1)?)),
            _ => None,
        }
    }

    /// What it looks like, if it is drawn.
    pub fn visual(&self, view: &View<'_>, meshes: &Meshes) -> Result<Option<Visual>, RobotError> {
        if view.number("group")?.unwrap_or(0.0) >= FIRST_HIDDEN_GROUP {
            return Ok(None);
        }
        let at = |i: usize| self.size.get(i).copied();
        let shape = match self.kind.as_str() {
            "sphere" => at(0).map(|radius_m| Shape::Sphere { radius_m }),
            "box" => match (at(0), at(1), at(2)) {
                (Some(x), Some(y), Some(z)) => {
                    Some(Shape::Box { size_m: 2.0 * Vector3::new(x, y, z) })
                }
                _ => None,
            },
            "cylinder" => at(0).zip(at(1)).map(|(radius_m, half)| {
                let length_m = 2.0 * half;
                Shape::Cylinder { radius_m, length_m }
            }),
            "capsule" => at(0).zip(at(1)).map(|(radius_m, half)| {
                let length_m = 2.0 * half;
                Shape::Capsule { radius_m, length_m }
            }),
            "mesh" => view
                .text("mesh")
                .and_then(|name| meshes.get(name))
                .map(|(file, scale)| Shape::Mesh { file: file.clone(), scale: *scale }),
            _ => None,
        };
        #[expect(clippy::cast_possible_truncation, reason = "colours are shown, not computed with")]
        let color = view.exactly::<4>("rgba")?.map(|rgba| rgba.map(|c| c as f32));
        let pose = self.body_from_shape;
        Ok(shape.map(|shape| Visual { link_from_shape: pose, shape, color_rgba: color }))
    }
}

/// A cylinder of radius `r` and half length `h` with half spheres at its ends.
///
/// ```text
/// share of the spheres  s = (4/3 r) / (4/3 r + 2 h)
/// along    s 2/5 r² + (1 - s) r²/2
/// across   s (2/5 r² + h² + 3/4 r h) + (1 - s) (r²/4 + h²/3)
/// ```
fn capsule(r: f64, h: f64) -> (f64, Vector3<f64>) {
    let (spheres, tube) = (4.0 / 3.0 * PI * r.powi(3), 2.0 * PI * r * r * h);
    let share = if spheres + tube > 0.0 { spheres / (spheres + tube) } else { 0.0 };
    let along = share * 0.4 * r * r + (1.0 - share) * 0.5 * r * r;
    let of_spheres = 0.4 * r * r + h * h + 0.75 * r * h;
    let across = share * of_spheres + (1.0 - share) * (r * r / 4.0 + h * h / 3.0);
    (spheres + tube, Vector3::new(across, across, along))
}

/// The meshes of `<asset>`.
pub fn meshes(
    root: &Element,
    view: &dyn Fn(&Element) -> Result<Vector3<f64>, RobotError>,
    folder: &str,
) -> Result<Meshes, RobotError> {
    let mut meshes = Meshes::new();
    for mesh in root.all("asset").flat_map(|asset| asset.all("mesh")) {
        let Some(file) = mesh.get("file") else { continue };
        let path = PathBuf::from(folder).join(file);
        let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let name = mesh.get("name").map(str::to_owned).or(stem).unwrap_or_default();
        meshes.insert(name, (path, view(mesh)?));
    }
    Ok(meshes)
}
