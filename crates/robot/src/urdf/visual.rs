use std::collections::BTreeMap;

use nalgebra::Vector3;
use quick_xml::Reader;
use quick_xml::events::Event;
use urdf_rs::Geometry;

use crate::one_line::one_line;
use crate::structure::looks::{Shape, Visual};
use crate::urdf::convert;
use crate::urdf::outline::attribute;
use crate::warning::RobotWarning;

/// Largest size and distance that is drawn (m): a number beyond it is a mistake.
const LARGEST_M: f64 = 1e4;

/// The shapes of the links by their names in the URDF.
#[derive(Debug, Default)]
pub(super) struct Visuals {
    of_link: BTreeMap<String, Vec<Visual>>,
    /// Colours of the materials that have one, by name.
    materials: BTreeMap<String, [f32; 4]>,
    pub warnings: Vec<RobotWarning>,
}

impl Visuals {
    /// Reads `<visual>` of every link. What cannot be drawn is left out with a warning.
    ///
    /// The text is well-formed: the outline was read before.
    pub fn read(text: &str) -> Self {
        let mut found = vec![];
        let mut visuals = Self::default();
        for (link, xml) in elements(text) {
            let Some(link) = link else {
                let robot = urdf_rs::read_from_string(&format!("<robot name=\"\">{xml}</robot>"));
                robot.into_iter().flat_map(|r| r.materials).for_each(|m| visuals.learn(&m));
                continue;
            };
            let robot = format!("<robot name=\"\"><link name=\"\">{xml}</link></robot>");
            match urdf_rs::read_from_string(&robot) {
                Err(error) => visuals.warn_of_omission(&link, &one_line(&error.to_string())),
                Ok(robot) => {
                    let own = robot.links.into_iter().flat_map(|l| l.visual);
                    found.extend(own.map(|visual| (link.clone(), visual)));
                }
            }
        }
        // A material is often given once and named by other links, before or after.
        let given = found.iter().filter_map(|(_, v)| v.material.clone());
        given.collect::<Vec<_>>().iter().for_each(|m| visuals.learn(m));
        for (link, visual) in found {
            match visuals.check(&visual) {
                Ok(drawn) => visuals.of_link.entry(link).or_default().push(drawn),
                Err(reason) => visuals.warn_of_omission(&link, &reason),
            }
        }
        visuals
    }

    /// Takes the shapes of a link.
    pub fn take(&mut self, link: &str) -> Vec<Visual> {
        self.of_link.remove(link).unwrap_or_default()
    }

    fn warn_of_omission(&mut self, link: &str, reason: &str) {
        let (link, reason) = (link.to_owned(), reason.to_owned());
        self.warnings.push(RobotWarning::VisualLeftOut { link, reason });
    }

    /// Remembers the first colour of a material's name.
    fn learn(&mut self, material: &urdf_rs::Material) {
        if let Some(color) = color(material) {
            self.materials.entry(material.name.clone()).or_insert(color);
        }
    }

    fn check(&self, visual: &urdf_rs::Visual) -> Result<Visual, String> {
        for value in visual.origin.xyz.0.iter().chain(&visual.origin.rpy.0) {
            if value.is_nan() || value.abs() > LARGEST_M {
                return Err(format!("its origin holds {value}, up to {LARGEST_M} was expected"));
            }
        }
        let material = visual.material.as_ref();
        let named = |m: &urdf_rs::Material| self.materials.get(&m.name).copied();
        Ok(Visual {
            link_from_shape: convert::pose(&visual.origin),
            shape: shape(&visual.geometry)?,
            color_rgba: material.and_then(|m| color(m).or_else(|| named(m))),
        })
    }
}

/// Every `<visual>` with the name of its link, and every `<material>` of the robot itself.
fn elements(text: &str) -> Vec<(Option<String>, String)> {
    let mut reader = Reader::from_str(text);
    let (mut depth, mut link, mut found) = (0_usize, None, vec![]);
    while let Ok(event) = reader.read_event() {
        match event {
            Event::Eof => break,
            Event::End(_) => depth = depth.saturating_sub(1),
            Event::Empty(_) => {}
            Event::Start(tag) => {
                let name = tag.name().as_ref().to_vec();
                if depth == 1 {
                    link = (name == b"link").then(|| attribute(&tag, "name"));
                }
                let wanted = match depth {
                    1 => name == b"material",
                    2 => link.is_some() && name == b"visual",
                    _ => false,
                };
                if !wanted {
                    depth += 1;
                    continue;
                }
                let start = String::from_utf8_lossy(&tag).into_owned();
                let Ok(inside) = reader.read_text(tag.name()) else { break };
                let end = String::from_utf8_lossy(&name);
                found.push((link.clone(), format!("<{start}>{}</{end}>", &*inside)));
            }
            _ => {}
        }
    }
    found
}

fn shape(geometry: &Geometry) -> Result<Shape, String> {
    Ok(match geometry {
        Geometry::Box { size } => Shape::Box {
            size_m: Vector3::new(length(size.0[0])?, length(size.0[1])?, length(size.0[2])?),
        },
        Geometry::Cylinder { radius, length: l } => {
            Shape::Cylinder { radius_m: length(*radius)?, length_m: length(*l)? }
        }
        Geometry::Capsule { radius, length: l } => {
            Shape::Capsule { radius_m: length(*radius)?, length_m: length(*l)? }
        }
        Geometry::Sphere { radius } => Shape::Sphere { radius_m: length(*radius)? },
        Geometry::Mesh { filename, scale } => {
            let scale = scale.map_or(Vector3::repeat(1.0), |s| Vector3::from(s.0));
            for factor in scale.iter() {
                length(factor.abs())?;
            }
            Shape::Mesh { file: filename.into(), scale }
        }
    })
}

/// A size that can be drawn.
fn length(value: f64) -> Result<f64, String> {
    if value > 0.0 && value <= LARGEST_M {
        return Ok(value);
    }
    Err(format!("it has a size of {value}, more than 0 and up to {LARGEST_M} was expected"))
}

/// The colour of a material, when it has one of numbers from 0 to 1.
fn color(material: &urdf_rs::Material) -> Option<[f32; 4]> {
    let rgba = material.color.as_ref()?.rgba.0;
    let bounded = rgba.iter().all(|c| (0.0..=1.0).contains(c));
    bounded.then(|| rgba.map(|c| c as f32))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(inside: &str) -> Visuals {
        Visuals::read(&format!("<robot name=\"r\">{inside}</robot>"))
    }

    #[test]
    fn the_four_simple_shapes_are_read_with_their_sizes() {
        let mut visuals = read(
            r#"<link name="a">
              <visual><origin xyz="1 2 3"/><geometry><box size="0.1 0.2 0.3"/></geometry></visual>
              <visual><geometry><cylinder radius="0.4" length="0.5"/></geometry></visual>
              <visual><geometry><sphere radius="0.6"/></geometry></visual>
              <visual><geometry><capsule radius="0.7" length="0.8"/></geometry></visual>
            </link>"#,
        );
        let drawn = visuals.take("a");
        let shapes: Vec<_> = drawn.iter().map(|v| v.shape.clone()).collect();
        let expected = [
            Shape::Box { size_m: Vector3::new(0.1, 0.2, 0.3) },
            Shape::Cylinder { radius_m: 0.4, length_m: 0.5 },
            Shape::Sphere { radius_m: 0.6 },
            Shape::Capsule { radius_m: 0.7, length_m: 0.8 },
        ];
        assert_eq!(shapes, expected);
        assert_eq!(drawn[0].link_from_shape.translation.vector, Vector3::new(1.0, 2.0, 3.0));
        assert_eq!(visuals.warnings, []);
    }

    #[test]
    fn a_material_is_found_by_its_name_wherever_it_is_given() {
        let sphere = r#"<geometry><sphere radius="1"/></geometry>"#;
        let mut visuals = read(&format!(
            r#"<material name="red"><color rgba="1 0 0 1"/></material>
            <link name="a"><visual>{sphere}<material name="red"/></visual></link>
            <link name="b"><visual>{sphere}<material name="grey"/></visual></link>
            <link name="c"><visual>{sphere}<material name="grey">
              <color rgba="0.5 0.5 0.5 0.25"/></material></visual></link>
            <link name="d"><visual>{sphere}<material name="odd">
              <color rgba="7 NaN 0 1"/></material></visual></link>"#
        ));
        let mut color = |link| visuals.take(link)[0].color_rgba;
        assert_eq!(color("a"), Some([1.0, 0.0, 0.0, 1.0]));
        assert_eq!(color("b"), Some([0.5, 0.5, 0.5, 0.25]));
        assert_eq!(color("c"), Some([0.5, 0.5, 0.5, 0.25]));
        assert_eq!(color("d"), None);
    }

    #[test]
    fn what_cannot_be_drawn_is_left_out_with_a_warning() {
        for bad in [
            r#"<geometry><sphere radius="NaN"/></geometry>"#,
            r#"<geometry><sphere radius="-1"/></geometry>"#,
            r#"<geometry><sphere radius="1e300"/></geometry>"#,
            r#"<geometry><box size="1 0 1"/></geometry>"#,
            r#"<geometry><box size="one two three"/></geometry>"#,
            r#"<geometry><mesh filename="m.stl" scale="0 1 1"/></geometry>"#,
            r#"<geometry><teapot/></geometry>"#,
            r#"<origin xyz="0 inf 0"/><geometry><sphere radius="1"/></geometry>"#,
            "",
        ] {
            let good = r#"<visual><geometry><sphere radius="1"/></geometry></visual>"#;
            let mut visuals =
                read(&format!(r#"<link name="a"><visual>{bad}</visual>{good}</link>"#));
            assert_eq!(visuals.take("a").len(), 1, "{bad}");
            let warned = matches!(&visuals.warnings[..],
                [RobotWarning::VisualLeftOut { link, .. }] if link == "a");
            assert!(warned, "{bad}: {:?}", visuals.warnings);
        }
    }
}
