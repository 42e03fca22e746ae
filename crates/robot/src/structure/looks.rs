use std::path::PathBuf;

use nalgebra::{Isometry3, Vector3};

/// Shapes for display. No computation uses them.
///
/// ```text
/// world_from_shape = world_from_link link_from_shape
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Looks {
    /// Shapes of the base link and of the links fixed to it, in the base frame.
    pub base: Vec<Visual>,
    /// Per moving link, the shapes of it and of the links merged into it.
    pub links: Vec<Vec<Visual>>,
}

/// One shape on a link.
#[derive(Debug, Clone, PartialEq)]
pub struct Visual {
    /// Pose of the shape in the frame of the moving link, or of the base.
    pub link_from_shape: Isometry3<f64>,
    /// The shape.
    pub shape: Shape,
    /// Red, green, blue and opacity from 0 to 1, where the URDF gives a colour.
    pub color_rgba: Option<[f32; 4]>,
}

/// A shape about its own origin.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Shape {
    /// A box with its centre in the origin.
    Box {
        /// Edges along x, y and z (m).
        size_m: Vector3<f64>,
    },
    /// A cylinder along z with its centre in the origin.
    Cylinder {
        /// Radius (m).
        radius_m: f64,
        /// Length (m).
        length_m: f64,
    },
    /// A sphere about the origin.
    Sphere {
        /// Radius (m).
        radius_m: f64,
    },
    /// A cylinder along z with a half sphere on either end, its centre in the origin.
    Capsule {
        /// Radius (m).
        radius_m: f64,
        /// Length between the centres of the half spheres (m).
        length_m: f64,
    },
    /// A mesh file. It existed and was small enough when the URDF was read.
    Mesh {
        /// The file.
        file: PathBuf,
        /// Factors along x, y and z that convert its numbers to metres; negative ones mirror it.
        scale: Vector3<f64>,
    },
}
