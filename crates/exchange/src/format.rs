/// A format of descriptions of a robot or of its servos.
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
    /// Position actuators and joint classes for a model of MuJoCo.
    ActuatorMjcf,
    /// Configurations of actuators for Isaac Lab, in Python.
    ActuatorIsaac,
    /// Parameters of servos as BAM (Better Actuator Models) has them, in JSON.
    ActuatorBam,
}

impl Format {
    /// Those that describe a whole robot.
    pub const ALL: [Self; 4] = [Self::Urdf, Self::Mjcf, Self::Sdf, Self::Isaac];

    /// Those that describe the servos of a robot, to be used beside a description of its bodies.
    pub const ACTUATORS: [Self; 3] = [Self::ActuatorMjcf, Self::ActuatorIsaac, Self::ActuatorBam];

    /// Its name in small letters.
    pub fn name(self) -> &'static str {
        match self {
            Self::Urdf => "urdf",
            Self::Mjcf => "mjcf",
            Self::Sdf => "sdf",
            Self::Isaac => "isaac",
            Self::ActuatorMjcf => "actuator_mjcf",
            Self::ActuatorIsaac => "actuator_isaac",
            Self::ActuatorBam => "actuator_bam",
        }
    }

    /// Extension of a file of this format.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Urdf => "urdf",
            Self::Mjcf | Self::ActuatorMjcf => "xml",
            Self::Sdf => "sdf",
            Self::Isaac => "usda",
            Self::ActuatorIsaac => "py",
            Self::ActuatorBam => "json",
        }
    }

    /// Name of a file of this format: `extended.urdf`, `extended_actuator.xml`.
    pub fn file_name(self, stem: &str) -> String {
        let part = if Self::ACTUATORS.contains(&self) { "_actuator" } else { "" };
        format!("{stem}{part}.{}", self.extension())
    }
}
