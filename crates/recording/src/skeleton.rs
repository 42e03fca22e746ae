use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};
use robot::{Joint, Looks, Robot};

/// Radius of a stick, as part of the reach.
const STICK: f64 = 0.025;

/// What the arms of a recording share: joints, how they hang together and how large it is.
#[derive(Debug, Clone)]
pub(crate) struct Skeleton {
    pub joints: Vec<Joint>,
    pub parents: Vec<Option<usize>>,
    pub links: Vec<String>,
    /// Turns the base so that things fall down in the picture.
    pub world_from_base: UnitQuaternion<f64>,
    /// The link at the end of the longest chain.
    pub last: usize,
    /// A point of that link far from its joint, in its frame (m).
    pub tip_in_last: Vector3<f64>,
    /// Length of the longest chain, the tip included (m).
    pub reach_m: f64,
}

impl Skeleton {
    pub fn new(robot: &Robot, looks: &Looks) -> Self {
        let links = robot.links();
        let mut length = vec![0.0; links.len()];
        for (i, link) in links.iter().enumerate() {
            let joint = &link.joint;
            let (low, high) = joint.limits.position.unwrap_or_default();
            let slide = if joint.kind.is_rotation() { 0.0 } else { low.abs().max(high.abs()) };
            let own = joint.parent_from_joint.translation.vector.norm() + slide;
            length[i] = link.parent.map_or(0.0, |p| length[p]) + own;
        }
        // The later of two of the same length: a wrist may have all its joints in one point.
        let last = (0..links.len()).max_by(|&a, &b| length[a].total_cmp(&length[b])).unwrap_or(0);
        let tip_in_last = tip(robot, looks, last);
        let longest = length.get(last).copied().unwrap_or(0.0) + tip_in_last.norm();
        Self {
            joints: links.iter().map(|l| l.joint.clone()).collect(),
            parents: links.iter().map(|l| l.parent).collect(),
            links: links.iter().map(|l| l.name.clone()).collect(),
            world_from_base: upright(&robot.gravity_in_base()),
            last,
            tip_in_last,
            reach_m: if longest.is_finite() && longest > 1e-3 { longest } else { 1.0 },
        }
    }

    /// Radius of a stick that stands for a link (m).
    pub fn stick_m(&self) -> f64 {
        STICK * self.reach_m
    }

    /// Poses of all links in their parents at `q`.
    pub fn parent_from_child(&self, q: &[f64]) -> Vec<Isometry3<f64>> {
        self.joints.iter().zip(q).map(|(joint, &q)| joint.parent_from_child(q)).collect()
    }

    /// The tip in the world, from the poses of the links in their parents.
    pub fn tip_in_world(&self, parent_from_child: &[Isometry3<f64>]) -> Vector3<f64> {
        let mut point = Point3::from(self.tip_in_last);
        let mut link = (!parent_from_child.is_empty()).then_some(self.last);
        while let Some(i) = link {
            point = parent_from_child[i] * point;
            link = self.parents[i];
        }
        self.world_from_base * point.coords
    }

    /// The joints and the tip in the world, from the poses of the links in their parents.
    pub fn points_in_world(&self, parent_from_child: &[Isometry3<f64>]) -> Vec<Vector3<f64>> {
        let mut base_from_link: Vec<Isometry3<f64>> = Vec::with_capacity(parent_from_child.len());
        for (pose, parent) in parent_from_child.iter().zip(&self.parents) {
            let above = parent.and_then(|p| base_from_link.get(p)).copied();
            base_from_link.push(above.unwrap_or_default() * pose);
        }
        let tip = base_from_link.get(self.last).map(|pose| pose * Point3::from(self.tip_in_last));
        let joints = base_from_link.iter().map(|pose| Point3::from(pose.translation.vector));
        joints.chain(tip).map(|point| self.world_from_base * point.coords).collect()
    }

    /// Where the joints on a link sit, in its frame; `None` is the base.
    pub fn joints_on(&self, link: Option<usize>) -> Vec<Vector3<f64>> {
        let on = self.joints.iter().zip(&self.parents).filter(|(_, parent)| **parent == link);
        on.map(|(joint, _)| joint.parent_from_joint.translation.vector).collect()
    }
}

/// The shape's centre or the centre of mass, whichever is farther from the joint.
fn tip(robot: &Robot, looks: &Looks, last: usize) -> Vector3<f64> {
    let com = robot.links().get(last).map(|l| l.inertia.com_in_link);
    let shapes = looks.links.get(last).into_iter().flatten();
    let centers = shapes.map(|v| v.link_from_shape.translation.vector);
    let far = com.into_iter().chain(centers).max_by(|a, b| a.norm().total_cmp(&b.norm()));
    far.unwrap_or_default()
}

/// Turns the direction of free fall to `-z`.
fn upright(gravity_in_base: &Vector3<f64>) -> UnitQuaternion<f64> {
    if gravity_in_base.norm() <= 0.0 {
        return UnitQuaternion::identity();
    }
    UnitQuaternion::rotation_between(gravity_in_base, &-Vector3::z()).unwrap_or_else(|| {
        UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A shoulder about z at 0.5 m, an elbow about y 1 m on, a hand 0.5 m further, hanging
    /// from a wall when asked to.
    fn arm() -> (Robot, Looks) {
        let urdf = r#"<robot name="arm">
            <link name="base"/>
            <link name="upper"><inertial><mass value="1"/>
              <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
            <link name="fore"><inertial><origin xyz="0.5 0 0"/><mass value="1"/>
              <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
            <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/>
              <origin xyz="0 0 0.5"/><axis xyz="0 0 1"/></joint>
            <joint name="elbow" type="continuous"><parent link="upper"/><child link="fore"/>
              <origin xyz="1 0 0"/><axis xyz="0 1 0"/></joint>
        </robot>"#;
        (Robot::from_urdf(urdf).unwrap(), Looks { base: vec![], links: vec![vec![]; 2] })
    }

    #[test]
    fn the_tip_of_two_links_is_where_the_closed_form_says() {
        let (robot, looks) = arm();
        let skeleton = Skeleton::new(&robot, &looks);
        assert!((skeleton.reach_m - 2.0).abs() < 1e-12);
        for (a, b) in [(0.0, 0.0), (0.3, -0.7), (2.0, 1.1)] {
            let tip = skeleton.tip_in_world(&skeleton.parent_from_child(&[a, b]));
            let out = 1.0 + 0.5 * f64::cos(b);
            let by_hand =
                Vector3::new(out * f64::cos(a), out * f64::sin(a), 0.5 - 0.5 * f64::sin(b));
            assert!((tip - by_hand).norm() < 1e-12, "{tip} {by_hand}");
            let points = skeleton.points_in_world(&skeleton.parent_from_child(&[a, b]));
            assert_eq!(points.len(), 3);
            assert!(
                (points[0] - Vector3::new(0.0, 0.0, 0.5)).norm() < 1e-12
                    && (points[2] - tip).norm() < 1e-12
            );
        }
    }

    #[test]
    fn things_fall_down_in_the_picture_however_the_robot_is_mounted() {
        let (robot, looks) = arm();
        for fall in [-Vector3::z(), Vector3::z(), Vector3::x(), Vector3::new(1.0, 2.0, 3.0)] {
            let skeleton = Skeleton::new(&robot.clone().with_gravity(fall), &looks);
            let down = skeleton.world_from_base * fall.normalize();
            assert!((down + Vector3::z()).norm() < 1e-12, "{fall}");
        }
    }
}
