//! A layer of Universal Scene Description, one rigid body a moving link.

use nalgebra::{Isometry3, Matrix3, Rotation3, SymmetricEigen, UnitQuaternion, Vector3};
use robot::{Inertia, Link, Loaded, Robot};

use crate::numbers::number;
use crate::usd::joint::{Ends, joint};
use crate::usd::text::{PrimNames, UsdText, rotation, vector};

/// The robot as a USD layer, its base fixed to the world, all joints at zero.
pub fn write(loaded: &Loaded, robot: &Robot) -> String {
    let mut names = PrimNames::default();
    let root = names.of(robot.name());
    let prims = prim_names(loaded, robot);
    let path = |name: String| format!("/{root}/{name}");
    let mut text = UsdText::new(&root);
    scene(&mut text, &names.of("physicsScene"), robot.gravity_in_base());
    text.open("Xform", &root, &["PhysicsArticulationRootAPI".to_owned()]);
    let base = prims.base;
    text.open("Xform", &base, &["PhysicsRigidBodyAPI".to_owned()]);
    text.original_name(&loaded.base_link);
    text.close();
    text.open("PhysicsFixedJoint", &prims.base_joint, &[]);
    text.set("rel physics:body1", &format!("<{}>", path(base.clone())));
    text.close();
    let mut placed: Vec<(Isometry3<f64>, String)> = Vec::new();
    for (link, (own, joint_prim)) in robot.links().iter().zip(prims.links) {
        let (parent_pose, parent) = match link.parent.and_then(|parent| placed.get(parent)) {
            Some((pose, name)) => (*pose, name.clone()),
            None => (Isometry3::identity(), base.clone()),
        };
        let pose = parent_pose * link.joint.parent_from_joint;
        body(&mut text, &own, &link.name, &pose, &link.inertia);
        let ends = Ends { parent: path(parent), child: path(own.clone()) };
        joint(&mut text, &joint_prim, &ends, link);
        placed.push((pose, own));
    }
    text.close();
    text.finish()
}

/// Unique prim names below the articulation.
pub struct ArticulationPrims {
    base: String,
    base_joint: String,
    /// Of each link and of its joint.
    pub links: Vec<(String, String)>,
}

/// The names under which a layer has the links and joints of a robot.
pub fn prim_names(loaded: &Loaded, robot: &Robot) -> ArticulationPrims {
    let mut names = PrimNames::default();
    let base = names.of(&loaded.base_link);
    let base_joint = names.of("base_to_world");
    let of = |link: &Link| (names.of(&link.name), names.of(&link.joint.name));
    ArticulationPrims { base, base_joint, links: robot.links().iter().map(of).collect() }
}

fn scene(text: &mut UsdText, name: &str, gravity_in_base: Vector3<f64>) {
    let size = gravity_in_base.norm();
    let direction = if size > 0.0 { gravity_in_base / size } else { -Vector3::z() };
    text.open("PhysicsScene", name, &[]);
    text.set("vector3f physics:gravityDirection", &vector(&direction));
    text.set("float physics:gravityMagnitude", &number(size));
    text.close();
}

fn body(text: &mut UsdText, prim: &str, name: &str, pose: &Isometry3<f64>, inertia: &Inertia) {
    let schemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"].map(str::to_owned);
    text.open("Xform", prim, &schemas);
    text.original_name(name);
    text.set("float physics:mass", &number(inertia.mass));
    text.set("point3f physics:centerOfMass", &vector(&inertia.com_in_link));
    let (moments, axes) = principal(&inertia.about_com);
    text.set("float3 physics:diagonalInertia", &vector(&moments));
    text.set("quatf physics:principalAxes", &rotation(&axes));
    text.set("double3 xformOp:translate", &vector(&pose.translation.vector));
    text.set("quatd xformOp:orient", &rotation(&pose.rotation));
    text.set("uniform token[] xformOpOrder", "[\"xformOp:translate\", \"xformOp:orient\"]");
    text.close();
}

/// Principal moments (kg m²), none below 0, and the axes that they are about.
///
/// ```text
/// about_com = R diag(moments) Rᵀ
/// ```
fn principal(about_com: &Matrix3<f64>) -> (Vector3<f64>, UnitQuaternion<f64>) {
    let SymmetricEigen { eigenvectors: mut axes, eigenvalues } = about_com.symmetric_eigen();
    if axes.determinant() < 0.0 {
        let turned = -axes.column(2);
        axes.set_column(2, &turned);
    }
    let axes = Rotation3::from_matrix_unchecked(axes);
    (eigenvalues.map(|moment| moment.max(0.0)), UnitQuaternion::from_rotation_matrix(&axes))
}

/// A body as it is written: moments below 0 are 0.
pub fn without_negative_moments(inertia: &Inertia) -> Inertia {
    let (moments, axes) = principal(&inertia.about_com);
    let axes = axes.to_rotation_matrix();
    let about_com = axes * Matrix3::from_diagonal(&moments) * axes.transpose();
    Inertia { about_com, ..inertia.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn principal_moments_and_axes_give_the_inertia_again() {
        let about_com = Matrix3::new(0.05, 0.01, -0.004, 0.01, 0.03, 0.002, -0.004, 0.002, 0.04);
        let (moments, axes) = principal(&about_com);
        let axes = axes.to_rotation_matrix();
        let again = axes * Matrix3::from_diagonal(&moments) * axes.transpose();
        assert!((again - about_com).norm() < 1e-12, "{again}");
    }
}
