use robot::{FrictionWave, Loaded, PdGain, Ripple, SensingSide, Stribeck, TorqueSource, Warming};

use super::{arm_with, load};

fn with(toml: &str) -> Result<Loaded, String> {
    let toml = format!("urdf = \"arm.urdf\"\n{toml}");
    load(&[("robot.toml", &toml), ("arm.urdf", &arm_with(""))])
}

fn refused(toml: &str) -> String {
    match with(toml) {
        Ok(loaded) => panic!("it was accepted: {:?}", loaded.robot),
        Err(message) => message,
    }
}

/// A message without the line and the column that it begins with.
fn without_place(told: &str) -> &str {
    let (place, message) = told.split_once(": ").unwrap();
    let numbers = place.strip_prefix("robot.toml:").unwrap().split(':');
    assert!(numbers.map(|number| number.parse::<usize>().unwrap()).all(|number| number > 0));
    message
}

#[test]
fn every_key_arrives() {
    let loaded = with(
        "gravity_m_per_s2 = [0, 9.81, 0]\ncontrol_rate_hz = 250\nsensing = \"motor\"
torque_source = \"current\"\ndifferentials = [[\"elbow\", \"shoulder\"]]
[joint.shoulder]
rotor_inertia_kg_m2 = 0.1\nviscous_nm_s_per_rad = 0.2\ncoulomb_nm = 0.3
spring_stiffness_nm_per_rad = 0.4\nspring_rest_rad = 0.5\nspring_cubic_nm_per_rad3 = 0.06\nspring_hysteresis_nm = 0.07\ntorque_gain = 0.6
torque_offset_nm = 0.7\nbacklash_rad = 0.01\nelasticity_nm_per_rad = 2000\nelasticity_damping_nm_s_per_rad = 1.5\nactuator_delay_ms = 4
torque_limit_nm = 8\nkp_nm_per_rad = 9\nkd_nm_s_per_rad = 1
[joint.elbow]
coulomb_forward_nm = 1\ncoulomb_backward_nm = 2
stribeck_excess_nm = 0.3\nstribeck_velocity_rad_per_s = 0.04\nload_friction = 0.05
presliding_rad = 0.001\npresliding_damping_nm_s_per_rad = 0.7\nactuator_lag_ms = 3\neffort_skew_ms = -2\nencoder_offset_rad = -0.02
transmission_ratio = 1.01
friction_wave = { share = 0.2, periods_per_turn = 7, phase_rad = 0.5 }
torque_ripple = { amplitude_nm = 0.06, periods_per_turn = 120 }\nsensing = \"link\"\ntorque_source = \"measured\"
[gains.soft]
kp_nm_per_rad = [1, 2]\nkd_nm_s_per_rad = [3, 4]
[link.lower]
mass_kg = 5\ncom_m = [0.1, 0.2, 0.3]
inertia_kg_m2 = { xx = 1, xy = 0.01, xz = 0.02, yy = 1.1, yz = 0.03, zz = 1.2 }",
    )
    .unwrap();
    let [upper, lower] = loaded.robot.links() else { panic!() };
    let a = &upper.actuator;
    assert_eq!((a.rotor_inertia, a.viscous), (0.1, 0.2));
    assert_eq!((a.coulomb_forward, a.coulomb_backward), (0.3, 0.3));
    assert_eq!((a.spring_stiffness, a.spring_rest), (0.4, 0.5));
    assert_eq!((a.spring_cubic, a.spring_hysteresis), (0.06, 0.07));
    assert_eq!((a.torque_gain, a.torque_offset), (0.6, 0.7));
    assert_eq!((a.backlash, a.elasticity, a.delay_s), (0.01, Some(2000.0), 0.004));
    assert_eq!((a.elasticity_damping, lower.actuator.elasticity_damping), (Some(1.5), None));
    assert_eq!((a.sensing, a.torque_source), (SensingSide::Motor, TorqueSource::Current));
    assert_eq!(upper.joint.limits.effort, Some(8.0));
    let b = &lower.actuator;
    assert_eq!((b.coulomb_forward, b.coulomb_backward), (1.0, 2.0));
    assert_eq!((b.backlash, b.elasticity, b.delay_s), (0.0, None, 0.0));
    assert_eq!((b.sensing, b.torque_source), (SensingSide::Link, TorqueSource::Measured));
    assert_eq!(b.stribeck, Some(Stribeck { excess: 0.3, velocity: 0.04 }));
    assert_eq!((b.load_friction, b.presliding, b.lag_s), (0.05, Some(0.001), 0.003));
    assert_eq!((a.presliding_damping, b.presliding_damping), (None, Some(0.7)));
    assert_eq!((b.encoder_offset, b.transmission_ratio), (-0.02, 1.01));
    assert_eq!(b.friction_wave, Some(FrictionWave { share: 0.2, periods: 7.0, phase: 0.5 }));
    assert_eq!(b.ripple, Some(Ripple { amplitude: 0.06, periods: 120.0, phase: 0.0 }));
    assert_eq!((a.effort_skew_s, b.effort_skew_s), (0.0, -0.002));
    assert_eq!((a.load_friction, a.lag_s, a.encoder_offset), (0.0, 0.0, 0.0));
    assert_eq!((a.stribeck, a.friction_wave, a.ripple), (None, None, None));
    assert_eq!((a.presliding, a.transmission_ratio), (None, 1.0));
    assert_eq!(lower.inertia.mass, 5.0);
    assert_eq!(lower.inertia.com_in_link.as_slice(), [0.1, 0.2, 0.3]);
    let i = &lower.inertia.about_com;
    assert_eq!([i.m11, i.m12, i.m13, i.m22, i.m23, i.m33], [1.0, 0.01, 0.02, 1.1, 0.03, 1.2]);
    assert_eq!((i.m21, i.m31, i.m32), (0.01, 0.02, 0.03));
    assert_eq!(loaded.robot.gravity_in_base().as_slice(), [0.0, 9.81, 0.0]);
    assert_eq!(loaded.control.rate_hz, Some(250.0));
    assert_eq!(loaded.control.gains, [Some(PdGain { kp: 9.0, kd: 1.0 }), None]);
    let soft = [PdGain { kp: 1.0, kd: 3.0 }, PdGain { kp: 2.0, kd: 4.0 }];
    assert_eq!(loaded.control.gain_sets["soft"], soft);
    assert_eq!(loaded.control.differentials, [[1, 0]]);
    assert!(loaded.urdf_path.ends_with("arm.urdf"));
}

#[test]
fn what_friction_loses_as_a_drive_warms_arrives() {
    let loaded = with(
        "[joint.elbow]\ncoulomb_forward_nm = 1\ncoulomb_backward_nm = 2\n\
         friction_warming = { coulomb_lost_nm = 0.5, time_constant_s = 900 }",
    )
    .unwrap();
    let [upper, lower] = loaded.robot.links() else { panic!() };
    let warming = Warming { viscous_lost: 0.0, coulomb_lost: 0.5, time_constant_s: 900.0 };
    assert_eq!((upper.actuator.warming, lower.actuator.warming), (None, Some(warming)));
}

#[test]
fn unknown_names_are_refused_with_the_nearest() {
    assert_eq!(
        refused("[joint.shouldr]\ntorque_gain = 1"),
        "robot.toml:2:8: joint.shouldr: unknown joint `shouldr`, did you mean `shoulder`?"
    );
    assert_eq!(
        refused("[joint.q9]\ntorque_gain = 1"),
        "robot.toml:2:8: joint.q9: unknown joint `q9`"
    );
    let inertia = "mass_kg = 1\ncom_m = [0, 0, 0]\n\
                   inertia_kg_m2 = { xx = 1, xy = 0, xz = 0, yy = 1, yz = 0, zz = 1 }";
    assert_eq!(
        refused(&format!("[link.loower]\n{inertia}")),
        "robot.toml:2:7: link.loower: unknown moving link `loower`, did you mean `lower`?"
    );
    let tool = r#"<link name="tool"/><joint name="m" type="fixed"><parent link="lower"/><child link="tool"/></joint>"#;
    let toml = format!("urdf = \"arm.urdf\"\n[link.tool]\n{inertia}");
    assert_eq!(
        load(&[("robot.toml", &toml), ("arm.urdf", &arm_with(tool))]).unwrap_err(),
        "robot.toml:2:1: link.tool: link tool is fixed to lower, name that one"
    );
}

#[test]
fn unknown_keys_and_wrong_types_are_refused_with_their_place() {
    assert_eq!(
        refused("[joint.elbow]\nviscous = 1"),
        "robot.toml:3:1: joint.elbow.viscous: unknown key `viscous`, did you mean `viscous_nm_s_per_rad`?"
    );
    assert_eq!(
        refused("[joint.elbow]\ntorque_gain = \"one\""),
        "robot.toml:3:15: joint.elbow.torque_gain: expected a number, found the string \"one\""
    );
    assert_eq!(refused("sensing = \"hand\""), "robot.toml:2:11: sensing: unknown name `hand`");
    assert!(refused("[joint.elbow").starts_with("robot.toml:2:"));
    assert_eq!(
        load(&[("robot.toml", "control_rate_hz = 1")]).unwrap_err(),
        "robot.toml:1:1: `urdf` is missing"
    );
}

#[test]
fn numbers_out_of_range_are_refused() {
    for (toml, message) in [
        (
            "gravity_m_per_s2 = [0, 0, nan]",
            "gravity_m_per_s2: gravity_m_per_s2 is NaN, a finite number",
        ),
        ("control_rate_hz = 0", "control_rate_hz: control_rate_hz is 0, a finite number above 0"),
        (
            "[joint.elbow]\nrotor_inertia_kg_m2 = -1e-3",
            "joint.elbow.rotor_inertia_kg_m2: rotor_inertia_kg_m2 is -0.001, a finite number not below 0",
        ),
        (
            "[joint.elbow]\ntorque_gain = 0",
            "joint.elbow.torque_gain: torque_gain is 0, a finite number above 0",
        ),
        (
            "[joint.elbow]\nbacklash_rad = -0.1",
            "joint.elbow.backlash_rad: backlash_rad is -0.1, a finite number not below 0",
        ),
        (
            "[joint.elbow]\nelasticity_nm_per_rad = 0",
            "joint.elbow.elasticity_nm_per_rad: elasticity_nm_per_rad is 0, a finite number above 0",
        ),
        (
            "[joint.elbow]\nactuator_delay_ms = inf",
            "joint.elbow.actuator_delay_ms: actuator_delay_ms is inf, a finite number not below 0",
        ),
        (
            "[joint.elbow]\ntorque_limit_nm = -inf",
            "joint.elbow.torque_limit_nm: torque_limit_nm is -inf, a finite number above 0",
        ),
        (
            "[joint.elbow]\ncoulomb_nm = inf",
            "joint.elbow.coulomb_forward_nm: coulomb_forward_nm is inf, a finite number",
        ),
        (
            "[joint.elbow]\nkp_nm_per_rad = -2\nkd_nm_s_per_rad = 0",
            "joint.elbow.kp_nm_per_rad: kp_nm_per_rad is -2, a finite number above 0",
        ),
        (
            "[link.lower]\nmass_kg = 0\ncom_m = [0, 0, 0]\ninertia_kg_m2 = { xx = 1, xy = 0, xz = 0, yy = 1, yz = 0, zz = 1 }",
            "link.lower.mass_kg: mass_kg is 0, a finite number above 0",
        ),
    ] {
        assert_eq!(without_place(&refused(toml)), format!("{message} was expected"));
    }
}

#[test]
fn numbers_of_friction_ripple_and_sensors_out_of_range_are_refused() {
    for (toml, message) in [
        (
            "[joint.elbow]\nstribeck_excess_nm = -0.1\nstribeck_velocity_rad_per_s = 0.1",
            "joint.elbow.stribeck_excess_nm: stribeck_excess_nm is -0.1, a finite number not below 0",
        ),
        (
            "[joint.elbow]\nstribeck_excess_nm = 0.1\nstribeck_velocity_rad_per_s = 0",
            "joint.elbow.stribeck_velocity_rad_per_s: stribeck_velocity_rad_per_s is 0, a finite number above 0",
        ),
        (
            "[joint.elbow]\nload_friction = -0.1",
            "joint.elbow.load_friction: load_friction is -0.1, a finite number not below 0",
        ),
        (
            "[joint.elbow]\npresliding_rad = 0",
            "joint.elbow.presliding_rad: presliding_rad is 0, a finite number above 0",
        ),
        (
            "[joint.elbow]\nactuator_lag_ms = -1",
            "joint.elbow.actuator_lag_ms: actuator_lag_ms is -1, a finite number not below 0",
        ),
        (
            "[joint.elbow]\nencoder_offset_rad = nan",
            "joint.elbow.encoder_offset_rad: encoder_offset_rad is NaN, a finite number",
        ),
        (
            "[joint.elbow]\ntransmission_ratio = 0",
            "joint.elbow.transmission_ratio: transmission_ratio is 0, a finite number above 0",
        ),
        (
            "[joint.elbow]\nfriction_wave = { share = 1.5, periods_per_turn = 1 }",
            "joint.elbow.friction_wave.share: friction_wave.share is 1.5, a number from 0 to 1",
        ),
        (
            "[joint.elbow]\nfriction_wave = { share = nan, periods_per_turn = 1 }",
            "joint.elbow.friction_wave.share: friction_wave.share is NaN, a number from 0 to 1",
        ),
        (
            "[joint.elbow]\nfriction_wave = { share = 0.5, periods_per_turn = -1 }",
            "joint.elbow.friction_wave.periods_per_turn: friction_wave.periods_per_turn is -1, a finite number not below 0",
        ),
        (
            "[joint.elbow]\ntorque_ripple = { amplitude_nm = -1, periods_per_turn = 1 }",
            "joint.elbow.torque_ripple.amplitude_nm: torque_ripple.amplitude_nm is -1, a finite number not below 0",
        ),
        (
            "[joint.elbow]\ntorque_ripple = { amplitude_nm = 1, periods_per_turn = inf }",
            "joint.elbow.torque_ripple.periods_per_turn: torque_ripple.periods_per_turn is inf, a finite number not below 0",
        ),
    ] {
        assert_eq!(without_place(&refused(toml)), format!("{message} was expected"));
    }
}

#[test]
fn keys_that_disagree_are_refused() {
    assert_eq!(
        refused("[joint.elbow]\ncoulomb_nm = 1\ncoulomb_forward_nm = 2"),
        "robot.toml:2:1: joint.elbow: coulomb_nm beside coulomb_forward_nm or coulomb_backward_nm, \
         either one value for both directions or one per direction was expected"
    );
    assert_eq!(
        refused(
            "[joint.elbow]\ncoulomb_nm = 0.4\n\
             friction_warming = { coulomb_lost_nm = 0.5, time_constant_s = 900 }"
        ),
        "robot.toml:2:1: joint.elbow: friction_warming loses more friction than the cold drive has, \
         viscous_nm_s_per_rad and coulomb_nm at least as large was expected"
    );
    assert_eq!(
        refused("[joint.elbow]\nkp_nm_per_rad = 1"),
        "robot.toml:2:1: joint.elbow: kp_nm_per_rad is there alone, kd_nm_s_per_rad as well was expected"
    );
    assert_eq!(
        refused("[joint.elbow]\nstribeck_excess_nm = 1"),
        "robot.toml:2:1: joint.elbow: stribeck_excess_nm is there alone, \
         stribeck_velocity_rad_per_s as well was expected"
    );
    assert_eq!(
        refused("[joint.elbow]\nstribeck_velocity_rad_per_s = 1"),
        "robot.toml:2:1: joint.elbow: stribeck_velocity_rad_per_s is there alone, \
         stribeck_excess_nm as well was expected"
    );
    for stiffness in ["", "\nspring_stiffness_nm_per_rad = -1"] {
        assert_eq!(
            refused(&format!("[joint.elbow]\nspring_hysteresis_nm = 0.1{stiffness}")),
            "robot.toml:2:1: joint.elbow: spring_hysteresis_nm is there without a spring that holds it, \
             spring_stiffness_nm_per_rad above 0 as well was expected"
        );
    }
    assert_eq!(
        refused("[joint.elbow]\npresliding_damping_nm_s_per_rad = 1"),
        "robot.toml:2:1: joint.elbow: presliding_damping_nm_s_per_rad is there alone, \
         presliding_rad as well was expected"
    );
    assert_eq!(
        refused("[joint.elbow]\nelasticity_damping_nm_s_per_rad = 1"),
        "robot.toml:2:1: joint.elbow: elasticity_damping_nm_s_per_rad is there alone, \
         elasticity_nm_per_rad as well was expected"
    );
    assert_eq!(
        refused("[gains.soft]\nkp_nm_per_rad = [1]\nkd_nm_s_per_rad = [1, 2]"),
        "robot.toml:3:17: gains.soft.kp_nm_per_rad: found 1 entries, 2 were expected, one per joint"
    );
}

#[test]
fn a_urdf_that_cannot_be_read_is_named_with_the_file_that_asks_for_it() {
    assert_eq!(
        load(&[("robot.toml", "urdf = \"none.urdf\"")]).unwrap_err(),
        "robot.toml:1:8: urdf: none.urdf: there is no such file, a URDF or a robot.toml was expected"
    );
    let broken = arm_with("<link name=\"stray\"/>");
    assert_eq!(
        load(&[("robot.toml", "urdf = \"arm.urdf\""), ("arm.urdf", &broken)]).unwrap_err(),
        "arm.urdf: links base and stray both have no parent, one root was expected"
    );
}

#[test]
fn an_inertia_in_the_toml_replaces_the_warnings_of_the_urdf() {
    let urdf = arm_with("").replace("izz=\"1\"", "izz=\"3\"");
    let toml = "urdf = \"arm.urdf\"\n[link.lower]\nmass_kg = 1\ncom_m = [0, 0, 0]\n\
                inertia_kg_m2 = { xx = 1, xy = 0, xz = 0, yy = 1, yz = 0, zz = 1 }";
    let loaded = load(&[("robot.toml", toml), ("arm.urdf", &urdf)]).unwrap();
    let about: Vec<&str> = loaded.warnings.iter().filter_map(|w| w.link()).collect();
    assert_eq!(about, ["upper"]);
    let toml = toml.replace("zz = 1", "zz = 2.5");
    let loaded = load(&[("robot.toml", &toml), ("arm.urdf", &arm_with(""))]).unwrap();
    let about: Vec<&str> = loaded.warnings.iter().filter_map(|w| w.link()).collect();
    assert_eq!(about, ["lower"]);
}

#[test]
fn a_joint_has_one_partner_at_most_in_a_differential_and_not_itself() {
    assert_eq!(
        refused("differentials = [[\"elbow\", \"shouldr\"]]"),
        "robot.toml:2:28: differentials.0.1: unknown joint `shouldr`, did you mean `shoulder`?"
    );
    assert_eq!(
        refused("differentials = [[\"elbow\", \"elbow\"]]"),
        "robot.toml:2:28: differentials.0.1: joint elbow is paired with itself, another joint was \
         expected"
    );
    assert_eq!(
        refused("differentials = [[\"elbow\", \"shoulder\"], [\"shoulder\", \"elbow\"]]"),
        "robot.toml:2:42: differentials.1.0: joint shoulder stands in two pairs, one at most was \
         expected"
    );
    let lonely = refused("differentials = [[\"elbow\"]]");
    assert!(lonely.starts_with("robot.toml:2:18: differentials.0: "), "{lonely}");
}

#[test]
fn the_defaults_of_the_schema_are_those_of_the_reader() {
    let schema = robot::description_schema();
    let arm = arm_with("");
    let robot = |toml: &str| load(&[("robot.toml", toml), ("a.urdf", &arm)]).unwrap().robot;
    let silent = robot("urdf = \"a.urdf\"\n");
    let mut stated = 0;
    for (place, at) in [("/properties", ""), ("/$defs/JointEntry/properties", "[joint.elbow]\n")] {
        for (key, of) in schema.pointer(place).unwrap().as_object().unwrap() {
            let Some(default) = of.get("default") else { continue };
            let said = format!("urdf = \"a.urdf\"\n{at}{key} = {default}\n");
            assert_eq!(robot(&said), silent, "{said}");
            stated += 1;
        }
    }
    assert!(stated > 10, "{stated} keys have a default");
}
