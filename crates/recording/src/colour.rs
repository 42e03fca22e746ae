use colours::Rgb;
use rerun::{Color, FillMode};

use crate::scene::SceneRole;

/// Links that stand still.
pub(crate) const BASE: Rgb = Rgb([0x6b, 0x72, 0x80]);
/// Opacity of the meshes of an arm that is not the actual one.
const GHOST: u8 = 40;

/// The colour of a role, on the dark ground of the viewer.
pub(crate) fn rgb(role: SceneRole) -> Rgb {
    let role = match role {
        SceneRole::Desired => colours::Role::Desired,
        SceneRole::Actual => colours::Role::Measured,
        SceneRole::Nominal => colours::Role::Nominal,
        SceneRole::Predicted => colours::Role::Extended,
        SceneRole::Error => colours::Role::Error,
        SceneRole::Model(index) => return series(index),
    };
    role.colour().on_dark
}

/// Colour of one of several of the same kind.
pub(crate) fn series(index: usize) -> Rgb {
    colours::model(index).on_dark
}

/// A colour that hides what is behind it.
pub(crate) fn solid(Rgb([r, g, b]): Rgb) -> Color {
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
    pub fn on_arm(rgb: Rgb, role: SceneRole) -> Self {
        match role {
            SceneRole::Actual => Self::solid(rgb),
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
