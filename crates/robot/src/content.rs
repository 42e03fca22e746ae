use std::fmt::Write as _;

use crate::error::RobotError;
use crate::loaded::Loaded;
use crate::structure::link::Link;

impl Loaded {
    /// Everything in the files that affects the robot's motion, as one text. It does not depend on the
    /// names and places of the files, on comments or on meshes.
    ///
    /// Numbers of a `robot.toml` are written in full. Numbers of the URDF have ten digits, since the
    /// conversion of angles to rotations is rounded differently on different computers.
    ///
    /// # Errors
    ///
    /// Those of [`Loaded::to_toml`].
    pub fn content(&self) -> Result<String, RobotError> {
        let mut text = self.to_toml(&self.robot, "")?;
        for link in self.robot_in_urdf.links() {
            text.push_str(&line(link));
        }
        Ok(text)
    }
}

/// A link with its joint.
fn line(link: &Link) -> String {
    let joint = &link.joint;
    let mut text = format!("{} {} {:?} {:?}", link.name, joint.name, joint.kind, link.parent);
    let pose = joint.parent_from_joint.to_homogeneous();
    let limits = joint.limits;
    let reach = limits.position.map_or([f64::INFINITY; 2], |(lower, upper)| [lower, upper]);
    let most = [limits.velocity, limits.effort].map(|limit| limit.unwrap_or(f64::INFINITY));
    let drive = &link.actuator;
    let friction = [drive.viscous, drive.coulomb_forward, drive.coulomb_backward];
    let all = pose.iter().chain(joint.axis_in_joint.iter()).chain(&reach).chain(&most);
    for number in all.copied().chain(link.inertia.parameters()).chain(friction) {
        // A String takes everything; minus zero is zero.
        let _ = write!(text, " {:.9e}", number + 0.0);
    }
    text + "\n"
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::structure::robot::Robot;

    fn content(folder: &Path, urdf: &str, toml: &str) -> String {
        std::fs::create_dir_all(folder).unwrap();
        std::fs::write(folder.join("arm.urdf"), urdf).unwrap();
        std::fs::write(folder.join("robot.toml"), toml).unwrap();
        Robot::load(&folder.join("robot.toml")).unwrap().content().unwrap()
    }

    #[test]
    fn content_follows_from_the_dynamics_alone() {
        let urdf = r#"<robot name="r"><link name="a"/><link name="b"><inertial><mass value="3"/>
            <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
            <joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
            <origin rpy="0.3 0 0"/><limit lower="-2" upper="2" effort="1" velocity="1"/></joint></robot>"#;
        let toml = "urdf = \"arm.urdf\"\n[joint.j]\nrotor_inertia_kg_m2 = 0.1\n";
        let folder = tempfile::tempdir().unwrap();
        let here = content(&folder.path().join("here"), urdf, toml);
        let looks =
            "<link name=\"a\"><visual><geometry><sphere radius=\"1\"/></geometry></visual></link>";
        let seen = urdf.replace("<link name=\"a\"/>", looks);
        let comment = format!("# of today\n{toml}");
        assert_eq!(content(&folder.path().join("there"), &seen, &comment), here);
        for (heavier, geared) in [
            (urdf.replace("mass value=\"3\"", "mass value=\"9\""), toml.to_owned()),
            (urdf.replace("0.3 0 0", "0.31 0 0"), toml.to_owned()),
            (urdf.to_owned(), toml.replace("0.1", "0.2")),
        ] {
            assert_ne!(content(&folder.path().join("other"), &heavier, &geared), here);
        }
    }
}
