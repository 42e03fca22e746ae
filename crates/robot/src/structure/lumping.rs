use std::collections::BTreeMap;

use nalgebra::Isometry3;

use crate::error::RobotError;
use crate::structure::actuator::{Actuator, Coupling};
use crate::structure::control::{ControlSettings, PdGain};
use crate::structure::link::Link;
use crate::structure::looks::Looks;
use crate::structure::robot::Robot;

/// Where the links of a robot end up when some of its joints are locked.
///
/// A link that a locked joint carries becomes part of the body its parent belongs to:
///
/// ```text
/// body_from_link = body_from_parent parent_from_joint motion(q_locked)
/// ```
pub(crate) struct Lumping {
    /// One entry per link of the whole robot.
    places: Vec<Place>,
}

/// Where a link of the whole robot ends up.
struct Place {
    /// Index of its body in the smaller robot, `None` for the base.
    body: Option<usize>,
    body_from_link: Isometry3<f64>,
    /// Whether its joint still moves, so that the body is its own.
    moves: bool,
}

impl Lumping {
    /// Locks the joints that `locked` names at the positions it gives (rad or m).
    pub fn new(whole: &Robot, locked: &BTreeMap<String, f64>) -> Self {
        let (mut places, mut moving) = (Vec::<Place>::new(), 0);
        for link in whole.links() {
            let (parent, body_from_parent) = match link.parent.and_then(|p| places.get(p)) {
                Some(place) => (place.body, place.body_from_link),
                None => (None, Isometry3::identity()),
            };
            places.push(match locked.get(&link.joint.name) {
                Some(&q) => Place {
                    body: parent,
                    body_from_link: body_from_parent * link.joint.parent_from_child(q),
                    moves: false,
                },
                None => {
                    Place { body: Some(moving), body_from_link: Isometry3::identity(), moves: true }
                }
            });
            moving += usize::from(places.last().is_some_and(|p| p.moves));
        }
        Self { places }
    }

    /// The smaller robot.
    pub fn robot(&self, whole: &Robot) -> Result<Robot, RobotError> {
        let mut links = Vec::<Link>::new();
        for (link, place) in whole.links().iter().zip(&self.places) {
            if place.moves {
                links.push(self.moving(link));
            } else if let Some(body) = place.body.and_then(|b| links.get_mut(b)) {
                body.inertia.add(&link.inertia.in_frame(&place.body_from_link));
                body.merged.push(link.name.clone());
                body.merged.extend_from_slice(&link.merged);
            }
        }
        self.couple(whole, &mut links);
        Robot::new(whole.name(), whole.gravity_in_base(), links)
    }

    /// A link whose joint still moves, on the body that its parent belongs to now.
    fn moving(&self, link: &Link) -> Link {
        let mut own = link.clone();
        if let Some(parent) = link.parent.and_then(|p| self.places.get(p)) {
            own.parent = parent.body;
            if !parent.moves {
                own.joint.parent_from_joint = parent.body_from_link * link.joint.parent_from_joint;
            }
        }
        own
    }

    /// Pairs of motors by the new indices. With one joint of a pair at rest, both motors turn with
    /// the other, and what they add is friction of that joint alone:
    ///
    /// ```text
    /// joint that has the coupling   viscous += v_sum + v_difference,  coulomb += l_sum + l_difference
    /// the other joint               ratio² times that,                |ratio| times that
    /// ```
    fn couple(&self, whole: &Robot, links: &mut [Link]) {
        for (link, place) in whole.links().iter().zip(&self.places) {
            let Some(coupling) = link.actuator.coupling else { continue };
            let other = self.places.get(coupling.other).filter(|p| p.moves).and_then(|p| p.body);
            match (place.body.filter(|_| place.moves), other) {
                (Some(own), Some(other)) => {
                    links[own].actuator.coupling = Some(Coupling { other, ..coupling });
                }
                (Some(own), None) => {
                    links[own].actuator.coupling = None;
                    alone(&mut links[own].actuator, &coupling, 1.0);
                }
                (None, Some(other)) => {
                    alone(&mut links[other].actuator, &coupling, coupling.ratio);
                }
                (None, None) => {}
            }
        }
    }

    /// The same shapes on the smaller robot.
    pub fn looks(&self, whole: Looks) -> Looks {
        let moving = self.places.iter().filter(|p| p.moves).count();
        let mut looks = Looks { base: whole.base, links: vec![vec![]; moving] };
        for (mut shapes, place) in whole.links.into_iter().zip(&self.places) {
            if !place.moves {
                let turn = |from: &Isometry3<f64>| place.body_from_link * from;
                shapes.iter_mut().for_each(|v| v.link_from_shape = turn(&v.link_from_shape));
            }
            place.body.map_or(&mut looks.base, |b| &mut looks.links[b]).append(&mut shapes);
        }
        looks
    }

    /// The settings of the joints that still move. A pair of motors that loses a joint is no
    /// pair: both motors are the other's.
    pub fn control(&self, whole: &ControlSettings) -> ControlSettings {
        let new = |joint: &usize| self.places.get(*joint).filter(|p| p.moves).and_then(|p| p.body);
        let pair = |pair: &[usize; 2]| Some([new(&pair[0])?, new(&pair[1])?]);
        let set = |(name, gains): (&String, &Vec<PdGain>)| (name.clone(), self.moving_of(gains));
        ControlSettings {
            rate_hz: whole.rate_hz,
            gains: self.moving_of(&whole.gains),
            gain_sets: whole.gain_sets.iter().map(set).collect(),
            differentials: whole.differentials.iter().filter_map(pair).collect(),
        }
    }

    fn moving_of<T: Clone>(&self, list: &[T]) -> Vec<T> {
        let pairs = list.iter().zip(&self.places);
        pairs.filter(|(_, place)| place.moves).map(|(entry, _)| entry.clone()).collect()
    }

    /// Names of the links that now are fixed to the base.
    pub fn fixed_to_base(&self, whole: &Robot) -> Vec<String> {
        let pairs = whole.links().iter().zip(&self.places);
        let fixed = pairs.filter(|(_, place)| place.body.is_none()).map(|(link, _)| link);
        fixed.flat_map(|l| std::iter::once(&l.name).chain(&l.merged).cloned()).collect()
    }
}

/// Adds the friction of a pair of motors that turns `ratio` times as fast as the joint.
fn alone(actuator: &mut Actuator, coupling: &Coupling, ratio: f64) {
    actuator.viscous += ratio * ratio * coupling.viscous.iter().sum::<f64>();
    let level = ratio.abs() * coupling.level.iter().sum::<f64>();
    actuator.coulomb_forward += level;
    actuator.coulomb_backward += level;
}
