/// A format of robot descriptions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// The Unified Robot Description Format of ROS.
    Urdf,
    /// The format of MuJoCo.
    Mjcf,
    /// The Simulation Description Format of Gazebo.
    Sdf,
    /// A text layer of Universal Scene Description with the schemas of PhysX and Newton, for Isaac Sim and Isaac Lab.
    Isaac,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Urdf, Self::Mjcf, Self::Sdf, Self::Isaac];

    /// Its name in small letters.
    pub fn name(self) -> &'static str {
        match self {
            Self::Urdf => "urdf",
            Self::Mjcf => "mjcf",
            Self::Sdf => "sdf",
            Self::Isaac => "isaac",
        }
    }

    /// Extension of a file of this format.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Urdf => "urdf",
            Self::Mjcf => "xml",
            Self::Sdf => "sdf",
            Self::Isaac => "usda",
        }
    }
}
