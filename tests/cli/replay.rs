use std::fs;
use std::path::Path;

use crate::files::{names, workspace};
use crate::program::{Answer, run};

const ROBOT: &str = "robots/wam7/robot.toml";

/// A folder with the logs of two runs of the WAM, made by its own simulation.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let robot = workspace().join(ROBOT);
    let scenario = format!(
        "robot = {robot:?}\n[sensors]\nvelocity = 'ideal'\n\
         [[run]]\nname = 'one'\nmotion.sinusoids = {{ seed = 1, terms = 3, lowest_hz = 0.2, highest_hz = 0.6, duration_s = 4.0 }}\n\
         [[run]]\nname = 'short'\nmotion.hold.duration_s = 1.2\n"
    );
    fs::write(folder.path().join("scenario.toml"), scenario).unwrap();
    let answer = run(folder.path(), &["simulate", "scenario.toml", "--out", "."]);
    assert_eq!(answer.code, 0, "{}", answer.err);
    folder
}

fn replay(folder: &Path, log: &str, more: &[&str]) -> Answer {
    let robot = workspace().join(ROBOT);
    let base = ["replay", "--robot", robot.to_str().unwrap(), "--log", log, "--out", "out"];
    run(folder, &[&base, more].concat())
}

#[test]
fn drift_and_torque_of_every_joint_are_told_and_the_motions_written() {
    let folder = folder();
    let answer = replay(folder.path(), "one.parquet", &["--window-ms", "50,200"]);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    let mut lines = answer.out.lines();
    assert_eq!(lines.next(), Some("one"));
    let words = |line: &str| line.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    let header = words(lines.next().unwrap());
    assert_eq!(header, ["joint", "50", "ms", "200", "ms", "torque", "measured"]);
    for (joint, line) in ["j1_base_yaw", "j2_shoulder_pitch"].iter().zip(lines) {
        let row = words(line);
        let number = |i: usize| row[i].parse::<f64>().unwrap();
        assert_eq!((row[0].as_str(), row.len()), (*joint, 5), "{line}");
        // In mrad.
        assert!(1e-3 * number(1) < 1e-4 && number(3) < 0.02 * number(4), "{line}");
    }
    for meaning in ["ms      drift after so long", "torque  simulated minus measured"] {
        assert!(answer.out.contains(meaning), "{meaning} is missing in\n{}", answer.out);
    }
    assert!(answer.out.ends_with("simulated motion and torque out\n"));
    assert!(answer.out.lines().all(|line| line.chars().count() <= 100), "{}", answer.out);
    let expected = [
        "one_forward_200ms.parquet",
        "one_forward_50ms.parquet",
        "one_motion.parquet",
        "replay.json",
        "report.html",
    ];
    assert_eq!(names(&folder.path().join("out")), expected);
}

/// The tip of a slide is as far off as its joint.
#[test]
fn the_tip_is_told_in_millimetres_and_all_numbers_for_programs() {
    let folder = tempfile::tempdir().unwrap();
    let urdf = "<robot name=\"slide\"><link name=\"base\"/><joint name=\"x\" type=\"prismatic\">\n\
        <parent link=\"base\"/><child link=\"cart\"/><axis xyz=\"1 0 0\"/>\n\
        <limit lower=\"-9\" upper=\"9\" velocity=\"90\" effort=\"90\"/></joint>\n\
        <link name=\"cart\"><inertial><mass value=\"2\"/>\n\
        <inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link></robot>";
    fs::write(folder.path().join("slide.urdf"), urdf).unwrap();
    // A cart of 3 kg, which the description calls one of 2 kg.
    let row = |k: u32| {
        let t = f64::from(k) / 200.0;
        let [x, v, a] = [0.2 * (4.0 * t).sin(), 0.8 * (4.0 * t).cos(), -3.2 * (4.0 * t).sin()];
        format!("{t},{x},{v},{}\n", 3.0 * a)
    };
    let log = "time,x.position,x.velocity,x.effort\n".to_owned();
    let log = log + &(0..2000).map(row).collect::<String>();
    fs::write(folder.path().join("run.csv"), log).unwrap();
    let base = ["replay", "--robot", "slide.urdf", "--log", "run.csv", "--window-ms", "200"];
    let told = run(folder.path(), &base);
    assert_eq!((told.code, told.err.as_str()), (0, ""));
    let number = |name: &str| -> f64 {
        let line = told.out.lines().find_map(|line| line.trim_start().strip_prefix(name)).unwrap();
        line.trim().parse().unwrap()
    };
    let drift = 1e-3 * number("x ");
    assert!(drift > 1e-3, "{}", told.out);
    assert!((number("tip (mm)") - 1e3 * drift).abs() < 5e-3 * 1e3 * drift, "{}", told.out);

    let answer = run(folder.path(), &[&base[..], &["--json", "--quiet"]].concat());
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    let value: serde_json::Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(value["schema"], "plumbline.replay/1");
    let window = &value["runs"][0]["windows"][0];
    let [joint, tip] = [&window["drift_rms"][0], &window["tip_rms_m"]].map(|x| x.as_f64().unwrap());
    assert!((joint - tip).abs() < 1e-9 * tip, "{window}");
    let written = fs::read_to_string(folder.path().join("out/replay/replay.json")).unwrap();
    assert_eq!(written, answer.out);
}

#[test]
fn a_window_that_fits_into_no_record_is_refused_before_anything_is_written() {
    let folder = folder();
    let answer = replay(folder.path(), "one.parquet", &["--window-ms", "50,60000"]);
    assert_eq!((answer.code, answer.out.as_str()), (3, ""));
    assert!(answer.err.contains("run one: ") && answer.err.contains("at least a window of 60 s"));
    assert_eq!(names(&folder.path().join("out")), [""; 0]);
    for wrong in ["0", "-5", "nan", "inf", "50,x"] {
        let answer = replay(folder.path(), "one.parquet", &["--window-ms", wrong]);
        assert_eq!(answer.code, 2, "{wrong}: {}", answer.err);
        assert!(answer.err.contains("a positive number was expected"), "{}", answer.err);
    }
}

#[test]
fn a_robot_without_gains_is_told_what_it_lacks() {
    let folder = folder();
    let robot = workspace().join("robots/wam7/robot.urdf");
    let base = ["replay", "--robot", robot.to_str().unwrap(), "--log", "one.parquet"];
    let answer = run(folder.path(), &[&base[..], &["--out", "out", "--window-ms", "20"]].concat());
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    let told = "that takes kp_nm_per_rad and kd_nm_s_per_rad";
    assert!(answer.out.contains(told), "{}", answer.out);
    assert_eq!(
        names(&folder.path().join("out")),
        ["one_forward_20ms.parquet", "replay.json", "report.html"]
    );
}

#[test]
fn logs_of_one_name_from_two_folders_are_kept_apart() {
    let folder = folder();
    fs::create_dir(folder.path().join("other")).unwrap();
    fs::copy(folder.path().join("one.parquet"), folder.path().join("other/one.parquet")).unwrap();
    let answer = replay(folder.path(), "one.parquet", &["other/one.parquet", "--window-ms", "50"]);
    assert_eq!(answer.code, 2, "{}", answer.err);
    let more = ["--log", "other/one.parquet", "--window-ms", "50"];
    let answer = replay(folder.path(), "one.parquet", &more);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    let expected = [
        "one_2_forward_50ms.parquet",
        "one_2_motion.parquet",
        "one_forward_50ms.parquet",
        "one_motion.parquet",
        "replay.json",
        "report.html",
    ];
    assert_eq!(names(&folder.path().join("out")), expected);
}

/// Recorded arms, where they are: the report comes, whatever the simulation does.
#[test]
fn recorded_logs_can_be_replayed() {
    let data = std::env::var_os("PLUMBLINE_DATA")
        .map_or_else(|| workspace().join("../shared/data"), std::path::PathBuf::from);
    let folder = tempfile::tempdir().unwrap();
    for (arm, log) in [("kinova_gen3", "Trajectory1"), ("staubli_tx40", "excitation")] {
        let (robot, log) = (data.join(arm).join("robot.urdf"), data.join(arm).join(log));
        let log = log.with_extension("parquet");
        if !log.exists() {
            println!("skipped: {} is absent, set PLUMBLINE_DATA to the data folder", log.display());
            continue;
        }
        let arguments = ["replay", "--robot", robot.to_str().unwrap(), "--log"];
        let more = [log.to_str().unwrap(), "--out", arm, "--window-ms", "20,1000"];
        let answer = run(folder.path(), &[&arguments[..], &more].concat());
        assert_eq!((answer.code, answer.err.as_str()), (0, ""), "{arm}");
        assert!(!answer.out.contains("NaN") && !answer.out.contains("0.00e0"), "{}", answer.out);
        let stem = log.file_stem().unwrap().to_str().unwrap();
        let motion = |ms: u32| format!("{stem}_forward_{ms}ms.parquet");
        let expected = [motion(1000), motion(20), "replay.json".into(), "report.html".into()];
        assert_eq!(names(&folder.path().join(arm)), expected, "{arm}");
    }
}
