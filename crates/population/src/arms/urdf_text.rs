//! A chain as a URDF.

use std::fmt::Write;

use nalgebra::{Isometry3, Vector3};
use robot::{Inertia, JointKind};

use crate::arms::bodies::{Hull, SampledBody};
use crate::arms::chain::{Chain, ChainJoint};
use crate::dice::round_to_digits;

/// `<dynamics>` of a joint: damping (N m s/rad) and friction (N m).
pub(crate) type UrdfDynamics = [f64; 2];

/// The URDF of a chain with the torque limits of its joints, and the `<dynamics>` that all of them state.
pub(crate) fn urdf(chain: &Chain, limits: &[f64], dynamics: Option<UrdfDynamics>) -> String {
    let mut text = format!("<?xml version=\"1.0\"?>\n<robot name=\"{}\">\n", chain.name);
    text += "  <link name=\"world\"/>\n  <joint name=\"mount\" type=\"fixed\"><parent link=\"world\"/>\
             <child link=\"base\"/></joint>\n  <link name=\"base\"/>\n";
    let mut parent = "base";
    for (joint, &limit) in chain.joints.iter().zip(limits) {
        text += &moving(joint, parent, limit, dynamics);
        text += &link(&joint.body);
        parent = &joint.body.name;
    }
    if let Some((body, pose)) = &chain.gripper {
        text += &fixed_joint("gripper_mount", parent, &body.name, pose);
        text += &link(body);
        parent = &body.name;
    }
    text += &fixed_joint("tool_mount", parent, "tool0", &Isometry3::translation(0.0, 0.0, 0.01));
    text + "  <link name=\"tool0\"/>\n</robot>\n"
}

fn moving(joint: &ChainJoint, parent: &str, limit: f64, dynamics: Option<UrdfDynamics>) -> String {
    let kind = if joint.kind == JointKind::Prismatic { "prismatic" } else { "revolute" };
    let [low, high] = joint.range;
    let stated = dynamics.map_or_else(String::new, |[damping, friction]| {
        format!("<dynamics damping=\"{damping}\" friction=\"{friction}\"/>")
    });
    format!(
        "  <joint name=\"{}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{}\"/>\n    {}\
         <axis xyz=\"{}\"/>\n    <limit lower=\"{low}\" upper=\"{high}\" effort=\"{limit}\" \
         velocity=\"{}\"/>{stated}</joint>\n",
        joint.name,
        joint.body.name,
        origin(&joint.parent_from_joint),
        triple(&joint.axis),
        joint.speed,
    )
}

/// A joint that does not move.
pub(crate) fn fixed_joint(name: &str, parent: &str, child: &str, pose: &Isometry3<f64>) -> String {
    format!(
        "  <joint name=\"{name}\" type=\"fixed\"><parent link=\"{parent}\"/><child link=\"{child}\"/>{}</joint>\n",
        origin(pose)
    )
}

fn link(body: &SampledBody) -> String {
    let shape = match body.hull {
        Hull::Box([x, y, z]) => format!("<box size=\"{x:.4} {y:.4} {z:.4}\"/>"),
        Hull::Cylinder([d, l]) => {
            format!("<cylinder radius=\"{:.4}\" length=\"{l:.4}\"/>", 0.5 * d)
        }
    };
    format!(
        "  <link name=\"{}\">\n    {}\n    <visual>{}<geometry>{shape}</geometry></visual>\n  </link>\n",
        body.name,
        inertial(&body.inertia),
        origin(&body.link_from_hull)
    )
}

/// A body as the `<inertial>` of its link.
pub(crate) fn inertial(body: &Inertia) -> String {
    let Inertia { mass, com_in_link, about_com } = body;
    let mut text = format!(
        "<inertial><origin xyz=\"{}\" rpy=\"0 0 0\"/><mass value=\"{}\"/>\n      <inertia",
        triple(com_in_link),
        round_to_digits(*mass, 6),
    );
    for (key, at) in [
        ("ixx", (0, 0)),
        ("ixy", (0, 1)),
        ("ixz", (0, 2)),
        ("iyy", (1, 1)),
        ("iyz", (1, 2)),
        ("izz", (2, 2)),
    ] {
        // Writing to a string cannot fail.
        let _ = write!(text, " {key}=\"{}\"", round_to_digits(about_com[at], 7));
    }
    text + "/></inertial>"
}

fn origin(pose: &Isometry3<f64>) -> String {
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    let angles = Vector3::new(roll, pitch, yaw);
    format!("<origin xyz=\"{}\" rpy=\"{}\"/>", triple(&pose.translation.vector), triple(&angles))
}

/// Three numbers; what is left of a zero by rounding is one.
fn triple(vector: &Vector3<f64>) -> String {
    let [x, y, z] = [vector.x, vector.y, vector.z]
        .map(|v| if v.abs() < 1e-12 { 0.0 } else { round_to_digits(v, 12) });
    format!("{x} {y} {z}")
}
