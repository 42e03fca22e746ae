use crate::structure::control::PdGain;
use crate::structure::looks::Looks;
use crate::structure::part::Mimics;
use crate::structure::robot::Robot;
use crate::warning::RobotWarning;

/// What a URDF or an MJCF says.
pub(crate) struct WholeRobot {
    /// Every joint moves by itself, those of `mimics` as well.
    pub robot: Robot,
    /// Its meshes are named as in the file.
    pub looks: Looks,
    pub base_link: String,
    pub fixed_to_base: Vec<String>,
    /// Whether the base has mass.
    pub base_has_mass: bool,
    /// Links whose mass is said to be zero: frames, unless they move by themselves.
    pub without_mass: Vec<String>,
    pub mimics: Mimics,
    /// Gains of servos, one entry a joint; a URDF has none.
    pub gains: Vec<Option<PdGain>>,
    /// The text with what it includes, where it includes something.
    pub expanded: Option<String>,
    pub warnings: Vec<RobotWarning>,
}
