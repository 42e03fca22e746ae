//! Robots as URDF, MJCF and robot.toml, exported where they are read.

use std::path::Path;

use checks::arms::workspace_root;
use checks::mutated;
use exchange::Format;
use rand_chacha::ChaCha8Rng;
use robot::Robot;

use super::Reader;

/// Two joints, with a shape, a mimicked finger and numbers of every kind.
pub const URDF: &str = r#"<robot name="arm">
<link name="base"><visual><geometry><box size="0.1 0.2 0.3"/></geometry></visual></link>
<link name="upper"><inertial><origin xyz="0.2 0 0" rpy="0 0.1 0"/><mass value="3"/>
<inertia ixx="0.01" iyy="0.05" izz="0.05" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="fore"><inertial><origin xyz="0.15 0 0"/><mass value="2"/>
<inertia ixx="0.01" iyy="0.03" izz="0.03" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="finger"/>
<joint name="j1" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 -1 0"/>
<limit lower="-2.9" upper="2.9" effort="80" velocity="6"/><dynamics damping="0.1" friction="0.2"/></joint>
<joint name="j2" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0.4 0 0"/>
<axis xyz="0 -1 0"/><limit lower="-2.9" upper="2.9" effort="40" velocity="6"/></joint>
<joint name="slide" type="fixed"><parent link="fore"/><child link="finger"/></joint>
</robot>
"#;

/// A robot.toml of the two joints.
const SETTINGS: &str = r#"urdf = "robot.urdf"
gravity_m_per_s2 = [0.0, 0.0, -9.81]
control_rate_hz = 500.0
sensing = "link"

[joint.j1]
rotor_inertia_kg_m2 = 0.1
kp_nm_per_rad = 400.0
kd_nm_s_per_rad = 20.0

[joint.j2]
rotor_inertia_kg_m2 = 0.05
kp_nm_per_rad = 200.0
kd_nm_s_per_rad = 10.0

[gains.soft]
kp_nm_per_rad = [100.0, 50.0]
kd_nm_s_per_rad = [10.0, 5.0]
"#;

/// Words of descriptions of robots.
const XML: &[&str] = &[
    "<joint name=\"j1\" type=\"continuous\">",
    "</joint>",
    "<link name=\"fore\">",
    "<body>",
    "</body>",
    "<default class=\"a\">",
    "<mimic joint=\"j1\" multiplier=\"2\"/>",
    "<include file=\"classes.xml\"/>",
    "type=\"prismatic\"",
    "type=\"floating\"",
    "xyz=\"1 0\"",
    "euler=\"90 0 0\"",
    "<!--",
    "-->",
    "<![CDATA[",
    "<!DOCTYPE a [<!ENTITY b \"c\">]>",
    "&b;",
    "&#x1F600;",
    "nan",
    "\"",
];

/// Words of documents.
pub const TOML: &[&str] = &[
    "[joint.shoulder]\n",
    "[[run]]\n",
    "extends = \"input.toml\"\n",
    "urdf = \"robot.urdf\"\n",
    "joint = {}\n",
    "= [",
    "= {",
    "]",
    "}",
    "\"\"\"",
    "nan",
    "inf",
    "true",
    "1979-05-27T07:32:00Z",
    "\n",
    ".",
    "#",
    "[",
    "{a=",
];

pub fn readers() -> Vec<Reader> {
    let of = |name, file, words, seeds| Reader {
        name,
        file,
        short: 1500,
        seeds,
        parsed: None,
        change: changed_text,
        read,
        parse: |path| Robot::load(path).map(drop).map_err(|e| e.to_string()),
        words,
    };
    vec![
        of("URDF", "input.urdf", XML, |_| vec![URDF.as_bytes().to_vec()]),
        of("MJCF", "input.xml", XML, |folder| {
            let from = workspace_root().join("tests/golden/mjcf");
            std::fs::copy(from.join("classes.xml"), folder.join("classes.xml")).unwrap();
            vec![std::fs::read(from.join("arm.xml")).unwrap()]
        }),
        Reader {
            parsed: Some(|folder| {
                std::fs::write(folder.join("robot.urdf"), URDF).unwrap();
                vec![SETTINGS.as_bytes().to_vec()]
            }),
            ..of("robot.toml", "input.toml", TOML, |folder| {
                let from = workspace_root().join("robots/so101");
                std::fs::copy(from.join("robot.urdf"), folder.join("robot.urdf")).unwrap();
                vec![std::fs::read(from.join("robot.toml")).unwrap()]
            })
        },
        of("extended", "input.toml", TOML, extended),
    ]
}

/// A robot with all that can be found in one.
fn extended(folder: &Path) -> Vec<Vec<u8>> {
    let path = folder.join("robot.urdf");
    std::fs::write(&path, URDF).unwrap();
    let loaded = Robot::load(&path).unwrap();
    let mut robot = loaded.robot.clone();
    checks::arms::put_in_everything(&mut robot.link_mut(1).unwrap().actuator);
    vec![loaded.to_toml(&robot, "robot.urdf").unwrap().into_bytes()]
}

pub fn changed_text(bytes: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    mutated::text(&String::from_utf8_lossy(bytes), random)
}

fn read(path: &Path) -> Result<(), String> {
    let loaded = Robot::load(path).map_err(|e| e.to_string())?;
    let source = std::fs::read_to_string(&loaded.urdf_path).unwrap();
    let n = loaded.robot.joint_count();
    let rest = vec![0.0; n];
    dynamics::Dynamics::new(&loaded.robot).inverse_dynamics(&rest, &rest, &rest).unwrap();
    for format in Format::ALL.into_iter().chain(Format::ACTUATORS) {
        // What a format cannot say is refused there.
        let _ = exchange::export(&loaded, &source, format);
    }
    Ok(())
}
