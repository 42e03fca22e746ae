use nalgebra::{Isometry3, Matrix3, Vector3};
use robot::Inertia;

/// The inertia to write for a link so that its body, with everything fixed to it, has the new inertia.
///
/// ```text
/// pi_written = pi_of_the_link + (pi_new - pi_old)     ten parameters about the link's origin
/// ```
pub fn with_change(own: &Inertia, old: &Inertia, new: &Inertia) -> Inertia {
    let (own, old, new) = (own.parameters(), old.parameters(), new.parameters());
    let written: [f64; 10] = std::array::from_fn(|i| own[i] + (new[i] - old[i]));
    Inertia::from_parameters(&written)
}

/// An inertia as a URDF gives it: about the centre of mass, in axes that are turned.
pub fn from_urdf(mass: f64, pose: &Isometry3<f64>, moments: [f64; 6]) -> Inertia {
    let [xx, xy, xz, yy, yz, zz] = moments;
    let about_com = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    Inertia { mass, com_in_link: Vector3::zeros(), about_com }.in_frame(pose)
}
