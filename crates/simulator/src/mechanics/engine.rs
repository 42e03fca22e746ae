use nalgebra::{Isometry3, Unit, Vector3};
use robot::Inertia;

/// One moving body and the degree of freedom that carries it.
#[derive(Debug, Clone)]
pub(crate) struct EngineBody {
    /// Index of the body that carries it, `None` for the base.
    pub parent: Option<usize>,
    /// Whether the degree of freedom turns, otherwise it slides.
    pub turns: bool,
    /// Takes coordinates of the body at position zero to coordinates of its parent.
    pub parent_from_body: Isometry3<f64>,
    /// Axis in the frame of the body.
    pub axis: Unit<Vector3<f64>>,
    /// Mass, centre of mass and inertia in the frame of the body; `None` for a massless body.
    pub inertia: Option<Inertia>,
    /// Inertia of this degree of freedom alone (kg m² or kg).
    pub armature: f64,
    /// Stops (rad or m).
    pub stops: Option<(f64, f64)>,
}

/// A force on a body at a point of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Push {
    /// Index of the body.
    pub body: usize,
    /// Force (N), in the frame of the base.
    pub force_in_base: Vector3<f64>,
    /// Where it acts (m), in the frame of the body.
    pub point_in_body: Vector3<f64>,
}

/// Efforts on every degree of freedom during one step.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Load {
    /// Generalised force (N m or N).
    pub effort: Vec<f64>,
    /// Level of dry friction (N m or N).
    pub dry: Vec<f64>,
    /// Force per unit of velocity against the motion (N m s/rad or N s/m).
    pub damping: Vec<f64>,
    /// Forces on bodies.
    pub pushes: Vec<Push>,
}

impl Load {
    /// No effort on `count` degrees of freedom.
    pub fn none(count: usize) -> Self {
        Self {
            effort: vec![0.0; count],
            dry: vec![0.0; count],
            damping: vec![0.0; count],
            pushes: Vec::new(),
        }
    }

    /// Resets all efforts and keeps the memory.
    pub fn clear(&mut self) {
        for row in [&mut self.effort, &mut self.dry, &mut self.damping] {
            row.fill(0.0);
        }
        self.pushes.clear();
    }
}

/// What moves the bodies: positions, velocities and accelerations of every degree of freedom, a step at a time.
pub(crate) trait Engine: Send {
    /// Positions (rad or m).
    fn q(&self) -> &[f64];

    /// Velocities at the time of the positions (rad/s or m/s).
    fn qd(&self) -> &[f64];

    /// Accelerations over the last step (rad/s² or m/s²).
    fn qdd(&self) -> &[f64];

    /// Length of a step (s).
    fn step_s(&self) -> f64;

    /// Sets positions and velocities and clears earlier efforts.
    fn set_state(&mut self, q: &[f64], qd: &[f64]);

    /// One step under a load.
    fn step(&mut self, load: &Load);

    /// Generalised force of friction and stops over the last step (N m or N).
    fn constraint_effort(&self, effort: &mut [f64]);

    /// Inverse inertia of each degree of freedom with all others free (1/(kg m²) or 1/kg).
    fn inverse_inertia(&mut self) -> Vec<f64>;
}
