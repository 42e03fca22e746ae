//! One friction hidden in an arm comes back from a file of any format as from the Parquet log.
//!
//! The files are written here by what other programs write them with, or byte by byte as the format says.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use catalogue::EffectKind;
use checks::arms::workspace_root;
use checks::lerobot::{self, Layout};
use diagnosis::{Diagnosis, Settings, Silent, diagnose};
use document::Document;
use logs::{Channels, ReadOptions, Run, read_run, recognise};
use mcap::records::MessageHeader;
use robot::{Loaded, Robot, TorqueSource};
use simulator::scenario::Scenario;
use zip::write::SimpleFileOptions;

use crate::hidden::STEP;

/// Every so many of a log's rows are kept: 125 or 250 a second.
const EVERY: usize = 4;

/// When a bag begins (ns).
const START_NS: i64 = 1_700_000_000_000_000_000;

/// An arm, and the friction that is hidden in it.
struct Case {
    arm: &'static str,
    joint: &'static str,
    level_nm: f64,
}

const CASES: [Case; 3] = [
    Case { arm: "ur5e", joint: "elbow_joint", level_nm: 8.0 },
    Case { arm: "panda", joint: "panda_joint4", level_nm: 3.0 },
    Case { arm: "so101", joint: "elbow_flex", level_nm: 0.15 },
];

/// Three runs of 8 s, times whole nanoseconds, of what all formats hold.
fn runs(case: &Case) -> Vec<Run> {
    let path = workspace_root().join(format!("scenarios/arms/{}.toml", case.arm));
    let mut document = Document::read(&path).unwrap();
    let motion = |k: u32| {
        format!(
            "{{ name = \"run_{k}\", motion.sinusoids = {{ seed = {k}, terms = 4, lowest_hz = 0.15, \
             highest_hz = 0.6, position_share = 0.5, duration_s = 8.0 }} }}"
        )
    };
    let effect = format!(
        "{{ coulomb_friction = {{ joint = \"{}\", level_nm = {} }} }}",
        case.joint, case.level_nm
    );
    for assignment in [
        STEP.to_owned(),
        "seed=1".to_owned(),
        format!("effect=[{effect}]"),
        format!("run=[{}, {}, {}]", motion(1), motion(2), motion(3)),
    ] {
        document.set(&assignment).unwrap();
    }
    let scenario = Scenario::from_document(&document).unwrap();
    let simulated = simulator::simulate(&scenario, &|| {}).unwrap().runs;
    simulated.into_iter().map(thinned).collect()
}

fn thinned(run: Run) -> Run {
    let of = |samples: &Vec<f64>| samples.iter().step_by(EVERY).copied().collect::<Vec<f64>>();
    let joint = |joint: &Channels| Channels {
        name: joint.name.clone(),
        position: of(&joint.position),
        velocity: joint.velocity.as_ref().map(of),
        effort: of(&joint.effort),
        ..Channels::default()
    };
    let start = run.time[0];
    let nanoseconds = of(&run.time).into_iter().map(|t| (1e9 * (t - start)).round());
    Run {
        time: nanoseconds.map(|ns| ns / 1e9).collect(),
        joints: run.joints.iter().map(joint).collect(),
        extra: BTreeMap::new(),
        ..run
    }
}

/// Samples of a channel, sample by sample, a number a joint.
fn rows<'a>(
    run: &'a Run,
    of: impl Fn(&'a Channels) -> &'a [f64] + 'a,
) -> impl Iterator<Item = Vec<f64>> + 'a {
    (0..run.time.len()).map(move |k| run.joints.iter().map(|joint| of(joint)[k]).collect())
}

fn position(joint: &Channels) -> &[f64] {
    &joint.position
}

fn velocity(joint: &Channels) -> &[f64] {
    joint.velocity.as_deref().unwrap()
}

fn effort(joint: &Channels) -> &[f64] {
    &joint.effort
}

/// Arrays of samples x joints, and their names to NumPy and MATLAB.
fn arrays(run: &Run) -> [(&'static str, Vec<Vec<f64>>); 4] {
    [
        ("time", run.time.iter().map(|t| vec![*t]).collect()),
        ("q", rows(run, position).collect()),
        ("dq", rows(run, velocity).collect()),
        ("tau", rows(run, effort).collect()),
    ]
}

fn npz(path: &Path, run: &Run) {
    let mut archive = zip::ZipWriter::new(File::create(path).unwrap());
    for (name, rows) in arrays(run) {
        let (samples, width) = (rows.len(), rows[0].len());
        let shape =
            if name == "time" { format!("({samples},)") } else { format!("({samples}, {width})") };
        let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}");
        let padded = format!("{header:<117}\n");
        archive.start_file(format!("{name}.npy"), SimpleFileOptions::default()).unwrap();
        archive.write_all(b"\x93NUMPY\x01\x00").unwrap();
        archive.write_all(&u16::try_from(padded.len()).unwrap().to_le_bytes()).unwrap();
        archive.write_all(padded.as_bytes()).unwrap();
        rows.iter().flatten().for_each(|x| archive.write_all(&x.to_le_bytes()).unwrap());
    }
    archive.finish().unwrap();
}

/// An element of a MAT-file of version 5, filled up to 8 bytes.
fn element(kind: u32, data: &[u8]) -> Vec<u8> {
    let length = u32::try_from(data.len()).unwrap();
    let filled = vec![0; data.len().next_multiple_of(8) - data.len()];
    [&kind.to_le_bytes(), &length.to_le_bytes(), data, &filled].concat()
}

fn mat(path: &Path, run: &Run) {
    const INT8: u32 = 1;
    const INT32: u32 = 5;
    const UINT32: u32 = 6;
    const DOUBLE: u32 = 9;
    const MATRIX: u32 = 14;
    const OF_DOUBLES: u32 = 6;
    let mut file = format!("{:<124}", "MATLAB 5.0 MAT-file, written by a test").into_bytes();
    file.extend([0x00, 0x01, b'I', b'M']);
    for (name, rows) in arrays(run) {
        let (samples, width) = (rows.len(), rows[0].len());
        let pair = |a: u32, b: u32| [a.to_le_bytes(), b.to_le_bytes()].concat();
        let shape = pair(u32::try_from(samples).unwrap(), u32::try_from(width).unwrap());
        let columns = (0..width).flat_map(|j| rows.iter().map(move |row| row[j]));
        let numbers: Vec<u8> = columns.flat_map(f64::to_le_bytes).collect();
        let array = [
            element(UINT32, &pair(OF_DOUBLES, 0)),
            element(INT32, &shape),
            element(INT8, name.as_bytes()),
            element(DOUBLE, &numbers),
        ];
        file.extend(element(MATRIX, &array.concat()));
    }
    fs::write(path, file).unwrap();
}

/// The messages `sensor_msgs/msg/JointState` of a run as CDR, each with the time of its stamp (ns).
fn messages(run: &Run) -> Vec<(i64, Vec<u8>)> {
    let names: Vec<&str> = run.joints.iter().map(|joint| joint.name.as_str()).collect();
    let (q, qd, tau) = (rows(run, position), rows(run, velocity), rows(run, effort));
    let channels = q.zip(qd).zip(tau).map(|((q, qd), tau)| [q, qd, tau]);
    let stamps = run.time.iter().map(|t| START_NS + (1e9 * t).round() as i64);
    let message = |(stamp, channels): (i64, [Vec<f64>; 3])| {
        let mut body = Vec::new();
        let (seconds, nanoseconds) = (stamp / 1_000_000_000, stamp % 1_000_000_000);
        body.extend(i32::try_from(seconds).unwrap().to_le_bytes());
        body.extend(u32::try_from(nanoseconds).unwrap().to_le_bytes());
        text(&mut body, "base");
        count(&mut body, names.len());
        names.iter().for_each(|name| text(&mut body, name));
        for values in channels {
            count(&mut body, values.len());
            body.resize(body.len().next_multiple_of(8), 0);
            values.iter().for_each(|x| body.extend(x.to_le_bytes()));
        }
        (stamp, [&[0, 1, 0, 0][..], &body].concat())
    };
    stamps.zip(channels).map(message).collect()
}

fn count(body: &mut Vec<u8>, count: usize) {
    body.resize(body.len().next_multiple_of(4), 0);
    body.extend(u32::try_from(count).unwrap().to_le_bytes());
}

fn text(body: &mut Vec<u8>, text: &str) {
    count(body, text.len() + 1);
    body.extend(text.as_bytes());
    body.push(0);
}

/// A bag in MCAP: the folder of it.
fn mcap_bag(folder: &Path, run: &Run) {
    fs::create_dir_all(folder).unwrap();
    fs::write(folder.join("metadata.yaml"), "rosbag2_bagfile_information:\n").unwrap();
    let file = File::create(folder.join("bag_0.mcap")).unwrap();
    let options = mcap::WriteOptions::new().profile("ros2").compression(None);
    let mut writer = options.create(std::io::BufWriter::new(file)).unwrap();
    let schema = writer.add_schema("sensor_msgs/msg/JointState", "ros2msg", b"").unwrap();
    let channel = writer.add_channel(schema, "/joint_states", "cdr", &BTreeMap::new()).unwrap();
    for (number, (stamp, data)) in messages(run).iter().enumerate() {
        let (sequence, time) = (u32::try_from(number).unwrap(), u64::try_from(*stamp).unwrap());
        let header =
            MessageHeader { channel_id: channel, sequence, log_time: time, publish_time: time };
        writer.write_to_known_channel(&header, data).unwrap();
    }
    writer.finish().unwrap();
}

/// Writes a database with the tables of rosbag2 from lines of time and message.
const DATABASE: &str = "
import sqlite3, sys
bag = sqlite3.connect(sys.argv[1])
bag.execute('CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, '
            'serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)')
bag.execute('CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, '
            'timestamp INTEGER NOT NULL, data BLOB NOT NULL)')
bag.execute(\"INSERT INTO topics VALUES(1, '/joint_states', 'sensor_msgs/msg/JointState', 'cdr', '')\")
for line in sys.stdin:
    time, message = line.split()
    bag.execute('INSERT INTO messages(topic_id, timestamp, data) VALUES(1, ?, ?)', (int(time), bytes.fromhex(message)))
bag.commit()
";

/// A bag in SQLite; whether Python with its own module for that is there.
fn sqlite_bag(path: &Path, run: &Run) -> bool {
    let python =
        Command::new("python3").args(["-c", DATABASE]).arg(path).stdin(Stdio::piped()).spawn();
    let Ok(mut python) = python else { return false };
    let mut lines = String::new();
    for (stamp, message) in messages(run) {
        let hexadecimal: String = message.iter().map(|byte| format!("{byte:02x}")).collect();
        lines += &format!("{stamp} {hexadecimal}\n");
    }
    let sent = python.stdin.take().unwrap().write_all(lines.as_bytes());
    python.wait().is_ok_and(|status| status.success()) && sent.is_ok()
}

/// A run as it is read from a file, or from an episode of a dataset, by a preset that is recognised.
fn read(path: &Path, robot: &Robot, episode: Option<u64>) -> Run {
    let asked = ReadOptions { episode, ..ReadOptions::default() };
    let found = recognise(path, robot, None, &asked).unwrap().map(|found| found.map);
    read_run(path, robot, &ReadOptions { map: found.as_ref(), ..asked }).unwrap()
}

/// The runs as each format gives them back, the Parquet log first.
fn read_back(folder: &Path, runs: &[Run], robot: &Robot) -> Vec<(&'static str, Vec<Run>)> {
    lerobot::write(&folder.join("dataset"), runs, Layout::OneFile, &[]);
    let file = |name: &str, run: &Run| -> PathBuf { folder.join(format!("{}_{name}", run.name)) };
    let each = |name: &str, write: &dyn Fn(&Path, &Run)| -> Vec<Run> {
        let one = |run: &Run| {
            let path = file(name, run);
            write(&path, run);
            read(&path, robot, None)
        };
        runs.iter().map(one).collect()
    };
    let parquet = |path: &Path, run: &Run| logs::write_parquet(path, run).unwrap();
    let episodes = (0..runs.len() as u64).map(|k| read(&folder.join("dataset"), robot, Some(k)));
    let mut all = vec![
        ("Parquet", each("parquet", &parquet)),
        ("rosbag2 in MCAP", each("mcap", &mcap_bag)),
        ("LeRobot", episodes.collect()),
        ("npz", each("npz", &npz)),
        ("mat", each("mat", &mat)),
    ];
    if runs.iter().all(|run| sqlite_bag(&file("db3", run), run)) {
        all.push(("rosbag2 in SQLite", each("db3", &|_, _| {})));
    } else {
        println!("skipped: rosbag2 in SQLite, python3 writes the database");
    }
    all
}

/// The efforts of scenarios/arms are commands, which the controller holds for one period.
fn diagnosed(loaded: &Loaded, runs: &[Run]) -> Diagnosis {
    let control_rate_hz = loaded.control.rate_hz;
    let settings = Settings { control_rate_hz, ..Settings::default() };
    let mut robot = loaded.robot.clone();
    for j in 0..robot.joint_count() {
        robot.link_mut(j).unwrap().actuator.torque_source = TorqueSource::Commanded;
    }
    diagnose(&robot, runs, &settings, &Silent).unwrap().diagnosis
}

#[test]
fn one_friction_comes_back_from_five_formats_as_from_the_parquet_log() {
    for (index, case) in CASES.iter().enumerate() {
        let folder = tempfile::tempdir().unwrap();
        let description = workspace_root().join(format!("robots/{}/robot.toml", case.arm));
        let loaded = Robot::load(&description).unwrap();
        let given = runs(case);
        let all = read_back(folder.path(), &given, &loaded.robot);
        for (format, runs) in &all {
            for (run, given) in runs.iter().zip(&given) {
                assert_eq!(run.time, given.time, "{format}, {}", case.arm);
                assert_eq!(run.joints, given.joints, "{format}, {}", case.arm);
            }
        }
        let expected = diagnosed(&loaded, &all[0].1);
        let [finding] = expected.findings.as_slice() else {
            panic!("{}: {:?}", case.arm, expected.findings)
        };
        assert_eq!(finding.at.effect, EffectKind::CoulombFriction, "{}", case.arm);
        assert_eq!(finding.at.joint.as_deref(), Some(case.joint));
        let found = finding.parameters[0].value;
        assert!((found / case.level_nm - 1.0).abs() < 0.1, "{}: {found} N·m", case.arm);
        // What is read is the same to the last bit, and so is the diagnosis: shown with one format an arm.
        let (format, runs) = &all[1 + index];
        let again = diagnosed(&loaded, runs);
        assert_eq!(again.findings[0].parameters, finding.parameters, "{format}");
        assert_eq!(again.findings.len(), 1, "{format}");
    }
}
