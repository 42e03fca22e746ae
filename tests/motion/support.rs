//! Robots and motions that the tests share.

use std::path::Path;

use motion::{Motion, MotionError, MotionSpec};
use robot::Robot;

/// A slide along x, a wheel without limits and an elbow: every kind of joint.
pub fn gantry() -> Robot {
    let link = |name: &str| {
        format!(
            r#"<link name="{name}"><inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0"
            iyy="0.01" iyz="0" izz="0.01"/></inertial></link>"#
        )
    };
    let joint = |name: &str, kind: &str, [parent, child]: [&str; 2], rest: &str| {
        format!(
            r#"<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>
            {rest}</joint>"#
        )
    };
    let urdf = [
        r#"<robot name="gantry"><link name="base"/>"#.to_owned(),
        link("sledge"),
        link("disc"),
        link("arm"),
        joint("slide", "prismatic", ["base", "sledge"], {
            r#"<axis xyz="1 0 0"/><limit lower="-0.5" upper="1.5" velocity="0.8" effort="9"/>"#
        }),
        joint("wheel", "continuous", ["sledge", "disc"], r#"<axis xyz="0 0 1"/>"#),
        joint("elbow.1", "revolute", ["disc", "arm"], {
            r#"<origin xyz="0.4 0 0.1"/><axis xyz="0 1 0"/>
            <limit lower="-1" upper="2" velocity="3" effort="9"/>"#
        }),
        "</robot>".to_owned(),
    ];
    Robot::from_urdf(&urdf.concat()).unwrap()
}

/// The motion of a spec in TOML.
pub fn build(robot: &Robot, toml: &str) -> Result<Motion, MotionError> {
    let spec: MotionSpec = toml::from_str(toml).unwrap();
    spec.build(robot, Path::new("."))
}

/// Every kind of motion, for the WAM; `seed` draws numbers where a kind has some to draw.
pub fn every_kind(seed: u64) -> Vec<(&'static str, String)> {
    let share = (seed % 97) as f64 / 97.0;
    let hz = 0.1 + 0.2 * share;
    let rad = 0.1 + 0.4 * share;
    vec![
        ("sinusoids", sinusoids(seed)),
        (
            "fourier",
            format!(
                "[fourier]\nduration_s = 12.0\n[fourier.coefficients.inline]\nbase_hz = {hz}\n\
                [fourier.coefficients.inline.joint.j2_shoulder_pitch]\noffset_rad = 0.2\n\
                a_rad_per_s = [{rad}, 0.2, -0.1]\nb_rad_per_s = [-0.3, {hz}, 0.4]\n"
            ),
        ),
        (
            "sweep",
            format!(
                "[sweep]\nspeeds_rad_per_s = [{rad}, 1.0]\ndwell_s = 0.5\n\
                joints = [\"j4_elbow_pitch\", \"j7_palm_yaw\"]\nposition_share = 0.5\n"
            ),
        ),
        (
            "ramp",
            format!(
                "[ramp]\nfrom_rad = {{ j1_base_yaw = -{rad} }}\nduration_s = 4.0\n\
                to_rad = {{ j1_base_yaw = {rad}, j6_wrist_pitch = 0.3 }}\n"
            ),
        ),
        ("hold", format!("[hold]\nposture_rad = {{ j1_base_yaw = {rad} }}\nduration_s = 2.0\n")),
        ("linear chirp", chirp("linear", rad, hz)),
        ("logarithmic chirp", chirp("logarithmic", rad, hz)),
        ("waypoints passed", waypoints("pass", rad)),
        ("waypoints with stops", waypoints("stop", rad)),
        ("rhythm", rhythm("circle", "zx", 0.05 + 0.07 * share)),
        (
            "sequence",
            format!(
                "[[sequence]]\nhold = {{ duration_s = 1.0 }}\n[[sequence]]\nramp = {{ \
                to_rad = {{ j3_shoulder_yaw = {rad} }}, duration_s = 2.0 }}\n[[sequence]]\n{}",
                sinusoids(seed).replace("[sinusoids]", "[sequence.sinusoids]")
            ),
        ),
    ]
}

pub fn sinusoids(seed: u64) -> String {
    format!(
        "[sinusoids]\nseed = {seed}\nterms = 4\nlowest_hz = 0.05\nhighest_hz = 0.5\n\
        duration_s = 20.0\n"
    )
}

pub fn rhythm(figure: &str, plane: &str, radius_m: f64) -> String {
    format!(
        "[rhythm]\nfigure = \"{figure}\"\nplane = \"{plane}\"\nradius_m = {radius_m}\n\
        cycle_hz = 0.25\nduration_s = 10.0\npoint_m = [0.0, 0.0, 0.06]\n\
        posture_rad = {{ j2_shoulder_pitch = 0.6, j4_elbow_pitch = 1.4, j5_wrist_yaw = 0.0 }}\n"
    )
}

fn chirp(growth: &str, rad: f64, hz: f64) -> String {
    format!(
        "[chirp]\namplitude_rad = {{ j1_base_yaw = {rad}, j5_wrist_yaw = 0.1 }}\n\
        from_hz = {hz}\nto_hz = 0.7\ngrowth = \"{growth}\"\nduration_s = 10.0\n"
    )
}

fn waypoints(via: &str, rad: f64) -> String {
    format!(
        "[waypoints]\ntimes_s = [0.0, 1.5, 4.0, 5.0]\nvia = \"{via}\"\n\
        positions_rad = {{ j2_shoulder_pitch = [0.0, {rad}, -0.3, 0.1], \
        j4_elbow_pitch = [1.0, 1.2, 1.0, 0.9] }}\n"
    )
}
