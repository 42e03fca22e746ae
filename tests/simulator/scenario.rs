use catalogue::EffectKind;
use checks::arms::workspace_root;
use document::{Document, DocumentError};
use simulator::SimulatorError;
use simulator::scenario::Scenario;

/// One effect of every kind, as it may stand on the WAM.
pub const EFFECTS: [&str; 28] = [
    "viscous_friction = { joint = 'j4_elbow_pitch', viscous_nm_s_per_rad = 0.5 }",
    "coulomb_friction = { joint = 'j4_elbow_pitch', level_nm = 0.5 }",
    "asymmetric_friction = { joint = 'j4_elbow_pitch', forward_nm = 0.5, backward_nm = 0.7 }",
    "stribeck_friction = { joint = 'j4_elbow_pitch', coulomb_nm = 0.5, breakaway_nm = 0.7, stribeck_velocity_rad_per_s = 0.1 }",
    "presliding_friction = { joint = 'j4_elbow_pitch', stiffness_nm_per_rad = 500.0, damping_nm_s_per_rad = 5.0, level_nm = 0.5 }",
    "load_dependent_friction = { joint = 'j4_elbow_pitch', coefficient = 0.1 }",
    "position_dependent_friction = { joint = 'j4_elbow_pitch', level_nm = 0.5, share = 0.3, periods_per_turn = 4.0, phase_rad = 1.0 }",
    "friction_temperature_drift = { joint = 'j4_elbow_pitch', share = 0.3, time_constant_s = 900.0 }",
    "backlash = { joint = 'j4_elbow_pitch', gap_rad = 0.001 }",
    "joint_elasticity = { joint = 'j4_elbow_pitch', stiffness_nm_per_rad = 2000.0, damping_nm_s_per_rad = 1.0 }",
    "rotor_inertia = { joint = 'j4_elbow_pitch', inertia_kg_m2 = 0.02 }",
    "differential_coupling = { joint_a = 'j2_shoulder_pitch', joint_b = 'j3_shoulder_yaw', ratio = 1.0, level_sum_nm = 0.5, level_difference_nm = 0.5 }",
    "payload = { link = 'palm', mass_kg = 0.5, com_m = [0.0, 0.01, 0.05] }",
    "inertial_parameters = { link = 'palm', mass_kg = 0.5, com_m = [0.0, 0.01, 0.05] }",
    "gravity_direction = { tilt_x_rad = 0.02, tilt_y_rad = -0.01 }",
    "cable_spring = { joint = 'j4_elbow_pitch', stiffness_nm_per_rad = 1.0, rest_rad = 0.5, cubic_nm_per_rad3 = 0.1, hysteresis_nm = 0.1, pulls = 'both' }",
    "torque_ripple = { joint = 'j4_elbow_pitch', amplitude_nm = 0.2, periods_per_turn = 108.0, phase_rad = 1.0 }",
    "torque_constant = { joint = 'j4_elbow_pitch', gain = 1.1 }",
    "torque_offset = { joint = 'j4_elbow_pitch', offset_nm = 0.2 }",
    "actuator_lag = { joint = 'j4_elbow_pitch', time_constant_ms = 2.0 }",
    "actuator_delay = { joint = 'j4_elbow_pitch', delay_ms = 3.0 }",
    "torque_saturation = { joint = 'j4_elbow_pitch', limit_nm = 5.0 }",
    "encoder_offset = { joint = 'j4_elbow_pitch', offset_rad = 0.02 }",
    "transmission_ratio = { joint = 'j4_elbow_pitch', ratio = 1.02 }",
    "time_skew = { joint = 'j4_elbow_pitch', skew_ms = 3.0 }",
    "external_disturbance.push = { link = 'palm', force_n = [0.0, 5.0, 0.0], start_s = 0.1, duration_s = 0.1 }",
    "counterbalance = { joint = 'j4_elbow_pitch', amplitude_nm = 2.0, phase_rad = 0.5 }",
    "goal_delay = { delay_ms = 30.0 }",
];

/// The other form of a disturbance.
const PERIODIC: &str = "external_disturbance.periodic = { joint = 'j4_elbow_pitch', amplitude_nm = 0.5, frequency_hz = 2.0, phase_rad = 1.0 }";

/// A scenario of one short run on the WAM with perfect sensors, and more.
pub fn text(more: &str) -> String {
    format!(
        "robot = {:?}\nseed = 7\n\
         sensors = {{ effort = 'motor', velocity = 'ideal' }}\n\
         [[run]]\nname = 'one'\nlead_in_s = 0.0\n[run.motion.sinusoids]\n\
         seed = 1\nterms = 3\nlowest_hz = 0.2\nhighest_hz = 1.0\nduration_s = 0.4\nfade_s = 0.2\n{more}\n",
        workspace_root().join("robots/wam7/robot.toml")
    )
}

pub fn document(more: &str) -> Document {
    Document::from_text("scenario", &text(more)).unwrap()
}

pub fn scenario(more: &str) -> Scenario {
    Scenario::from_document(&document(more)).unwrap()
}

fn refusal(document: &Document) -> DocumentError {
    let error = Scenario::from_document(document).map(|_| ()).unwrap_err();
    assert!(matches!(error, SimulatorError::Scenario(_)), "{error}");
    let SimulatorError::Scenario(mistake) = error else { unreachable!() };
    mistake
}

#[test]
fn there_is_an_effect_of_every_kind_and_each_is_accepted() {
    for (kind, effect) in EffectKind::ALL.iter().zip(EFFECTS) {
        let scenario = scenario(&format!("[[effect]]\n{effect}"));
        assert_eq!(scenario.effects()[0].kind(), *kind);
    }
    assert_eq!(scenario(&format!("[[effect]]\n{PERIODIC}")).effects().len(), 1);
}

/// Keys of an effect below `path`, with the values that stand there.
fn leaves(path: &str, value: &toml::Value, found: &mut Vec<(String, toml::Value)>) {
    match value {
        toml::Value::Table(table) => {
            for (key, value) in table {
                leaves(&format!("{path}.{key}"), value, found);
            }
        }
        leaf => found.push((path.to_owned(), leaf.clone())),
    }
}

#[test]
fn every_number_of_every_effect_has_a_range_and_every_joint_and_link_must_exist() {
    for effect in EFFECTS.into_iter().chain([PERIODIC]) {
        let mut found = Vec::new();
        leaves("effect.0", &effect.parse::<toml::Table>().unwrap().into(), &mut found);
        for (path, value) in found {
            let wrong: &[&str] = match (&value, path.rsplit('.').next().unwrap()) {
                (toml::Value::Float(_), _) => &["nan", "inf", "1e12", "-1e12", "'x'"],
                (toml::Value::Array(_), _) => &["[0, nan, 0]", "[1e12, 0, 0]", "[0, 0, -1e12]"],
                (toml::Value::String(_), "pulls") => &["'sideways'", "3"],
                (toml::Value::String(_), _) => &["'nowhere'", "3"],
                _ => unreachable!("{path}: {value}"),
            };
            for wrong in wrong {
                let mut document = document(&format!("[[effect]]\n{effect}"));
                document.set(&format!("{path}={wrong}")).unwrap();
                let mistake = refusal(&document);
                let place = mistake.place().unwrap();
                assert_eq!(place.text(), *wrong, "{path}: {mistake}");
                assert!(mistake.to_string().contains(&format!("{path}: ")), "{mistake}");
            }
        }
    }
}

/// What is set, where the mistake is underlined if not at the value, and a part of what is said.
#[rustfmt::skip]
const MISTAKES: &[(&str, &str, &str)] = &[
    ("robot='nowhere.toml'", "", "nowhere.toml: there is no such file"),
    ("robot=7", "", "found 7"),
    ("seed=-1", "", "a whole number from 0 on"),
    ("sede=1", "sede", "unknown key `sede`, did you mean `seed`?"),
    ("engine.step_ms=0", "", "0, a number from 0.001 to 5"),
    ("engine.step_ms=-0.1", "", "a number from 0.001 to 5"),
    ("engine.step_ms=nan", "", "NaN, a number"),
    ("engine.step_ms=5.1", "", "a number from 0.001 to 5"),
    ("engine.step_ms=0.3", "", "0.3 ms goes 6.6667 times into the 2 ms of a period of control"),
    ("engine.step_ms=4.0", "", "a whole number was expected"),
    ("engine.joint_stops=1", "", "expected true or false, found 1"),
    ("engine.steps=1", "steps", "unknown key `steps`, did you mean `step_ms`?"),
    ("control.rate_hz=0.5", "", "0.5, a number from 1 to 20000"),
    ("control.rate_hz=inf", "", "inf, a number from 1 to 20000"),
    ("control.gains='stif'", "", "unknown set of gains `stif`, did you mean `stiff`?"),
    ("control.kp_nm_per_rad.j4_elbow=1", "j4_elbow", "did you mean `j4_elbow_pitch`?"),
    ("control.kp_nm_per_rad.j4_elbow_pitch=-1", "", "-1, a number from 0 to 1000000"),
    ("control.kd_nm_s_per_rad.j4_elbow_pitch=nan", "", "NaN, a number from 0 to 1000000"),
    ("sensors.position='midway'", "", "unknown name `midway`"),
    ("engine.order='third'", "", "unknown name `third`"),
    ("sensors.effort='measured'", "", "unknown name `measured`"),
    ("sensors.velocity={ filtered_difference = { cutoff_hz = 300 } }", "300", "300, a number from 0.1 to 250"),
    ("sensors.position_resolution_rad.j4_elbow_pitch=0.2", "", "0.2, a number from 0 to 0.1"),
    ("sensors.position_noise_rad.j4_elbow_pitch=-1e-3", "", "a number from 0 to 0.1"),
    ("sensors.position_noise_rad.elbow=1e-3", "elbow", "unknown joint `elbow`"),
    ("sensors.link_position_resolution_rad.j4_elbow_pitch=0.2", "", "a number from 0 to 0.1"),
    ("sensors.link_position_noise_rad.elbow=1e-3", "elbow", "unknown joint `elbow`"),
    ("sensors.effort_noise_nm.j4_elbow_pitch=inf", "", "inf, a number from 0 to 1000"),
    ("sensors.effort_resolution_nm.j4_elbow_pitch=-1", "", "-1, a number from 0 to 1000"),
    ("sensors.effort_resolution_nm.elbow=1", "elbow", "unknown joint `elbow`"),
    ("sensors={ link_position_noise_rad = { j4_elbow_pitch = 0 }, link_position_lag_ms = 1e4 }", "1e4", "10000, a number from 0 to 1000"),
    ("sensors.link_position_lag_ms=5", "", "5 ms for no encoder at a link, 0 was expected"),
    ("sensors.velocity_logged='maybe'", "", "unknown name `maybe`"),
    ("sensors.dropouts={ per_minute = 61, length_ms = 10 }", "61", "61, a number from 0 to 60"),
    ("sensors.dropouts={ per_minute = 6, length_ms = 0 }", "0", "0, a number from 1 to 2000"),
    ("sensors.dropouts={ per_minute = 6 }", "{ per_minute = 6 }", "`length_ms` is missing"),
    ("stranger=[{ snagg = {} }]", "snagg", "did you mean `snag`?"),
    ("stranger=[{ snag = { joint = 'x' } }]", "{ joint = 'x' }", "is missing"),
    ("sensors.log_rate_hz=333.0", "", "a whole part of the controller's 500 Hz was expected, such as 250 Hz"),
    ("sensors.log_rate_hz=1000.0", "", "1000, a number from 0.1 to 500"),
    ("sensors.time_jitter_ms=0.5", "", "0.5, a number from 0 to 0.4"),
    ("sensors.dropped_share=0.6", "", "0.6, a number from 0 to 0.5"),
    ("hidden={ count = 1 }", "1", "expected an array of 2, found 1"),
    ("hidden={ count = [2, 1] }", "[2, 1]", "the least and the largest number up to 20"),
    ("hidden={ count = [0, 21] }", "[0, 21]", "the least and the largest number up to 20"),
    ("hidden={ count = [1, 1], from = ['friction'] }", "'friction'", "unknown name `friction`"),
    ("hidden={ count = [1, 1], torque_share = [0, 0.1] }", "[0, 0.1]", "above 0 up to 1"),
    ("hidden={ count = [1, 1], torque_share = [0.2, nan] }", "[0.2, nan]", "above 0 up to 1"),
    ("hidden={ from = [] }", "{ from = [] }", "`count` is missing"),
    ("effect=[{ columb_friction = {} }]", "columb_friction", "did you mean `coulomb_friction`?"),
    ("effect=[{ coulomb_friction = { joint = 'x' } }]", "{ joint = 'x' }", "`level_nm` is missing"),
    ("run=[]", "", "no run, at least one was expected"),
    ("run.0.name='a/b'", "", "a name of letters, digits, - and _"),
    ("run.0.name=''", "", "a name of letters, digits, - and _"),
    ("run.0.name='..'", "", "a name of letters, digits, - and _"),
    ("run.0.lead_in_s=-1", "", "-1, a number from 0 to 600"),
    ("run.0.lead_in_s=1e9", "", "a number from 0 to 600"),
    ("run.0.motion.sinusoids.duration_s=0", "", "found 0, a finite number above 0"),
    ("run.0.motion.sinusoids.terms='x'", "", "expected a whole number"),
    ("run.0.motion={ hold = { duration_s = 1, posture_rad = { elbow = 1 } } }", "1", "joint elbow is not one of the robot's"),
    ("run.0.motion={ hold = { duration_s = 1, posture_rad = { j4_elbow_pitch = 4 } } }", "{ duration_s = 1, posture_rad = { j4_elbow_pitch = 4 } }", "motion.hold: hold: joint j4_elbow_pitch reaches a position of 4"),
    ("run.0.motion={ recorded = { file = 'nowhere.csv' } }", "'nowhere.csv'", "nowhere.csv"),
];

#[test]
fn every_mistake_is_told_at_its_place() {
    for (assignment, place, part) in MISTAKES {
        let mut document = document("");
        document.set(assignment).unwrap();
        let mistake = refusal(&document);
        let value = assignment.split_once('=').unwrap().1;
        let expected = if place.is_empty() { value } else { place };
        assert_eq!(mistake.place().unwrap().text(), expected, "{assignment}: {mistake}");
        assert!(mistake.to_string().contains(part), "{assignment}: {mistake}");
    }
}

#[test]
fn two_runs_of_one_name_are_refused_at_the_second() {
    let second = "[[run]]\nname = 'one'\nmotion.hold.duration_s = 1.0";
    let mistake = refusal(&document(second));
    assert!(mistake.to_string().ends_with("run.1.name: there are two runs called one"));
    assert_eq!((mistake.place().unwrap().line(), mistake.place().unwrap().column()), (15, 8));
}

#[test]
fn a_robot_without_gains_is_refused_where_they_would_stand() {
    let robot = workspace_root().join("robots/wam7/robot.urdf");
    let named = format!("{robot:?}");
    for (control, told, shown) in [
        (
            "[control]\nkp_nm_per_rad.j1_base_yaw = 10.0",
            "control: joint j2_shoulder_pitch",
            "[control]",
        ),
        ("", "robot: joint j1_base_yaw", named.as_str()),
    ] {
        let mut document = document(control);
        document.set(&format!("robot={named}")).unwrap();
        let mistake = refusal(&document);
        assert!(mistake.to_string().contains(&format!("{told} has no gains")), "{mistake}");
        assert_eq!(mistake.place().unwrap().text(), shown);
    }
}

/// A disturbance at a time of the log acts at that time, however long the arm was held before.
#[test]
fn time_zero_is_the_start_of_the_log_for_effects_too() {
    let effort = |more: &str| {
        let mut document = document(more);
        document.set("run.0.lead_in_s=0.3").unwrap();
        let scenario = Scenario::from_document(&document).unwrap();
        let run = simulator::simulate(&scenario, &|| {}).unwrap().runs.remove(0);
        run.time.into_iter().zip(run.joints[3].effort.clone()).collect::<Vec<(f64, f64)>>()
    };
    let is_push = |effect: &&&str| effect.starts_with("external_disturbance");
    let push = EFFECTS.iter().find(is_push).unwrap().replace("start_s = 0.1", "start_s = 0.2");
    let (with, without) = (effort(&format!("[[effect]]\n{push}")), effort(""));
    let first = with.iter().zip(&without).find(|((_, a), (_, b))| (a - b).abs() > 1e-9);
    let ((time_s, _), _) = first.unwrap();
    assert!((0.199..=0.206).contains(time_s), "{time_s} s");
}

#[test]
fn the_same_scenario_gives_the_same_logs_on_one_thread_and_on_four() {
    let noisy = "[[run]]\nname = 'two'\nmotion.hold.duration_s = 0.3\n\
                 [[run]]\nname = 'three'\nmotion.hold.duration_s = 0.2\n\
                 [hidden]\ncount = [1, 1]\nfrom = ['viscous_friction', 'coulomb_friction']";
    let mut document = document(noisy);
    document.set("sensors.effort_noise_nm.j4_elbow_pitch=0.1").unwrap();
    document.set("sensors.time_jitter_ms=0.1").unwrap();
    document.set("sensors.dropped_share=0.1").unwrap();
    let on = |threads: usize| {
        let scenario = Scenario::from_document(&document).unwrap();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| simulator::simulate(&scenario, &|| {}).unwrap())
    };
    let (one, four) = (on(1), on(4));
    assert_eq!(one, four);
    assert_eq!(one.runs.len(), 3);
    assert_ne!(one.runs[1].time.len(), 151, "no row was dropped");
}
