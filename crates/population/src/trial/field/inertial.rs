//! The bodies in the text of a URDF, as a hand would edit them.

use std::ops::Range;

use nalgebra::{Isometry3, Matrix3, Vector3};
use robot::Inertia;

use crate::arms::urdf_text::{fixed_joint, inertial};
use crate::error::PopulationError;

/// The body of a link, before links are merged.
pub(crate) fn body_of(urdf: &str, link: &str) -> Result<Inertia, PopulationError> {
    let element = &urdf[place(urdf, link)?];
    let numbers = |key| numbers(element, key).ok_or_else(|| missing(link));
    let [x, y, z] = numbers("xyz")?[..] else { return Err(missing(link)) };
    let one = |key| numbers(key)?.first().copied().ok_or_else(|| missing(link));
    let [xx, xy, xz] = [one("ixx")?, one("ixy")?, one("ixz")?];
    let [yy, yz, zz] = [one("iyy")?, one("iyz")?, one("izz")?];
    Ok(Inertia {
        mass: one("value")?,
        com_in_link: Vector3::new(x, y, z),
        about_com: Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
    })
}

/// The same URDF with another body of a link.
pub(crate) fn with_body(urdf: &str, link: &str, body: &Inertia) -> Result<String, PopulationError> {
    let place = place(urdf, link)?;
    Ok([&urdf[..place.start], &inertial(body), &urdf[place.end..]].concat())
}

/// The same URDF with a link `hand` fixed to a link, in the same frame.
pub(crate) fn with_hand(urdf: &str, link: &str, body: &Inertia) -> String {
    let mount = fixed_joint("hand_mount", link, "hand", &Isometry3::identity());
    let hand = format!("  <link name=\"hand\">\n    {}\n  </link>\n</robot>", inertial(body));
    urdf.replacen("</robot>", &(mount + &hand), 1)
}

/// The same URDF with a damping (N m s/rad or N s/m) and no dry friction at every joint that has limits.
pub(crate) fn with_damping(urdf: &str, damping: f64) -> String {
    let stated = format!("/><dynamics damping=\"{damping}\" friction=\"0\"/>");
    let mut text = String::with_capacity(2 * urdf.len());
    for (i, part) in elements(urdf, "<dynamics").concat().split("<limit").enumerate() {
        if i > 0 {
            text += "<limit";
            text += &part.replacen("/>", &stated, 1);
        } else {
            text += part;
        }
    }
    text
}

/// A text without its elements of a kind, in pieces.
fn elements<'a>(urdf: &'a str, start: &str) -> Vec<&'a str> {
    let mut parts = urdf.split(start);
    let first = parts.next();
    let behind = |part: &'a str| part.split_once("/>").map_or(part, |(_, rest)| rest);
    first.into_iter().chain(parts.map(behind)).collect()
}

/// Where the `<inertial>` of a link stands.
fn place(urdf: &str, link: &str) -> Result<Range<usize>, PopulationError> {
    const END: &str = "</inertial>";
    let found = || {
        let from = urdf.find(&format!("<link name=\"{link}\">"))?;
        let until = from + urdf[from..].find("</link>")?;
        let start = from + urdf[from..until].find("<inertial>")?;
        let end = start + urdf[start..until].find(END)? + END.len();
        Some(start..end)
    };
    found().ok_or_else(|| missing(link))
}

/// The numbers of an attribute.
fn numbers(element: &str, key: &str) -> Option<Vec<f64>> {
    let (_, behind) = element.split_once(&format!(" {key}=\""))?;
    let (value, _) = behind.split_once('"')?;
    value.split_whitespace().map(|number| number.parse().ok()).collect()
}

fn missing(link: &str) -> PopulationError {
    let reason = format!("link {link}: no <inertial> of a body was found, one was expected");
    PopulationError::Unwritable { what: "URDF", reason }
}

#[cfg(test)]
mod tests {
    use robot::Robot;

    use super::*;

    const URDF: &str = r#"<robot name="arm"><link name="base"/>
        <link name="upper">
        <inertial><origin xyz="0.5 0 -0.1" rpy="0 0 0"/><mass value="2"/>
        <inertia ixx="0.01" ixy="0.001" ixz="0" iyy="0.02" iyz="0" izz="0.025"/></inertial></link>
        <joint name="a" type="revolute"><parent link="base"/><child link="upper"/>
        <axis xyz="0 0 1"/><limit lower="-2" upper="2" velocity="3" effort="50"/><dynamics damping="0.1"/></joint></robot>"#;

    #[test]
    fn a_body_is_read_and_written() {
        let read = body_of(URDF, "upper").unwrap();
        let robot = Robot::from_urdf(URDF).unwrap();
        assert_eq!(read, robot.links()[0].inertia);
        let heavier = Inertia { mass: 3.5, ..read };
        let text = with_body(URDF, "upper", &heavier).unwrap();
        assert_eq!(Robot::from_urdf(&text).unwrap().links()[0].inertia, heavier);
        let error = body_of(URDF, "base").unwrap_err().to_string();
        assert!(error.contains("link base") && error.contains("expected"), "{error}");
    }

    #[test]
    fn a_hand_is_part_of_the_last_body_and_a_damping_of_every_joint() {
        let hand = Inertia {
            mass: 0.5,
            com_in_link: Vector3::new(0.0, 0.0, 0.2),
            about_com: Matrix3::identity() * 1e-3,
        };
        let text = with_damping(&with_hand(URDF, "upper", &hand), 5.0);
        let robot = Robot::from_urdf(&text).unwrap();
        let whole = body_of(URDF, "upper").unwrap().with_body(&hand);
        assert!((robot.links()[0].inertia.mass - whole.mass).abs() < 1e-12);
        assert!((robot.links()[0].inertia.com_in_link - whole.com_in_link).norm() < 1e-12);
        assert!((robot.links()[0].actuator.viscous - 5.0).abs() < 1e-12);
    }
}
