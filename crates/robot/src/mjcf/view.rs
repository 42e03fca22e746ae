use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, Unit, UnitQuaternion, Vector3};

use crate::error::RobotError;
use crate::mjcf::classes::Classes;
use crate::mjcf::compiler::Compiler;
use crate::mjcf::element::Element;

/// An element with the defaults that hold where it stands.
#[derive(Clone, Copy)]
pub struct View<'a> {
    pub element: &'a Element,
    /// Class of the elements around it.
    pub around: &'a str,
    pub classes: &'a Classes,
    pub compiler: &'a Compiler,
}

impl<'a> View<'a> {
    /// The text of an attribute.
    pub fn text(&self, key: &str) -> Option<&'a str> {
        self.classes.get(self.element, self.around, key)
    }

    /// The numbers of an attribute, up to `most` of them, all finite.
    pub fn numbers(&self, key: &str, most: usize) -> Result<Option<Vec<f64>>, RobotError> {
        let Some(text) = self.text(key) else { return Ok(None) };
        let shown: String = text.chars().take(40).collect();
        let found = || format!("{key}=\"{shown}\" was found");
        let parse = |word: &str| word.parse::<f64>().ok().filter(|v| v.is_finite());
        let numbers: Option<Vec<f64>> = text.split_whitespace().map(parse).collect();
        let numbers = numbers.filter(|list| !list.is_empty() && list.len() <= most);
        match numbers {
            Some(numbers) => Ok(Some(numbers)),
            None if most == 1 => {
                Err(self.element.bad(format!("{}, a number was expected", found())))
            }
            None => {
                Err(self.element.bad(format!("{}, up to {most} numbers were expected", found())))
            }
        }
    }

    /// Exactly `N` numbers of an attribute.
    pub fn exactly<const N: usize>(&self, key: &str) -> Result<Option<[f64; N]>, RobotError> {
        let Some(numbers) = self.numbers(key, N)? else { return Ok(None) };
        let count = numbers.len();
        let wrong = |_| self.element.bad(format!("{key} has {count} numbers, {N} were expected"));
        numbers.try_into().map(Some).map_err(wrong)
    }

    /// A number of an attribute.
    pub fn number(&self, key: &str) -> Result<Option<f64>, RobotError> {
        Ok(self.exactly::<1>(key)?.map(|[value]| value))
    }

    /// A vector of an attribute.
    pub fn vector(&self, key: &str) -> Result<Option<Vector3<f64>>, RobotError> {
        Ok(self.exactly::<3>(key)?.map(Vector3::from))
    }

    /// The pose of the element in the frame around it.
    pub fn pose(&self) -> Result<Isometry3<f64>, RobotError> {
        let position = self.vector("pos")?.unwrap_or_default();
        let rotation = self.rotation()?.unwrap_or_else(UnitQuaternion::identity);
        Ok(Isometry3::from_parts(Translation3::from(position), rotation))
    }

    /// `quat`, `axisangle`, `euler`, `xyaxes` or `zaxis`.
    fn rotation(&self) -> Result<Option<UnitQuaternion<f64>>, RobotError> {
        let element = self.element;
        let none = || element.bad("its orientation has no direction");
        if let Some([w, x, y, z]) = self.exactly::<4>("quat")? {
            let quaternion = nalgebra::Quaternion::new(w, x, y, z);
            return UnitQuaternion::try_new(quaternion, 1e-300).map(Some).ok_or_else(none);
        }
        if let Some([x, y, z, angle]) = self.exactly::<4>("axisangle")? {
            let axis = Unit::try_new(Vector3::new(x, y, z), 0.0).ok_or_else(none)?;
            let angle = self.compiler.radians(angle);
            return Ok(Some(UnitQuaternion::from_axis_angle(&axis, angle)));
        }
        if let Some(angles) = self.exactly::<3>("euler")? {
            return Ok(Some(self.compiler.euler(angles)));
        }
        if let Some([a, b, c, d, e, f]) = self.exactly::<6>("xyaxes")? {
            let x = Unit::try_new(Vector3::new(a, b, c), 0.0).ok_or_else(none)?;
            let y = Vector3::new(d, e, f);
            let y = Unit::try_new(y - x.dot(&y) * x.into_inner(), 0.0).ok_or_else(none)?;
            let axes = Matrix3::from_columns(&[*x, *y, x.cross(&y)]);
            let rotation = Rotation3::from_matrix_unchecked(axes);
            return Ok(Some(UnitQuaternion::from_rotation_matrix(&rotation)));
        }
        let Some(z) = self.vector("zaxis")? else { return Ok(None) };
        let z = Unit::try_new(z, 0.0).ok_or_else(none)?;
        Ok(Some(rotation_of_z_to(&z)))
    }
}

/// The least turn that takes the z axis to `z`; about x where that is a half turn.
pub fn rotation_of_z_to(z: &Unit<Vector3<f64>>) -> UnitQuaternion<f64> {
    UnitQuaternion::rotation_between_axis(&Vector3::z_axis(), z).unwrap_or_else(|| {
        UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
    })
}
