use checks::arms::wam;
use robot::{Inertia, Robot};

use crate::rig::{effects, flywheel};

/// What cannot be meant, the key at which it stands and a part of what is said about it.
const MISTAKES: [(&str, &str, &str); 24] = [
    ("backlash = { joint = 'elbow', gap_rad = 0.01 }", "joint", "its joints are joint"),
    ("backlash = { joint = 'joint', gap_rad = -0.01 }", "gap_rad", "-0.01, a number from 0 to 0.5"),
    (
        "joint_elasticity = { joint = 'joint', stiffness_nm_per_rad = 0, damping_nm_s_per_rad = 0 }",
        "stiffness_nm_per_rad",
        "0, a number from 1 to 10000000 was expected",
    ),
    (
        "rotor_inertia = { joint = 'joint', inertia_kg_m2 = -0.2 }",
        "inertia_kg_m2",
        "a number from -0.1 to 100 was expected",
    ),
    (
        "payload = { link = 'joint_lnk', mass_kg = 1, com_m = [0, 0, 0] }",
        "link",
        "did you mean joint_link?",
    ),
    ("payload = { link = 'joint_link', mass_kg = 0, com_m = [0, 0, 0] }", "mass_kg", "0, a number"),
    (
        "payload = { link = 'joint_link', mass_kg = 1, com_m = [0, 0, nan] }",
        "com_m",
        "NaN, a number from -10 to 10 was expected",
    ),
    (
        "payload = { link = 'joint_link', mass_kg = 1, com_m = [0, 0, 0], inertia_kg_m2 = [1, 1, 3, 0, 0, 0] }",
        "inertia_kg_m2",
        "no body has such an inertia",
    ),
    (
        "inertial_parameters = { link = 'joint_link', mass_kg = 1, com_m = [0, 0, 0], inertia_kg_m2 = [1, 1, 1, 2, 0, 0] }",
        "inertia_kg_m2",
        "smallest principal moment",
    ),
    ("gravity_direction = { tilt_x_rad = 0, tilt_y_rad = 2 }", "tilt_y_rad", "2, a number from -1"),
    (
        "cable_spring = { joint = 'joint', stiffness_nm_per_rad = 0, rest_rad = 0, hysteresis_nm = 1 }",
        "hysteresis_nm",
        "1 without a stiffness, 0 was expected",
    ),
    (
        "torque_ripple = { joint = 'joint', amplitude_nm = 0.3, periods_per_turn = 0 }",
        "periods_per_turn",
        "0, a number from 0.1 to 100000 was expected",
    ),
    ("torque_constant = { joint = 'joint', gain = 0 }", "gain", "0, a number from 0.1 to 10"),
    ("torque_offset = { joint = 'joint', offset_nm = inf }", "offset_nm", "inf, a number"),
    (
        "actuator_lag = { joint = 'joint', time_constant_ms = -1 }",
        "time_constant_ms",
        "-1, a number from 0 to 1000 was expected",
    ),
    ("actuator_delay = { joint = 'joint', delay_ms = nan }", "delay_ms", "NaN, a number"),
    (
        "torque_saturation = { joint = 'joint', limit_nm = 0 }",
        "limit_nm",
        "0, a number from 0.000001",
    ),
    ("encoder_offset = { joint = 'joint', offset_rad = 360 }", "offset_rad", "360, a number"),
    ("transmission_ratio = { joint = 'joint', ratio = -1 }", "ratio", "-1, a number from 0.1"),
    ("time_skew = { joint = 'elbow', skew_ms = 1 }", "joint", "its joints are joint"),
    ("time_skew = { skew_ms = -2000 }", "skew_ms", "-2000, a number from -1000 to 1000"),
    (
        "external_disturbance.periodic = { joint = 'joint', amplitude_nm = 1, frequency_hz = 0 }",
        "periodic.frequency_hz",
        "0, a number from 0.001 to 1000 was expected",
    ),
    (
        "external_disturbance.push = { link = 'joint_link', force_n = [0, 1e5, 0], start_s = 0, duration_s = 1 }",
        "push.force_n",
        "100000, a number",
    ),
    (
        "external_disturbance.push = { link = 'hand', force_n = [0, 0, 0], start_s = 0, duration_s = 1 }",
        "push.link",
        "its moving links are joint_link",
    ),
];

#[test]
fn what_no_arm_has_is_refused_at_its_key() {
    let robot = flywheel(0.4, 0.1);
    for (toml, key, part) in MISTAKES {
        let mistake = effects(&format!("[[effect]]\n{toml}"))[0].inject(&robot).err().unwrap();
        assert_eq!(mistake.key, key, "{toml}");
        assert!(mistake.found.contains(part), "{toml}: {}", mistake.found);
    }
}

/// A screw of lead `l` makes of a motor's friction and rotor `(2 pi / l)^2` times as much, in N s/m and kg.
#[test]
fn a_joint_that_slides_has_bounds_of_its_own() {
    let robot = |kind: &str| {
        Robot::from_urdf(&format!(
            r#"<robot name="axis"><link name="base"/><link name="slide"><inertial><mass value="9"/>
            <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
            <joint name="joint" type="{kind}"><parent link="base"/><child link="slide"/>
            <axis xyz="0 0 1"/><limit lower="-1" upper="1" velocity="1" effort="900"/></joint></robot>"#
        ))
        .unwrap()
    };
    let refused = |kind: &str, toml: &str| {
        effects(&format!("[[effect]]\n{toml}"))[0].inject(&robot(kind)).err().map(|m| m.found)
    };
    let friction = "viscous_friction = { joint = 'joint', viscous_nm_s_per_rad = 1018 }";
    let rotor = "rotor_inertia = { joint = 'joint', inertia_kg_m2 = 395 }";
    let most = [(friction, "1018", "100000", "1000"), (rotor, "395", "10000", "100")];
    for (toml, size, sliding, turning) in most {
        assert_eq!(refused("prismatic", toml), None, "{toml}");
        let turns = refused("revolute", toml).unwrap();
        assert!(turns.contains(&format!("to {turning} was expected")), "{turns}");
        let large = refused("prismatic", &toml.replace(size, "1e6")).unwrap();
        assert!(large.contains(&format!("to {sliding} was expected")), "{large}");
    }
}

/// A link that is fixed to another has no body of its own.
#[test]
fn a_link_that_does_not_move_by_itself_is_refused_with_the_one_that_carries_it() {
    let robot = wam();
    let (moving, fixed) = robot
        .links()
        .iter()
        .find_map(|l| Some((l.name.clone(), l.merged.first()?.clone())))
        .unwrap();
    let toml =
        format!("[[effect]]\npayload = {{ link = '{fixed}', mass_kg = 1, com_m = [0, 0, 0] }}");
    let mistake = effects(&toml)[0].inject(&robot).err().unwrap();
    assert_eq!(mistake.found, format!("{fixed} is fixed to {moving}, {moving} was expected"));
}

#[test]
fn a_massless_link_needs_its_inertia_stated() {
    let mut robot = flywheel(0.4, 0.1);
    robot.link_mut(0).unwrap().inertia = Inertia::zero();
    let body = "link = 'joint_link', mass_kg = 1, com_m = [0, 0, 0]";
    let inject = |body: &str| {
        effects(&format!("[[effect]]\ninertial_parameters = {{ {body} }}"))[0].inject(&robot).err()
    };
    assert_eq!(inject(body).unwrap().key, "inertia_kg_m2");
    assert!(inject(&format!("{body}, inertia_kg_m2 = [1, 1, 1, 0, 0, 0]")).is_none());
}
