use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use quick_xml::events::BytesStart;

/// An attribute, without entities.
pub fn text(tag: &BytesStart<'_>, key: &str) -> Option<String> {
    let found = tag.try_get_attribute(key).ok().flatten()?;
    Some(found.unescape_value().ok()?.into_owned())
}

/// A number of an attribute; 0 where there is none.
pub fn value(tag: &BytesStart<'_>, key: &str) -> f64 {
    text(tag, key).and_then(|text| text.trim().parse().ok()).unwrap_or(0.0)
}

/// `xyz` and `rpy` of a tag.
pub fn pose(tag: &BytesStart<'_>) -> Isometry3<f64> {
    let three = |key| {
        let text = text(tag, key).unwrap_or_default();
        let mut numbers = text.split_whitespace().filter_map(|t| t.parse().ok());
        let mut next = || numbers.next().unwrap_or(0.0);
        [next(), next(), next()]
    };
    let ([x, y, z], [roll, pitch, yaw]) = (three("xyz"), three("rpy"));
    let rotation = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
    Isometry3::from_parts(Translation3::new(x, y, z), rotation)
}
