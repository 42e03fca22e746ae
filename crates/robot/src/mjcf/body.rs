//! The walk over the bodies.

use nalgebra::{Isometry3, Matrix3};

use crate::error::RobotError;
use crate::mjcf::classes::{Classes, MAIN};
use crate::mjcf::compiler::{Compiler, InertiaSource};
use crate::mjcf::element::Element;
use crate::mjcf::geom::{Geom, Meshes};
use crate::mjcf::joint::{MjcfMotion, motion, read_joint};
use crate::mjcf::unread::Unread;
use crate::mjcf::view::View;
use crate::structure::inertia::Inertia;
use crate::structure::link::Link;
use crate::structure::looks::Looks;
use crate::warning::RobotWarning;

/// The frame that what is inside of an element is described in.
#[derive(Clone)]
struct Place<'a> {
    /// The moving link, `None` for the base.
    link: Option<usize>,
    link_from_frame: Isometry3<f64>,
    /// Class of the elements.
    class: &'a str,
}

/// The bodies as links.
pub struct Walk<'a> {
    pub classes: &'a Classes,
    pub compiler: &'a Compiler,
    pub meshes: &'a Meshes,
    pub links: Vec<Link>,
    pub looks: Looks,
    pub fixed_to_base: Vec<String>,
    pub base_has_mass: bool,
    pub warnings: Vec<RobotWarning>,
    pub unread: Unread,
    bodies: usize,
}

impl<'a> Walk<'a> {
    /// A walk that has seen nothing.
    pub fn new(classes: &'a Classes, compiler: &'a Compiler, meshes: &'a Meshes) -> Self {
        Self {
            classes,
            compiler,
            meshes,
            links: vec![],
            looks: Looks::default(),
            fixed_to_base: vec![],
            base_has_mass: false,
            warnings: vec![],
            unread: Unread::default(),
            bodies: 0,
        }
    }

    /// Takes everything inside of `<worldbody>`.
    pub fn world(&mut self, world: &'a Element) -> Result<(), RobotError> {
        let place = Place { link: None, link_from_frame: Isometry3::identity(), class: MAIN };
        self.shapes(world, &place)?;
        self.children(world, &place)
    }

    fn view(&self, element: &'a Element, class: &'a str) -> View<'a> {
        View { element, around: class, classes: self.classes, compiler: self.compiler }
    }

    /// The bodies and frames inside of an element.
    fn children(&mut self, element: &'a Element, place: &Place<'a>) -> Result<(), RobotError> {
        self.unread.of_body(element);
        for child in &element.children {
            match child.name.as_str() {
                "body" => self.body(child, place)?,
                "frame" => {
                    let pose = self.view(child, place.class).pose()?;
                    let inner = Place {
                        link_from_frame: place.link_from_frame * pose,
                        class: self.class(child, place.class)?,
                        ..place.clone()
                    };
                    if child.all("joint").next().is_some() {
                        self.unread.add("<joint> of <frame>");
                    }
                    self.shapes(child, &inner)?;
                    self.children(child, &inner)?;
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// The class of what is inside of an element.
    fn class(&self, element: &'a Element, around: &'a str) -> Result<&'a str, RobotError> {
        let Some(class) = element.get("childclass") else { return Ok(around) };
        if self.classes.has(class) {
            return Ok(class);
        }
        Err(element.bad(format!("there is no class {class} in <default>")))
    }

    fn body(&mut self, body: &'a Element, around: &Place<'a>) -> Result<(), RobotError> {
        self.bodies += 1;
        let name = body.get("name").map_or_else(|| format!("body_{}", self.bodies), str::to_owned);
        let pose = self.view(body, around.class).pose()?;
        let class = self.class(body, around.class)?;
        let mut place =
            Place { link: around.link, link_from_frame: around.link_from_frame * pose, class };
        let is_joint = |child: &&Element| matches!(child.name.as_str(), "joint" | "freejoint");
        let joints: Vec<&Element> = body.children.iter().filter(is_joint).collect();
        let mut moved = false;
        for (index, joint) in joints.iter().enumerate() {
            let is_last = index + 1 == joints.len();
            let own = if is_last { name.clone() } else { format!("{name}_{}", index + 1) };
            moved |= self.joint(joint, &own, &mut place)?;
        }
        let inertia = self.inertia(body, class)?;
        match place.link {
            Some(link) => {
                if !moved {
                    self.links[link].merged.push(name);
                }
                if let Some(inertia) = inertia {
                    self.links[link].inertia.add(&inertia.in_frame(&place.link_from_frame));
                }
            }
            None => {
                self.base_has_mass |= inertia.is_some_and(|i| i.mass > 0.0);
                self.fixed_to_base.push(name);
            }
        }
        self.shapes(body, &place)?;
        self.children(body, &place)
    }

    /// A link for a joint; `false` for that of a free base, which is held.
    fn joint(
        &mut self,
        element: &'a Element,
        link: &str,
        place: &mut Place<'a>,
    ) -> Result<bool, RobotError> {
        let view = self.view(element, place.class);
        let name = element.get("name").map_or_else(|| format!("{link}_joint"), str::to_owned);
        let kind = motion(&view, &name)?;
        if kind == MjcfMotion::Free {
            if place.link.is_some() {
                return Err(RobotError::UnsupportedJoint { joint: name, kind: "free" });
            }
            self.warnings.push(RobotWarning::BaseHeld { joint: name, kind: "free" });
            return Ok(false);
        }
        let driven = read_joint(&view, &name, kind, &place.link_from_frame)?;
        self.links.push(Link {
            name: link.to_owned(),
            parent: place.link,
            joint: driven.joint,
            inertia: Inertia::zero(),
            actuator: driven.actuator,
            merged: vec![],
        });
        self.looks.links.push(vec![]);
        place.link = Some(self.links.len() - 1);
        place.link_from_frame = driven.body_from_joint.inverse();
        Ok(true)
    }

    /// The inertia of a body in its own frame.
    fn inertia(
        &mut self,
        body: &'a Element,
        class: &'a str,
    ) -> Result<Option<Inertia>, RobotError> {
        let source = self.compiler.inertia;
        let given = body.all("inertial").next().filter(|_| source != InertiaSource::Shapes);
        if let Some(element) = given {
            return inertial(&self.view(element, class)).map(Some);
        }
        if source == InertiaSource::Inertial {
            return Ok(None);
        }
        let mut sum: Option<Inertia> = None;
        for element in body.all("geom") {
            let view = self.view(element, class);
            match Geom::new(&view)?.inertia() {
                Some(own) if own.mass > 0.0 => {
                    sum.get_or_insert_with(Inertia::zero).add(&own);
                }
                Some(_) => {}
                None => self.unread.add("inertia of a mesh that stands for <inertial>"),
            }
        }
        Ok(sum)
    }

    /// The shapes of an element.
    fn shapes(&mut self, element: &'a Element, place: &Place<'a>) -> Result<(), RobotError> {
        for geom in element.all("geom") {
            let view = self.view(geom, place.class);
            let Some(mut visual) = Geom::new(&view)?.visual(&view, self.meshes)? else { continue };
            visual.link_from_shape = place.link_from_frame * visual.link_from_shape;
            match place.link {
                Some(link) => self.looks.links[link].push(visual),
                None => self.looks.base.push(visual),
            }
        }
        Ok(())
    }
}

/// `<inertial>` in the frame of its body.
fn inertial(view: &View<'_>) -> Result<Inertia, RobotError> {
    let element = view.element;
    let mass = view.number("mass")?.ok_or_else(|| element.bad("it has no mass"))?;
    if mass < 0.0 {
        return Err(element.bad(format!("its mass is {mass} kg, a positive number was expected")));
    }
    let about_com = match (view.exactly::<6>("fullinertia")?, view.exactly::<3>("diaginertia")?) {
        (Some([xx, yy, zz, xy, xz, yz]), _) => Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
        (None, Some([xx, yy, zz])) => Matrix3::from_diagonal(&[xx, yy, zz].into()),
        (None, None) => Matrix3::zeros(),
    };
    let own = Inertia { mass, com_in_link: nalgebra::Vector3::zeros(), about_com };
    Ok(own.in_frame(&view.pose()?))
}
