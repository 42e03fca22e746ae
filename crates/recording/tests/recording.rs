//! What a recording holds, read back with the decoder of the library that wrote it.
#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

use std::fs::File;
use std::io::BufReader;
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::Command;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use recording::{
    Arm, BarSeries, Contents, EventLevel, FinishedRecording, Listener, Live, Recorder,
    RecordingError, RowBlock, Scene, SceneRole, SceneSignal, SignalQuantity,
};
use rerun::external::re_log_encoding::DecoderApp;
use rerun::external::re_log_types::LogMsg;
use rerun::log::Chunk;
use robot::{Loaded, Robot};

const RATE_HZ: f64 = 500.0;

fn wam() -> Loaded {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/wam7/robot.toml");
    Robot::load(Path::new(file)).unwrap()
}

fn scene(loaded: &Loaded) -> Scene<'_> {
    Scene {
        title: "a test",
        robot: &loaded.robot,
        looks: &loaded.looks,
        arms: vec![
            Arm { name: "measured", role: SceneRole::Actual },
            Arm { name: "desired", role: SceneRole::Desired },
        ],
        signals: vec![
            SceneSignal {
                quantity: SignalQuantity::Position,
                name: "desired",
                role: SceneRole::Desired,
            },
            SceneSignal {
                quantity: SignalQuantity::Position,
                name: "measured",
                role: SceneRole::Actual,
            },
            SceneSignal {
                quantity: SignalQuantity::Error,
                name: "tracking error",
                role: SceneRole::Error,
            },
        ],
    }
}

fn value(row: usize, joint: usize) -> f64 {
    (0.003 * row as f64 + joint as f64).sin()
}

/// What a model predicts ten times a second.
fn slow() -> (Vec<f64>, Vec<f64>) {
    let time_s = (0..30).map(|i| 0.1 * f64::from(i)).collect();
    (time_s, (0..30).flat_map(|i| (0..7).map(move |j| value(50 * i, j))).collect())
}

/// Three seconds in blocks of 0.2 s; the position of joint 2 is not known in row 700.
fn record(path: &Path) -> FinishedRecording {
    record_to(path, Live::Off)
}

fn record_to(path: &Path, live: Live) -> FinishedRecording {
    let loaded = wam();
    let mut recorder = Recorder::create(path, &scene(&loaded), live).unwrap();
    for start in (0..1500).step_by(100) {
        let time_s: Vec<f64> = (start..start + 100).map(|i| i as f64 / RATE_HZ).collect();
        let grid = || (start..start + 100).flat_map(|i| (0..7).map(move |j| (i, j)));
        let q: Vec<f64> = grid().map(|(i, j)| value(i, j)).collect();
        let gap = |(i, j)| if (i, j) == (700, 2) { f64::NAN } else { value(i, j) };
        let measured: Vec<f64> = grid().map(gap).collect();
        let error: Vec<f64> = grid().map(|(i, j)| 1e-3 * value(i, j)).collect();
        recorder
            .rows(&RowBlock { time_s: &time_s, arms: &[&q, &q], signals: &[&q, &measured, &error] })
            .unwrap();
    }
    recorder.event(1.0, EventLevel::Warning, "prediction stalled").unwrap();
    let (time_s, tau) = slow();
    let predicted =
        SceneSignal { quantity: SignalQuantity::Torque, name: "gp", role: SceneRole::Model(0) };
    recorder.further(&time_s, &[(predicted, &tau)]).unwrap();
    recorder.document("# Verdict").unwrap();
    let bar = |place, name, values| BarSeries { name, role: SceneRole::Model(place), values };
    let bars = [bar(0, "gp", &[1.0; 7][..]), bar(1, "none", &[2.0; 7])];
    recorder.bars("RMSE (mrad)", &bars).unwrap();
    recorder.finish().unwrap()
}

#[test]
fn a_recording_holds_what_was_put_into_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    let written = record(&path);
    assert_eq!(written.rows, 1500);
    assert_eq!(written.bytes, std::fs::metadata(&path).unwrap().len());
    assert_eq!(written.listener, Listener::NotAsked);
    let file = Contents::read(&path).unwrap();
    assert!(file.is_whole);
    assert_eq!(file.time_s(), Some([0.0, 2.998]));
    assert!(file.layout_messages > 50, "{}", file.layout_messages);
    // Once without the bars, once with them.
    assert_eq!(file.layouts, 2);

    let joint = &file.entities["/joints/j3_shoulder_yaw"];
    let expected_ns: Vec<i64> = (0..1500).map(|i| i * 2_000_000).collect();
    assert_eq!(joint.times_ns, expected_ns);
    let (position, error) = (&joint.columns["position"], &joint.columns["error"]);
    for row in 0..1500 {
        let q = value(row, 2);
        assert_eq!(position[row][0].to_bits(), q.to_bits());
        if row == 700 {
            assert!(position[row][1].is_nan());
        } else {
            assert_eq!(position[row][1].to_bits(), q.to_bits());
        }
        // Errors are shown in mrad.
        assert!((error[row][0] - q).abs() < 1e-15);
    }

    let further = &file.entities["/joints/j3_shoulder_yaw/further1"];
    assert_eq!(further.times_ns, (0..30).map(|i| i * 100_000_000).collect::<Vec<i64>>());
    let expected: Vec<Vec<f64>> = (0..30).map(|i| vec![value(50 * i, 2)]).collect();
    assert_eq!(further.columns["torque"], expected);

    let link = file.entities.keys().find(|k| k.ends_with("/shoulder_yaw/shoulder_pitch"));
    let link = &file.entities[link.unwrap()];
    assert_eq!(link.times_ns.len(), 150, "poses come at 50 Hz");
    for entity in ["/world/paths/measured", "/events", "/verdict", "/metrics/RMSE_mrad/gp"] {
        assert!(file.entities.contains_key(entity), "{entity}: {:?}", file.entities.keys());
    }
}

#[test]
fn a_file_that_is_cut_reads_up_to_there() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    record(&path);
    let bytes = std::fs::read(&path).unwrap();
    let whole = Contents::read(&path).unwrap();
    let cut_to = |length: usize| {
        std::fs::write(&path, &bytes[..length]).unwrap();
        Contents::read(&path).unwrap()
    };
    // Without its last byte, the file holds all but was not ended.
    let almost = cut_to(bytes.len() - 1);
    assert!(!almost.is_whole && whole.is_whole);
    assert_eq!(format!("{:?}", almost.entities), format!("{:?}", whole.entities));
    let parts: Vec<Contents> =
        (20..100).map(|percent| cut_to(bytes.len() * percent / 100)).collect();
    assert!(parts.iter().all(|part| !part.is_whole && part.rows() <= whole.rows()));
    let rows = |file: &Contents| file.entities.get("/joints/j1_base_yaw").map_or(0, |f| f.rows);
    let counts: Vec<usize> = parts.iter().map(rows).collect();
    assert!(counts.is_sorted(), "{counts:?}");
    assert!(counts.iter().any(|n| (1..1500).contains(n)), "{counts:?}");
    assert_eq!(counts.last(), Some(&1500));
    let ends = parts.iter().map(|part| part.time_s().map_or(0.0, |[_, end]| end));
    let ends: Vec<f64> = ends.collect();
    assert!(ends.is_sorted() && ends.iter().any(|end| (1.0..2.9).contains(end)), "{ends:?}");
}

#[test]
fn a_file_that_holds_no_recording_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    let refused = |path: &Path| {
        let error = Contents::read(path).unwrap_err();
        assert!(matches!(error, RecordingError::Unreadable { .. }), "{error}");
        error.to_string()
    };
    refused(&path);
    for bytes in [&b""[..], b"RRF2", b"time_s,j1.position_rad\n0.0,0.1\n"] {
        std::fs::write(&path, bytes).unwrap();
        let said = refused(&path);
        assert!(said.contains("no recording can be read"), "{said}");
    }
}

#[test]
fn two_recordings_of_the_same_run_hold_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let files = ["a.rrd", "b.rrd"].map(|name| {
        record(&folder.path().join(name));
        Contents::read(&folder.path().join(name)).unwrap()
    });
    let text = |file: &Contents| format!("{:?}", file.entities);
    assert_eq!(text(&files[0]), text(&files[1]));
}

#[test]
fn rows_of_wrong_lengths_or_times_are_refused_and_leave_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let loaded = wam();
    let path = folder.path().join("run.rrd");
    let mut recorder = Recorder::create(&path, &scene(&loaded), Live::Off).unwrap();
    let (one, short) = ([0.0; 7], [0.0; 6]);
    let mut rows = |time_s: &[f64], arms: &[&[f64]], signals: &[&[f64]]| {
        recorder.rows(&RowBlock { time_s, arms, signals })
    };
    let all = [&one[..], &one, &one];
    let length = |thing: &str, items, found, expected| {
        Err(RecordingError::WrongLength { thing: thing.to_owned(), items, found, expected })
    };
    assert_eq!(rows(&[0.0], &all[..1], &all), length("a block of rows", "arms", 1, 2));
    assert_eq!(rows(&[0.0], &all[..2], &all[..2]), length("a block of rows", "signals", 2, 3));
    assert_eq!(rows(&[0.0], &[&one, &short], &all), length("arm desired", "numbers", 6, 7));
    let signals = [&one[..], &short, &one];
    assert_eq!(rows(&[0.0], &all[..2], &signals), length("signal measured", "numbers", 6, 7));
    for time_s in [f64::NAN, f64::INFINITY, 1e300] {
        let refused = rows(&[time_s], &all[..2], &all);
        assert!(matches!(refused, Err(RecordingError::TimeNotIncreasing { row: 0, .. })));
    }
    assert_eq!(rows(&[], &[&[], &[]], &[&[], &[], &[]]), Ok(()));
    assert_eq!(rows(&[1.0], &all[..2], &all), Ok(()));
    let again = RecordingError::TimeNotIncreasing { row: 0, time_s: 1.0, previous_s: 1.0 };
    assert_eq!(rows(&[1.0], &all[..2], &all), Err(again));
    let predicted =
        SceneSignal { quantity: SignalQuantity::Torque, name: "gp", role: SceneRole::Model(0) };
    let further = recorder.further(&[0.0], &[(predicted, &short)]);
    assert_eq!(further, length("signal gp", "numbers", 6, 7));
    let again = RecordingError::TimeNotIncreasing { row: 1, time_s: 0.0, previous_s: 0.0 };
    assert_eq!(recorder.further(&[0.0, 0.0], &[(predicted, &[0.0; 14])]), Err(again));
    let short = BarSeries { name: "gp", role: SceneRole::Model(0), values: &[1.0] };
    let bars = recorder.bars("RMSE", &[short]);
    assert_eq!(bars, length("bars RMSE, gp", "numbers", 1, 7));
    assert!(recorder.event(f64::NAN, EventLevel::Info, "never").is_err());
    assert_eq!(recorder.finish().unwrap().rows, 1);
}

#[test]
fn a_folder_that_is_not_there_is_an_error() {
    let loaded = wam();
    let created = Recorder::create(Path::new("no/such/run.rrd"), &scene(&loaded), Live::Off);
    assert!(matches!(created.err(), Some(RecordingError::Unwritable { .. })));
}

#[test]
fn two_arms_of_one_name_are_refused() {
    let loaded = wam();
    let mut scene = scene(&loaded);
    scene.arms[1].name = "measured";
    let created = Recorder::create(Path::new("never.rrd"), &scene, Live::Off);
    assert_eq!(created.err(), Some(RecordingError::NameTwice { name: "measured".to_owned() }));
}

/// Runs itself once more, in an environment that turns recordings off.
#[test]
fn a_recording_that_the_environment_turns_off_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    if std::env::var("RERUN").as_deref() == Ok("off") {
        let (loaded, path) = (wam(), folder.path().join("run.rrd"));
        let created = Recorder::create(&path, &scene(&loaded), Live::Off);
        let value = "off".to_owned();
        assert_eq!(created.err(), Some(RecordingError::TurnedOff { path: path.clone(), value }));
        assert!(!path.exists());
        return;
    }
    let own = "a_recording_that_the_environment_turns_off_is_an_error";
    let program = std::env::current_exe().unwrap();
    let run = Command::new(program).args(["--exact", own]).env("RERUN", "off").output().unwrap();
    let said = String::from_utf8_lossy(&run.stdout).into_owned();
    assert!(run.status.success() && said.contains("1 passed"), "{said}");
}

#[test]
fn the_programs_own_check_accepts_a_recording() {
    if Command::new("rerun").arg("--version").output().is_err() {
        println!("skipped: no program rerun is installed");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    record(&path);
    let check = Command::new("rerun").args(["rrd", "verify"]).arg(&path).output().unwrap();
    assert!(check.status.success(), "{}", String::from_utf8_lossy(&check.stderr));
}

/// A cart on a rail with a pole, both without shapes.
#[test]
fn links_without_shapes_are_sticks_and_slides_are_moved_along_their_axis() {
    let urdf = r#"<robot name="crane">
        <link name="base"/>
        <link name="cart"><inertial><mass value="1"/>
          <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
        <link name="pole"><inertial><origin xyz="0 0 -1"/><mass value="1"/>
          <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
        <joint name="rail" type="prismatic"><parent link="base"/><child link="cart"/>
          <origin xyz="0 0 2"/><axis xyz="1 0 0"/>
          <limit lower="-3" upper="3" effort="10" velocity="1"/></joint>
        <joint name="hinge" type="continuous"><parent link="cart"/><child link="pole"/>
          <origin xyz="0 0 -0.5"/><axis xyz="0 1 0"/></joint>
    </robot>"#;
    let robot = Robot::from_urdf(urdf).unwrap();
    let looks = robot::Looks { base: vec![], links: vec![vec![]; 2] };
    let signal =
        SceneSignal { quantity: SignalQuantity::Error, name: "error", role: SceneRole::Error };
    let arms = vec![Arm { name: "measured", role: SceneRole::Actual }];
    let scene = Scene { title: "crane", robot: &robot, looks: &looks, arms, signals: vec![signal] };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("crane.rrd");
    let mut recorder = Recorder::create(&path, &scene, Live::Off).unwrap();
    let q = [0.25, 0.0];
    recorder.rows(&RowBlock { time_s: &[0.0], arms: &[&q], signals: &[&[2e-3, 3e-3]] }).unwrap();
    recorder.finish().unwrap();
    let file = Contents::read(&path).unwrap();
    assert_eq!(file.entities["/joints/rail"].columns["error"], [[2.0]], "in mm");
    for entity in ["/cart/shapes/joint", "/cart/shapes/stick0", "/base/shapes/stick0"] {
        let found = file.entities.keys().any(|e| e.ends_with(entity));
        assert!(found, "{entity}: {:?}", file.entities.keys());
    }
    let [cart] = translations(&path, "/world/arms/measured/cart")[..] else { panic!("one pose") };
    let expected = [0.25, 0.0, 2.0];
    assert!(cart.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{cart:?}");
}

/// The places of a link in its parent.
fn translations(path: &Path, entity: &str) -> Vec<[f32; 3]> {
    let mut found = vec![];
    for message in DecoderApp::decode_lazy(BufReader::new(File::open(path).unwrap())) {
        let LogMsg::ArrowMsg(_, message) = message.unwrap() else { continue };
        let chunk = Chunk::from_arrow_msg(&message).unwrap();
        if chunk.entity_path().to_string() != entity {
            continue;
        }
        let key = rerun::Transform3D::descriptor_translation().component;
        found.extend(chunk.iter_slices::<[f32; 3]>(key).flat_map(<[_]>::to_vec));
    }
    found
}

/// Listens where viewers do, takes connections with `greet` and never reads.
fn with_listener(
    greet: fn(TcpStream) -> Option<TcpStream>,
) -> Option<(FinishedRecording, Duration)> {
    let listener = TcpListener::bind(("127.0.0.1", rerun::DEFAULT_SERVER_PORT)).ok()?;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    std::thread::spawn(move || {
        let connections = listener.incoming().map_while(Result::ok);
        connections.filter_map(greet).collect::<Vec<_>>()
    });
    let start = Instant::now();
    let written = record_to(&path, Live::On);
    let took = start.elapsed();
    let file = Contents::read(&path).unwrap();
    assert!(file.is_whole);
    let quiet = folder.path().join("quiet.rrd");
    record(&quiet);
    let text = |file: &Contents| format!("{:?}", file.entities);
    assert!(
        text(&file) == text(&Contents::read(&quiet).unwrap()),
        "the file holds what it holds without a viewer"
    );
    Some((written, took))
}

/// One listener at a time.
static PORT: Mutex<()> = Mutex::new(());

/// In a process of its own: a listener does not give its place back before it ends.
fn alone(name: &str, greet: fn(TcpStream) -> Option<TcpStream>) {
    if std::env::var("LISTENS").as_deref() != Ok(name) {
        let _turn = PORT.lock();
        let program = std::env::current_exe().unwrap();
        let mut command = Command::new(program);
        command.args(["--exact", name, "--nocapture"]).env("LISTENS", name);
        let run = command.output().unwrap();
        let said = String::from_utf8_lossy(&run.stdout).into_owned();
        assert!(run.status.success() && said.contains("1 passed"), "{said}");
        return;
    }
    let Some((written, took)) = with_listener(greet) else {
        println!("skipped: something listens there already");
        return;
    };
    assert!(matches!(written.listener, Listener::Viewer { .. }), "{written:?}");
    assert!(took < Duration::from_secs(60), "{took:?}");
}

#[test]
fn a_viewer_that_never_reads_neither_blocks_nor_harms_the_file() {
    alone("a_viewer_that_never_reads_neither_blocks_nor_harms_the_file", Some);
}

#[test]
fn a_viewer_that_closes_at_once_neither_blocks_nor_harms_the_file() {
    alone("a_viewer_that_closes_at_once_neither_blocks_nor_harms_the_file", |stream| {
        drop(stream);
        None
    });
}
