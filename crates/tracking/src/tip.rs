use nalgebra::{Isometry3, Point3};
use robot::Robot;

/// A point of the last link in the base frame (m) when the joints are at `q` (rad or m).
///
/// ```text
/// point_in_base = product over the joints that carry it of parent_from_child(q) * point_in_link
/// ```
pub fn tip_in_base(robot: &Robot, point_in_link: &Point3<f64>, q: &[f64]) -> Point3<f64> {
    let mut base_from_tip = Isometry3::identity();
    let mut next = robot.joint_count().checked_sub(1);
    while let Some(index) = next {
        let link = &robot.links()[index];
        base_from_tip = link.joint.parent_from_child(q[index]) * base_from_tip;
        next = link.parent;
    }
    base_from_tip * point_in_link
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{pendulum, slider};

    #[test]
    fn a_point_goes_round_with_a_hinge_and_along_with_a_slider() {
        let below = Point3::new(0.0, 0.0, -0.5);
        for q in [-1.2, 0.0, 0.7_f64] {
            // About +y: from straight below towards -x.
            let round = Point3::new(-0.5 * q.sin(), 0.0, -0.5 * q.cos());
            assert!((tip_in_base(&pendulum(), &below, &[q]) - round).norm() < 1e-15, "{q}");
            let along = Point3::new(q, 0.0, -0.5);
            assert!((tip_in_base(&slider(), &below, &[q]) - along).norm() < 1e-15, "{q}");
        }
    }

    #[test]
    fn joints_that_do_not_carry_the_last_link_do_not_move_its_point() {
        let link = |name: &str| {
            format!(
                r#"<link name="{name}"><inertial><mass value="1"/><inertia ixx="1" ixy="0"
                ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>"#
            )
        };
        let joint = |name: &str, parent: &str, child: &str, kind: &str| {
            format!(
                r#"<joint name="{name}" type="{kind}"><origin xyz="1 0 0"/>
                <parent link="{parent}"/><child link="{child}"/><axis xyz="0 0 1"/>
                <limit lower="-2" upper="2" velocity="9" effort="9"/></joint>"#
            )
        };
        let urdf = format!(
            r#"<robot name="fork"><link name="base"/>{}{}{}{}{}{}</robot>"#,
            link("stem"),
            link("left"),
            link("right"),
            joint("a", "base", "stem", "revolute"),
            joint("b", "stem", "left", "revolute"),
            joint("c", "stem", "right", "prismatic"),
        );
        let robot = Robot::from_urdf(&urdf).unwrap();
        let of = |b: f64| tip_in_base(&robot, &Point3::origin(), &[0.5, b, 0.25]);
        let expected = Point3::new(1.0 + 0.5_f64.cos(), 0.5_f64.sin(), 0.25);
        assert!((of(0.0) - expected).norm() < 1e-15 && of(0.0) == of(1.5), "{}", of(0.0));
    }
}
