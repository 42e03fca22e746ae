use rerun::{Color, FillMode};

use crate::Role;

/// Red, green and blue.
pub(crate) type Rgb = [u8; 3];

/// Colours of models and of joints side by side; none is that of another role.
const SERIES: [Rgb; 8] = [
    [0xc3, 0x8f, 0xff],
    [0xff, 0xd1, 0x4f],
    [0x4f, 0xd8, 0xe8],
    [0xff, 0x7e, 0xb6],
    [0xa8, 0xd5, 0x4a],
    [0x8f, 0xa8, 0xc8],
    [0xd9, 0xa0, 0x6b],
    [0xe8, 0xe8, 0xe8],
];
/// Links that stand still.
pub(crate) const BASE: Rgb = [0x6b, 0x72, 0x80];
/// Opacity of the meshes of an arm that is not the actual one.
const GHOST: u8 = 40;

pub(crate) fn rgb(role: Role) -> Rgb {
    match role {
        Role::Desired => [0x4c, 0x9a, 0xff],
        Role::Actual => [0xff, 0x8b, 0x3d],
        Role::Predicted => [0x57, 0xd9, 0xa3],
        Role::Error => [0xff, 0x56, 0x30],
        Role::Model(index) => series(index),
    }
}

/// Colour of one of several of the same kind.
pub(crate) fn series(index: usize) -> Rgb {
    SERIES[index % SERIES.len()]
}

/// A colour that hides what is behind it.
pub(crate) fn solid([r, g, b]: Rgb) -> Color {
    Color::from_rgb(r, g, b)
}

/// How a shape of an arm is drawn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Paint {
    pub color: Color,
    pub fill: FillMode,
}

impl Paint {
    /// Hides what is behind it.
    pub fn solid(rgb: Rgb) -> Self {
        Self { color: solid(rgb), fill: FillMode::Solid }
    }

    /// On an arm: solid on the actual one, edges alone on every other, so that neither tints
    /// the other where they meet.
    pub fn on_arm(rgb: Rgb, role: Role) -> Self {
        match role {
            Role::Actual => Self::solid(rgb),
            _ => Self { color: solid(rgb), fill: FillMode::MajorWireframe },
        }
    }

    /// Of a mesh, which has no edges to draw: nearly transparent in their place.
    pub fn of_mesh(self) -> Color {
        let [r, g, b, _] = self.color.to_array();
        match self.fill {
            FillMode::Solid => self.color,
            _ => Color::from_unmultiplied_rgba(r, g, b, GHOST),
        }
    }
}
