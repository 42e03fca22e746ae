use nalgebra::{Isometry3, Vector3};
use urdf_rs::JointType;

use crate::error::RobotError;
use crate::one_line::one_line;
use crate::structure::actuator::Actuator;
use crate::structure::inertia::Inertia;
use crate::structure::link::Link;
use crate::structure::looks::Looks;
use crate::structure::robot::Robot;
use crate::urdf::outline::{Element, Outline};
use crate::urdf::tree::Tree;
use crate::urdf::visual::Visuals;
use crate::urdf::{convert, followers, outline};
use crate::warning::RobotWarning;
use crate::whole_robot::WholeRobot;

/// Free fall in a base frame whose z axis points up (m/s²).
const UPRIGHT_GRAVITY: Vector3<f64> = Vector3::new(0.0, 0.0, -9.81);

/// Reads the text of a URDF.
pub(crate) fn parse(text: &str) -> Result<WholeRobot, RobotError> {
    let mut outline = outline::outline(text)?;
    let mut warnings = std::mem::take(&mut outline.warnings);
    let (mut links, mut inertias, mut without_mass) = (vec![], vec![], vec![]);
    for element in &outline.links {
        let link = read(&outline, element, |robot| robot.links)?;
        let inertia = if element.has_inertial() { Some(convert::inertia(&link)?) } else { None };
        if inertia.as_ref().is_some_and(|i| i.mass <= 0.0) {
            without_mass.push(link.name.clone());
        }
        // A frame: neither mass nor inertia.
        let inertia = inertia.filter(|i| i.mass > 0.0 || i.about_com.amax() > 0.0);
        inertias.push(inertia);
        links.push(link);
    }
    let mut joints = vec![];
    for element in &outline.joints {
        joints.push(read(&outline, element, |robot| robot.joints)?);
    }
    let tree = Tree::new(&links, &joints)?;
    let mimics = followers::mimics(&joints)?;
    let walk = Walk { links: &links, joints: &joints, inertias: &inertias, tree: &tree };
    let (moving, parts) = walk.moving_links()?;
    warnings.extend(free_base_warnings(&joints));
    let robot = Robot::new(name(&outline)?, UPRIGHT_GRAVITY, moving)?;
    let mut visuals = Visuals::read(text);
    let looks = looks(&mut visuals, &parts, robot.joint_count());
    warnings.append(&mut visuals.warnings);
    let base = || parts.iter().filter(|part| part.body.is_none());
    let has_mass = |part: &Part| inertias[part.index].as_ref().is_some_and(|i| i.mass > 0.0);
    Ok(WholeRobot {
        robot,
        looks,
        base_link: links[tree.root].name.clone(),
        fixed_to_base: base().skip(1).map(|part| part.link.clone()).collect(),
        base_has_mass: base().any(has_mass),
        without_mass,
        mimics,
        gains: vec![],
        expanded: None,
        warnings,
    })
}

/// The joints of a base that moves freely; the walk found them where they can be held.
fn free_base_warnings(joints: &[urdf_rs::Joint]) -> impl Iterator<Item = RobotWarning> {
    joints.iter().filter_map(|joint| {
        let kind = convert::of_free_base(joint)?;
        Some(RobotWarning::BaseHeld { joint: joint.name.clone(), kind })
    })
}

/// One link or joint through `urdf-rs`, alone, so that an error has a name and a line.
fn read<T>(
    outline: &Outline,
    element: &Element,
    list: impl Fn(urdf_rs::Robot) -> Vec<T>,
) -> Result<T, RobotError> {
    let bad = |reason: &str| RobotError::BadElement {
        element: element.label.clone(),
        line: element.line,
        reason: one_line(reason.trim_start_matches("custom: ")),
    };
    let text = format!("{}{}</robot>", outline.robot_tag, element.xml);
    let robot = urdf_rs::read_from_string(&text).map_err(|e| bad(&e.to_string()))?;
    list(robot).pop().ok_or_else(|| bad("it cannot be read"))
}

/// The robot's name, empty when the URDF gives none.
fn name(outline: &Outline) -> Result<String, RobotError> {
    let text = format!("{}</robot>", outline.robot_tag);
    let robot = urdf_rs::read_from_string(&text).map_err(|e| RobotError::BadElement {
        element: "robot".to_owned(),
        line: 1,
        reason: one_line(&e.to_string()),
    })?;
    Ok(robot.name)
}

/// Everything the walk from the base to the tips needs.
struct Walk<'a> {
    links: &'a [urdf_rs::Link],
    joints: &'a [urdf_rs::Joint],
    inertias: &'a [Option<Inertia>],
    tree: &'a Tree,
}

/// A link of the URDF where the walk found it.
struct Part {
    link: String,
    /// Its index in the file.
    index: usize,
    /// The moving link it belongs to, `None` for the base.
    body: Option<usize>,
    /// Its pose in that moving link or in the base.
    body_from_link: Isometry3<f64>,
}

/// The shapes of all parts, each in the frame of its body.
fn looks(visuals: &mut Visuals, parts: &[Part], moving: usize) -> Looks {
    let mut looks = Looks { base: vec![], links: vec![vec![]; moving] };
    for part in parts {
        let mut own = visuals.take(&part.link);
        own.iter_mut().for_each(|v| v.link_from_shape = part.body_from_link * v.link_from_shape);
        part.body.map_or(&mut looks.base, |b| &mut looks.links[b]).append(&mut own);
    }
    looks
}

/// A link of the URDF about to be visited.
struct Visit {
    link: usize,
    /// The joint that carries it, `None` for the root.
    joint: Option<usize>,
    /// The moving link its parent belongs to, `None` for the base.
    body: Option<usize>,
    /// Pose of its parent in that moving link or in the base.
    body_from_parent: Isometry3<f64>,
}

impl Walk<'_> {
    /// The moving links, depth first in the order of the file, and what each is made of.
    fn moving_links(&self) -> Result<(Vec<Link>, Vec<Part>), RobotError> {
        let (mut moving, mut parts) = (Vec::<Link>::new(), vec![]);
        let base = Isometry3::identity();
        let mut stack =
            vec![Visit { link: self.tree.root, joint: None, body: None, body_from_parent: base }];
        while let Some(visit) = stack.pop() {
            let name = self.links[visit.link].name.clone();
            let (body, body_from_link) = match visit.joint.map(|j| &self.joints[j]) {
                None => (None, Isometry3::identity()),
                Some(fixed) if is_fixed(fixed, visit.body) => {
                    visit.body.iter().for_each(|&b| moving[b].merged.push(name.clone()));
                    (visit.body, visit.body_from_parent * convert::origin(fixed)?)
                }
                Some(joint) => {
                    moving.push(self.moving_link(joint, name.clone(), &visit)?);
                    (Some(moving.len() - 1), Isometry3::identity())
                }
            };
            if let (Some(b), Some(own)) = (body, &self.inertias[visit.link]) {
                moving[b].inertia.add(&own.in_frame(&body_from_link));
            }
            parts.push(Part { link: name, index: visit.link, body, body_from_link });
            stack.extend(self.tree.joints_of[visit.link].iter().rev().map(|&j| Visit {
                link: self.tree.child[j],
                joint: Some(j),
                body,
                body_from_parent: body_from_link,
            }));
        }
        Ok((moving, parts))
    }

    fn moving_link(
        &self,
        joint: &urdf_rs::Joint,
        name: String,
        visit: &Visit,
    ) -> Result<Link, RobotError> {
        let dynamics = joint.dynamics.clone().unwrap_or_default();
        Ok(Link {
            name,
            parent: visit.body,
            joint: convert::joint(joint, &visit.body_from_parent)?,
            inertia: Inertia::zero(),
            actuator: Actuator {
                viscous: dynamics.damping,
                coulomb_forward: dynamics.friction,
                coulomb_backward: dynamics.friction,
                ..Actuator::default()
            },
            merged: vec![],
        })
    }
}

/// Whether a joint does not move: it is fixed, or carries the base of a robot that is free.
fn is_fixed(joint: &urdf_rs::Joint, body: Option<usize>) -> bool {
    let free_base = body.is_none() && convert::of_free_base(joint).is_some();
    joint.joint_type == JointType::Fixed || free_base
}
