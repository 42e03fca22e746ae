//! Every mistake in a spec is named by its key.

use checks::synthetic::wam;
use motion::{MotionError, MotionSpec};

use crate::support::{build, gantry, sinusoids};

/// Holds the key of every mistake against the one expected.
fn assert_keys(mistakes: &[(&str, &str)]) {
    for (expected, toml) in mistakes {
        let error = build(&wam(), toml).unwrap_err();
        assert_eq!(error.key(), *expected, "{toml}: {error}");
    }
}

#[test]
fn a_mistake_in_what_is_drawn_or_periodic_is_named_by_its_key() {
    let with = |line: &str| sinusoids(1) + line;
    let instead = |old: &str, new: &str| sinusoids(1).replace(old, new);
    let rhythm = crate::support::rhythm("circle", "xy", 0.1);
    let chirp = "[chirp]\namplitude_rad = { j1_base_yaw = 0.1 }\nduration_s = 5.0\n\
                 from_hz = 1.0\nto_hz = 101.0";
    let slow =
        "amplitude_rad = { j1_base_yaw = 1.0 }\nmax_speed_rad_per_s = { j1_base_yaw = 0.01 }";
    assert_keys(&[
        ("sinusoids.terms", &instead("terms = 4", "terms = 0")),
        ("sinusoids.lowest_hz", &instead("lowest_hz = 0.05", "lowest_hz = -1.0")),
        ("sinusoids.highest_hz", &instead("highest_hz = 0.5", "highest_hz = 0.01")),
        ("sinusoids.duration_s", &instead("20.0", "nan")),
        ("sinusoids.fade_s", &with("fade_s = 11.0")),
        ("sinusoids.position_share", &with("position_share = 1.1")),
        ("sinusoids.amplitude_rad.j2", &with("amplitude_rad = { j2 = 1.0 }")),
        ("sinusoids.amplitude_rad.j1_base_yaw", &with("amplitude_rad = { j1_base_yaw = -1.0 }")),
        ("sinusoids.max_speed_rad_per_s.j1_base_yaw", &with(slow)),
        ("sinusoids.centre_rad.j1_base_yaw", &with("centre_rad = { j1_base_yaw = 2.2 }")),
        ("chirp.to_hz", chirp),
        ("rhythm.point_m.1", &rhythm.replace("[0.0, 0.0, 0.06]", "[0.0, inf, 0.0]")),
        ("rhythm.radius_m", &rhythm.replace("radius_m = 0.1", "radius_m = 0.0")),
        (
            "fourier.coefficients.file",
            "[fourier]\ncoefficients.file = \"nowhere.toml\"\nduration_s = 10.0",
        ),
        (
            "fourier.coefficients.inline.joint.j1_base_yaw.b_rad_per_s",
            "[fourier]\nduration_s = 9.0\n[fourier.coefficients.inline]\nbase_hz = 0.1\n\
            joint.j1_base_yaw = { offset_rad = 0.0, a_rad_per_s = [0.1], b_rad_per_s = [] }",
        ),
    ]);
}

#[test]
fn a_mistake_in_what_goes_from_point_to_point_is_named_by_its_key() {
    assert_keys(&[
        ("sweep.joints.1", "[sweep]\nspeeds_rad_per_s = [0.1]\njoints = [\"j1_base_yaw\", \"j9\"]"),
        ("sweep.speeds_rad_per_s", "[sweep]\nspeeds_rad_per_s = []"),
        ("sweep.speeds_rad_per_s", "[sweep]\nspeeds_rad_per_s = [1e-6]"),
        (
            "sweep.speeds_rad_per_s.1",
            "[sweep]\nspeeds_rad_per_s = [0.1, 2.4]\nacceleration_rad_per_s2 = 0.5",
        ),
        ("ramp.blend_s", "[ramp]\nto_rad = {}\nduration_s = 1.0\nblend_s = 0.6"),
        ("hold.posture_rad.j2", "[hold]\nposture_rad = { j2 = 0.0 }\nduration_s = 1.0"),
        ("waypoints.times_s.2", "[waypoints]\ntimes_s = [0.0, 1.0, 1.0]\npositions_rad = {}"),
        ("waypoints.times_s.0", "[waypoints]\ntimes_s = [0.1, 1.0]\npositions_rad = {}"),
        (
            "waypoints.positions_rad.j1_base_yaw",
            "[waypoints]\ntimes_s = [0.0, 1.0]\npositions_rad = { j1_base_yaw = [1.0] }",
        ),
        ("sequence", "sequence = []"),
        (
            "sequence.1.hold.duration_s",
            "sequence = [{ hold = { duration_s = 1.0 } }, { hold = { duration_s = 0.0 } }]",
        ),
    ]);
}

#[test]
fn a_joint_whose_name_is_no_bare_key_stands_in_quotes() {
    let toml = "[hold]\nposture_rad = { \"elbow.1\" = nan }\nduration_s = 1.0";
    let error = build(&gantry(), toml).unwrap_err();
    let expected = "hold.posture_rad.\"elbow.1\": found NaN, a finite number was expected";
    assert_eq!(error.to_string(), expected);
}

#[test]
fn a_mistake_in_a_file_of_coefficients_is_told_with_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let text = "base_hz = 0.1\njoint.j9 = { offset_rad = 0, a_rad_per_s = [], b_rad_per_s = [] }";
    std::fs::write(folder.path().join("c.toml"), text).unwrap();
    let toml = "[fourier]\ncoefficients.file = \"c.toml\"\nduration_s = 10.0";
    let spec: MotionSpec = toml::from_str(toml).unwrap();
    let error = spec.build(&wam(), folder.path()).unwrap_err();
    let MotionError::File { key, path, reason } = error else { panic!("{error}") };
    assert_eq!((key.as_str(), path), ("fourier.coefficients.file", folder.path().join("c.toml")));
    assert!(reason.starts_with("joint.j9: joint j9 is not one of the robot's"), "{reason}");
}

#[test]
fn unknown_keys_and_kinds_are_refused() {
    for toml in [
        "[hold]\nduration_s = 1.0\nfade_s = 1.0",
        "[wiggle]\nduration_s = 1.0",
        "[rhythm]\nfigure = \"square\"",
    ] {
        assert!(toml::from_str::<MotionSpec>(toml).is_err(), "{toml}");
    }
}

#[test]
fn a_spec_is_written_as_it_was_read() {
    for (kind, toml) in crate::support::every_kind(7) {
        let spec: MotionSpec = toml::from_str(&toml).unwrap();
        let again: MotionSpec = toml::from_str(&toml::to_string(&spec).unwrap()).unwrap();
        assert_eq!(again, spec, "{kind}");
    }
}
