use std::fmt;

use nalgebra::SymmetricEigen;

use crate::structure::robot::Robot;

/// Units of inertia that files hold in place of kg m², and how many of each are one kg m².
const UNITS: [(&str, f64); 5] =
    [("g m²", 1e3), ("kg cm²", 1e4), ("kg mm²", 1e6), ("g cm²", 1e7), ("g mm²", 1e9)];

/// Shortest distance that counts as the extent of a link (m): a shell is wider than the distance of its joints.
const LEAST_EXTENT_M: f64 = 0.1;

/// Radius of gyration over extent from which on an inertia is wrong (1): that of a rod about its end is .58.
const WIDEST: f64 = 3.0;

/// Radius of gyration from which on an inertia is told (m): that of 1 kg m² and 1 kg, which stand for an unknown body in
/// many files, is less.
const LEAST_RADIUS_M: f64 = 1.5;

/// Radius of gyration over extent of a usual link (1): that of a rod about its middle is .29, that of a shell .4.
const USUAL: f64 = 0.35;

/// An inertia that asks for mass far outside of its link.
///
/// ```text
/// radius of gyration = sqrt(largest principal moment about the centre of mass / mass)
/// extent             = largest distance of the centre of mass or a joint of a child from the link's origin
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct WideInertia {
    /// Name of the moving link.
    pub link: String,
    /// Its largest principal moment of inertia (kg m²).
    pub moment: f64,
    /// Its radius of gyration (m).
    pub radius_m: f64,
    /// Its extent (m).
    pub extent_m: f64,
}

impl WideInertia {
    /// The unit in which the moment would be that of a usual link.
    fn unit(&self) -> Option<&'static str> {
        let off =
            |per_si: f64| (self.radius_m / per_si.sqrt() / (USUAL * self.extent_m)).ln().abs();
        let nearest = UNITS.iter().min_by(|(_, a), (_, b)| off(*a).total_cmp(&off(*b)));
        nearest.filter(|(_, per_si)| off(*per_si) < WIDEST.ln()).map(|(unit, _)| *unit)
    }
}

impl fmt::Display for WideInertia {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { link, moment, radius_m, extent_m } = self;
        write!(
            f,
            "link {link}: a moment of inertia of {moment:.3e} kg m² has a radius of gyration of {radius_m:.2} m, but the \
             link reaches {extent_m:.2} m; "
        )?;
        match self.unit() {
            Some(unit) => write!(f, "the value may be in {unit}, kg m² were expected"),
            None => write!(f, "kg m² about the centre of mass were expected"),
        }
    }
}

impl Robot {
    /// The moving links whose radius of gyration is more than three times their extent, and 1.5 m: their inertia is in
    /// another unit.
    pub fn wide_inertias(&self) -> Vec<WideInertia> {
        (0..self.joint_count()).filter_map(|index| self.wide_inertia(index)).collect()
    }

    fn wide_inertia(&self, index: usize) -> Option<WideInertia> {
        let link = self.links().get(index)?;
        let children = self.links().iter().filter(|child| child.parent == Some(index));
        let joints = children.map(|child| child.joint.parent_from_joint.translation.vector.norm());
        let extent_m =
            joints.chain([link.inertia.com_in_link.norm(), LEAST_EXTENT_M]).fold(0.0, f64::max);
        let moment = SymmetricEigen::new(link.inertia.about_com).eigenvalues.max();
        let radius_m = (moment / link.inertia.mass).sqrt();
        let is_wide = radius_m.is_finite() && radius_m > LEAST_RADIUS_M.max(WIDEST * extent_m);
        is_wide.then(|| WideInertia { link: link.name.clone(), moment, radius_m, extent_m })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rod of 2 kg and .4 m whose inertia, `m l² / 12`, stands in another unit.
    fn rod(per_si: f64) -> WideInertia {
        let moment = per_si * 2.0 * 0.4_f64.powi(2) / 12.0;
        WideInertia {
            link: "rod".to_owned(),
            moment,
            radius_m: (moment / 2.0).sqrt(),
            extent_m: 0.4,
        }
    }

    #[test]
    fn the_unit_of_a_rod_is_told() {
        for (unit, per_si) in UNITS {
            assert_eq!(rod(per_si).unit(), Some(unit));
        }
        assert_eq!(rod(1e14).unit(), None);
    }
}
