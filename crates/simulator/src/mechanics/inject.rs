use robot::Reading;

use crate::mechanics::engine::Push;
use crate::mechanics::plant::Plant;

/// Where the arm is when an effect is asked for its torque.
#[derive(Debug, Clone, Copy)]
pub struct Moment<'a> {
    /// Time since the start of the log (s), below zero while the arm is held before it.
    pub time_s: f64,
    /// Length of the engine's step (s).
    pub step_s: f64,
    /// Position of the motors, seen at the joint (rad or m).
    pub motor_q: &'a [f64],
    /// Velocity of the motors, seen at the joint (rad/s or m/s).
    pub motor_qd: &'a [f64],
    /// Position of the links (rad or m); the motor's where the transmission is rigid.
    pub q: &'a [f64],
    /// Velocity of the links (rad/s or m/s).
    pub qd: &'a [f64],
    /// Torque that the transmission carried to the link in the last step (N m or N). Zero
    /// unless some effect [asks for it](Inject::needs_load).
    pub load: &'a [f64],
}

/// What effects add during one step of the engine.
///
/// Every vector has one entry a joint. What stands here when an effect is asked comes from the
/// arm itself and from the effects before it, so an effect adds and scales, it does not set.
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
    /// Friction torque on the motor that an effect works out itself, as from the deflection of
    /// bristles, positive in the positive direction (N m or N).
    pub bristles: Vec<f64>,
    /// Forces on links.
    pub(crate) pushes: Vec<Push>,
}

impl Efforts {
    /// Nothing, for `joint_count` joints.
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

    /// Scales all friction of a joint that stands here.
    pub fn scale_friction(&mut self, joint: usize, factor: f64) {
        let Self { dry_forward, dry_backward, viscous, bristles, .. } = self;
        for friction in [dry_forward, dry_backward, viscous, bristles] {
            friction[joint] *= factor;
        }
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

/// An effect put into the simulated arm. Every hook does nothing unless an effect says otherwise.
///
/// State that an effect carries from step to step (bristles, temperature, a queue of commands)
/// lives in it.
pub trait Inject: Send {
    /// Changes what the arm is made of, before the engine is built.
    fn on_build(&mut self, _plant: &mut Plant) {}

    /// Takes note of the state that a run starts from, at rest.
    fn on_start(&mut self, _q: &[f64]) {}

    /// Changes torques (N m or N) on their way from controller to motor, once a step.
    ///
    /// `tau` is the mean over the step of what was asked for, so that the jump of a held command
    /// counts half in the step whose middle it falls on.
    fn on_command(&mut self, _moment: &Moment<'_>, _tau: &mut [f64]) {}

    /// Adds forces during one step of the engine.
    fn on_substep(&mut self, _moment: &Moment<'_>, _efforts: &mut Efforts) {}

    /// Changes what encoders and torque sensors see, before noise and counts; the controller
    /// sees it too.
    fn on_reading(&mut self, _reading: &mut Reading) {}

    /// Changes a row on its way into the log, behind the controller's back. The noise of the
    /// effort comes after.
    fn on_record(&mut self, _row: &mut Reading) {}

    /// Changes what the encoders at the links say, on its way into the same row.
    fn on_record_links(&mut self, _time_s: f64, _links: &mut [Option<f64>]) {}

    /// Whether [`Moment::load`] is to be filled, which costs a product with the mass matrix.
    fn needs_load(&self) -> bool {
        false
    }

    /// Springs that the effect applies step by step, as joint and stiffness (N m/rad or N/m):
    /// the step must be short against their resonance.
    fn springs(&self) -> Vec<(usize, f64)> {
        Vec::new()
    }
}
