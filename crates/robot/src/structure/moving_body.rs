use crate::structure::inertia::{Inertia, InertiaDefect};
use crate::structure::robot::Robot;

/// Distance up to which two joints are at one place (m).
const SAME_PLACE_M: f64 = 1e-3;

impl Robot {
    /// Every way in which a moving body, a link with everything fixed to it, contradicts physics; empty when it is sound.
    ///
    /// A frame between the axes of a universal or ball joint is sound without any inertia.
    pub fn inertia_defects(&self, index: usize) -> Vec<InertiaDefect> {
        match self.links().get(index) {
            Some(link) if !self.is_frame_between_axes(index) => link.inertia.defects(),
            _ => vec![],
        }
    }

    /// Whether a link has no inertia at all and joints of others at its origin, each of which carries a body with mass.
    pub(crate) fn is_frame_between_axes(&self, index: usize) -> bool {
        let links = self.links();
        let is_empty = |at: usize| links.get(at).is_some_and(|l| l.inertia == Inertia::zero());
        let mut children =
            (0..links.len()).filter(|&at| links[at].parent == Some(index)).peekable();
        let carries = |at: usize| {
            let distance_m = links[at].joint.parent_from_joint.translation.vector.norm();
            distance_m <= SAME_PLACE_M && (!is_empty(at) || self.is_frame_between_axes(at))
        };
        is_empty(index) && children.peek().is_some() && children.all(carries)
    }
}
