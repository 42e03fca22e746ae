use nalgebra::{Isometry3, Matrix3, Vector3};
use robot::Robot;

/// How every link of an arm moves at one instant, in the frame of the base.
///
/// ```text
/// omega_i = omega_p + z_i qd_i                         (a joint that turns)
/// alpha_i = alpha_p + z_i qdd_i + omega_p x z_i qd_i
/// a_i     = a_p + alpha_p x d + omega_p x (omega_p x d) [+ 2 omega_p x z_i qd_i + z_i qdd_i, one that slides]
/// ```
///
/// with `p` the parent, `d` from its origin to that of link `i`, and free fall as an upward acceleration of
/// the base (Luh, Walker & Paul 1980).
#[derive(Debug, Clone)]
pub(crate) struct Moving {
    links: Vec<Link>,
}

#[derive(Debug, Clone)]
struct Link {
    parent: Option<usize>,
    turns: bool,
    base_from_link: Isometry3<f64>,
    axis: Vector3<f64>,
    omega: Vector3<f64>,
    alpha: Vector3<f64>,
    acceleration: Vector3<f64>,
}

impl Moving {
    /// The links at positions, velocities and accelerations of the joints (rad or m, and per s, per s2).
    pub fn new(robot: &Robot, q: &[f64], qd: &[f64], qdd: &[f64]) -> Self {
        let mut links: Vec<Link> = Vec::with_capacity(robot.joint_count());
        let base = Link {
            parent: None,
            turns: true,
            base_from_link: Isometry3::identity(),
            axis: Vector3::zeros(),
            omega: Vector3::zeros(),
            alpha: Vector3::zeros(),
            acceleration: -robot.gravity_in_base(),
        };
        for (i, link) in robot.links().iter().enumerate() {
            let parent = link.parent.map_or(&base, |p| &links[p]);
            let base_from_link = parent.base_from_link * link.joint.parent_from_child(q[i]);
            let axis = base_from_link.rotation * link.joint.axis_in_joint.into_inner();
            let d = base_from_link.translation.vector - parent.base_from_link.translation.vector;
            let carried = parent.acceleration
                + parent.alpha.cross(&d)
                + parent.omega.cross(&parent.omega.cross(&d));
            let turns = link.joint.kind.is_rotation();
            let (omega, alpha, acceleration) = if turns {
                let spin = axis * qd[i];
                let alpha = parent.alpha + axis * qdd[i] + parent.omega.cross(&spin);
                (parent.omega + spin, alpha, carried)
            } else {
                let slide = 2.0 * parent.omega.cross(&axis) * qd[i] + axis * qdd[i];
                (parent.omega, parent.alpha, carried + slide)
            };
            let parent = link.parent;
            links.push(Link { parent, turns, base_from_link, axis, omega, alpha, acceleration });
        }
        Self { links }
    }

    /// Adds the torques (N m or N) that a body of ten parameters `pi` ([`robot::Inertia::parameters`]) on a
    /// link asks of the joints that carry it:
    ///
    /// ```text
    /// F = m a + alpha x h + omega x (omega x h)            h = m c, all about the link's origin
    /// N = h x a + I alpha + omega x (I omega)
    /// tau_j = z_j . (N + (p - p_j) x F)  where joint j turns,  z_j . F  where it slides
    /// ```
    pub fn add_body(&self, link: usize, pi: &[f64; 10], tau: &mut [f64]) {
        let Link { base_from_link, omega, alpha, acceleration: a, .. } = &self.links[link];
        let turned = base_from_link.rotation.to_rotation_matrix();
        let [m, hx, hy, hz, xx, xy, yy, xz, yz, zz] = *pi;
        let h = turned * Vector3::new(hx, hy, hz);
        let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let inertia = turned.matrix() * inertia * turned.matrix().transpose();
        let force = m * a + alpha.cross(&h) + omega.cross(&omega.cross(&h));
        let moment = h.cross(a) + inertia * alpha + omega.cross(&(inertia * omega));
        let origin = base_from_link.translation.vector;
        self.add_wrench(link, origin, &force, &moment, tau);
    }

    /// Adds the torques `J^T F` of a force (N, in the frame of the base) at a point of a link (m, in its frame).
    pub fn add_force(
        &self,
        link: usize,
        force: Vector3<f64>,
        point: Vector3<f64>,
        tau: &mut [f64],
    ) {
        let at = self.links[link].base_from_link * nalgebra::Point3::from(point);
        self.add_wrench(link, at.coords, &force, &Vector3::zeros(), tau);
    }

    /// Adds the torques of a force and a moment at a point, in the frame of the base.
    fn add_wrench(
        &self,
        link: usize,
        at: Vector3<f64>,
        force: &Vector3<f64>,
        moment: &Vector3<f64>,
        tau: &mut [f64],
    ) {
        let mut carrier = Some(link);
        while let Some(j) = carrier {
            let joint = &self.links[j];
            let arm = at - joint.base_from_link.translation.vector;
            tau[j] += if joint.turns {
                joint.axis.dot(&(moment + arm.cross(force)))
            } else {
                joint.axis.dot(force)
            };
            carrier = joint.parent;
        }
    }
}

/// Torques (N m or N) of all bodies of an arm along a motion, without its drives.
pub(crate) fn body_torque(robot: &Robot, q: &[f64], qd: &[f64], qdd: &[f64], tau: &mut [f64]) {
    let moving = Moving::new(robot, q, qd, qdd);
    tau.fill(0.0);
    for (i, link) in robot.links().iter().enumerate() {
        moving.add_body(i, &link.inertia.parameters(), tau);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arm(joint: &str) -> Robot {
        Robot::from_urdf(&format!(
            r#"<robot name="arm"><link name="base"/>
            <link name="upper"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
            <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.02"/></inertial></link>
            <joint name="a" type="{joint}"><parent link="base"/><child link="upper"/>
            <axis xyz="0 0 1"/><limit lower="-2" upper="2" velocity="3" effort="50"/></joint></robot>"#
        ))
        .unwrap()
    }

    /// `tau = (I + m c^2) qdd` about an upright axis; a slide along it lifts `m (g + qdd)`.
    #[test]
    fn one_body_turns_and_is_lifted_as_the_closed_forms_say() {
        let mut tau = [0.0];
        body_torque(&arm("revolute"), &[0.3], &[1.0], &[4.0], &mut tau);
        assert!((tau[0] - (0.02 + 2.0 * 0.25) * 4.0).abs() < 1e-12);
        body_torque(&arm("prismatic"), &[0.3], &[1.0], &[4.0], &mut tau);
        assert!((tau[0] - 2.0 * (9.81 + 4.0)).abs() < 1e-12);
    }
}
