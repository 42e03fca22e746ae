use robot::Reading;

use crate::mechanics::engine::Push;
use crate::mechanics::plant::Plant;

/// State of the arm at which an effect computes its torque.
#[derive(Debug, Clone, Copy)]
pub struct Moment<'a> {
    /// Time since the start of the log (s), below zero while the arm is held before it.
    pub time_s: f64,
    /// Length of the engine's step (s).
    pub step_s: f64,
    /// Position of the motors, referred to the joint (rad or m).
    pub motor_q: &'a [f64],
    /// Velocity of the motors, referred to the joint (rad/s or m/s).
    pub motor_qd: &'a [f64],
    /// Position of the links (rad or m); the motor's where the transmission is rigid.
    pub q: &'a [f64],
    /// Velocity of the links (rad/s or m/s).
    pub qd: &'a [f64],
    /// Torque that the transmission carried to the link in the last step (N m or N). Zero
    /// unless some effect [asks for it](Inject::needs_load).
    pub load: &'a [f64],
}

/// Torques, friction levels and forces during one step of the engine.
///
/// Every vector has one entry per joint. An effect finds the values of the arm and of the effects
/// before it here, and must add to them or scale them.
#[derive(Debug, Clone, PartialEq)]
pub struct Efforts {
    /// Torque on the motor, positive in the positive direction (N m or N).
    pub motor: Vec<f64>,
    /// Torque on the link (N m or N).
    pub link: Vec<f64>,
    /// Level of dry friction at the motor against positive motion (N m or N): the engine opposes
    /// motion by as much, and holds a resting joint with up to as much.
    pub dry_forward: Vec<f64>,
    /// Level of dry friction at the motor against negative motion (N m or N).
    pub dry_backward: Vec<f64>,
    /// Viscous friction at the motor (N m s/rad or N s/m).
    pub viscous: Vec<f64>,
    /// Friction torque on the motor that an effect computes itself, for example from the deflection of
    /// bristles; positive in the positive direction (N m or N).
    pub bristles: Vec<f64>,
    /// Forces on links.
    pub(crate) pushes: Vec<Push>,
}

impl Efforts {
    /// No effort on `joint_count` joints.
    pub fn none(joint_count: usize) -> Self {
        let zeros = vec![0.0; joint_count];
        Self {
            motor: zeros.clone(),
            link: zeros.clone(),
            dry_forward: zeros.clone(),
            dry_backward: zeros.clone(),
            viscous: zeros.clone(),
            bristles: zeros,
            pushes: Vec::new(),
        }
    }

    /// Adds dry friction of one level (N m or N) in both directions.
    pub fn add_dry(&mut self, joint: usize, level: f64) {
        self.dry_forward[joint] += level;
        self.dry_backward[joint] += level;
    }

    /// Scales all friction of a joint so far.
    pub fn scale_friction(&mut self, joint: usize, factor: f64) {
        let Self { dry_forward, dry_backward, viscous, bristles, .. } = self;
        for friction in [dry_forward, dry_backward, viscous, bristles] {
            friction[joint] *= factor;
        }
    }

    /// The forces so far: the link, the force (N, in the frame of the base) and where it acts (m, in the frame of
    /// the link).
    pub fn forces(
        &self,
    ) -> impl Iterator<Item = (usize, nalgebra::Vector3<f64>, nalgebra::Vector3<f64>)> + '_ {
        self.pushes.iter().map(|push| (push.body, push.force_in_base, push.point_in_body))
    }

    /// Adds a force (N, in the frame of the base) on a link at a point of it (m, in its frame).
    pub fn push(
        &mut self,
        link: usize,
        force_in_base: nalgebra::Vector3<f64>,
        point_in_link: nalgebra::Vector3<f64>,
    ) {
        self.pushes.push(Push { body: link, force_in_base, point_in_body: point_in_link });
    }
}

/// An effect put into the simulated arm. Every hook does nothing by default.
///
/// The implementing type holds any state between steps: bristles, temperature, a queue of commands.
pub trait Inject: Send {
    /// Changes the model before the engine is built from it.
    fn on_build(&mut self, _plant: &mut Plant) {}

    /// Initialises the effect for a run that starts at rest at these positions.
    fn on_start(&mut self, _q: &[f64]) {}

    /// Changes torques (N m or N) on their way from controller to motor, once a step.
    ///
    /// `tau` is the commanded torque, averaged over the step: a change of the held command in the
    /// middle of a step counts half.
    fn on_command(&mut self, _moment: &Moment<'_>, _tau: &mut [f64]) {}

    /// Adds forces during one step of the engine.
    fn on_substep(&mut self, _moment: &Moment<'_>, _efforts: &mut Efforts) {}

    /// Changes sensor readings before noise and rounding. The controller sees the change.
    fn on_reading(&mut self, _reading: &mut Reading) {}

    /// Changes a row of the log. The controller does not see the change, and the noise of the effort is
    /// added after it.
    fn on_record(&mut self, _row: &mut Reading) {}

    /// Changes the readings of the encoders at the links in the same row.
    fn on_record_links(&mut self, _time_s: f64, _links: &mut [Option<f64>]) {}

    /// Time by which goals reach the controller late (s).
    fn goal_delay_s(&self) -> f64 {
        0.0
    }

    /// Whether the effect needs [`Moment::load`], which costs a product with the mass matrix.
    fn needs_load(&self) -> bool {
        false
    }

    /// Springs that the effect applies step by step, as joint and stiffness (N m/rad or N/m):
    /// the step must be short against their resonance.
    fn springs(&self) -> Vec<(usize, f64)> {
        Vec::new()
    }
}
