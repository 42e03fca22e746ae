//! Bags of ROS 2 in MCAP and in SQLite.

use std::fs;
use std::path::Path;

use logs::{ReadOptions, Run, read_run, read_run_until_damage};
use robot::JointKind;
use tempfile::TempDir;

use crate::kinds::given;
use crate::support::{Scratch, assert_golden, golden, robot, two_joints};

const MCAP: [&str; 4] =
    ["mcap_zstd.mcap", "mcap_lz4.mcap", "mcap_none.mcap", "mcap_big_endian.mcap"];

/// The second has rows that go on in further pages, and a tree of three floors.
const SQLITE: [&str; 2] = ["sqlite_bag.db3", "sqlite_small_pages.db3"];

fn of_topic(name: &str, topic: Option<&str>) -> Result<Run, String> {
    let file = Scratch::new("run", golden(name));
    let options = ReadOptions { topic, ..ReadOptions::default() };
    read_run(&file.path, &two_joints(), &options).map_err(|error| file.told::<Run>(Err(error)))
}

#[test]
fn joint_states_are_read_by_the_names_in_every_message() {
    for name in MCAP.into_iter().chain(SQLITE) {
        let run = of_topic(name, None).unwrap();
        assert_golden(&run);
        assert_eq!(run.joints[1].velocity.as_deref(), Some(&[2.0; 5][..]), "{name}");
        assert!(run.extra.is_empty());
    }
}

#[test]
fn the_only_topic_is_read_and_one_of_several_is_asked_for() {
    assert_golden(&of_topic("mcap_one_topic.mcap", None).unwrap());
    assert_golden(&of_topic("mcap_two_topics.mcap", Some("/right/states")).unwrap());
    assert_eq!(
        of_topic("mcap_two_topics.mcap", None).unwrap_err(),
        "run: it has joint states on /left/states, /right/states and none on /joint_states; \
         the topic of the robot must be given"
    );
    assert_eq!(
        of_topic("mcap_one_topic.mcap", Some("/arm")).unwrap_err(),
        "run: there are no joint states on the topic /arm; it has \
         /arm/joint_states (sensor_msgs/msg/JointState, cdr), /note (std_msgs/msg/String, cdr)"
    );
}

/// Recorded where no topic has joint states: the feedback is the motion, the efforts are those of the feedback or else
/// of the output.
#[test]
fn the_state_of_a_trajectory_controller_is_read_in_either_layout() {
    for name in ["mcap_controller.mcap", "mcap_controller_old.mcap"] {
        let run = of_topic(name, None).unwrap();
        assert_golden(&run);
        let desired: Vec<f64> = run.joints[1].position.iter().map(|q| q + 0.5).collect();
        assert_eq!(run.joints[1].desired_position.as_ref(), Some(&desired), "{name}");
        assert_eq!(run.joints[1].velocity.as_deref(), Some(&[2.0; 5][..]), "{name}");
        assert_golden(&of_topic(name, Some("/controller/state")).unwrap());
    }
}

#[test]
fn joint_states_in_json_are_read_with_their_stamps_or_the_time_of_recording() {
    for name in ["mcap_json.mcap", "mcap_json_listed.mcap", "mcap_json_no_stamp.mcap"] {
        let run = of_topic(name, None).unwrap();
        assert_golden(&run);
        assert_eq!(run.joints[0].velocity.as_deref(), Some(&[2.0; 5][..]), "{name}");
    }
    let told = of_topic("mcap_json_other.mcap", None).unwrap_err();
    let expected = "run: message 1 of /joint_states cannot be read: it is no joint state in JSON: invalid type";
    assert!(told.starts_with(expected), "{told}");
}

#[test]
fn joints_that_no_message_holds_are_told() {
    let arm = robot(&[("j1", JointKind::Revolute), ("finger", JointKind::Revolute)]);
    assert_eq!(
        Scratch::new("run", golden("mcap_none.mcap")).message(&arm),
        "run: joint finger has no effort: there is no column finger.effort; \
         its columns are time, j1.position, j2.position, j1.velocity, j2.velocity, j1.effort, j2.effort, finger.position"
    );
    let names = ["j1", "j3"].map(|name| (name, JointKind::Revolute));
    let told = Scratch::new("run", golden("mcap_none.mcap")).message(&robot(&names));
    assert!(told.ends_with("the log has j1, j2, finger"), "{told}");
}

#[test]
fn a_message_that_cannot_be_used_is_told_with_its_number() {
    assert_eq!(
        of_topic("mcap_apart.mcap", None).unwrap_err(),
        "run: message 1 of /joint_states holds joints of the robot, but no j2.position"
    );
    assert_eq!(
        of_topic("mcap_short_message.mcap", None).unwrap_err(),
        "run: message 2 of /joint_states cannot be read: it is cut off, or of another type"
    );
}

fn bag(files: &[(&str, &str)]) -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("metadata.yaml"), "rosbag2_bagfile_information:\n").unwrap();
    for (name, content) in files {
        fs::write(folder.path().join(name), golden(content)).unwrap();
    }
    folder
}

fn read(path: &Path) -> Result<Run, String> {
    let told = |e: logs::LogError| e.to_string().replace(&path.display().to_string(), "bag");
    read_run(path, &two_joints(), &ReadOptions::default()).map_err(told)
}

#[test]
fn a_folder_is_a_run_of_its_files_in_their_order() {
    let folder = bag(&[("arm_10.mcap", "mcap_3_to_4.mcap"), ("arm_9.mcap", "mcap_0_to_2.mcap")]);
    let run = read(folder.path()).unwrap();
    assert_golden(&run);
    assert_eq!(run.name, folder.path().file_stem().unwrap().to_str().unwrap());
    let turned = bag(&[("arm_9.mcap", "mcap_3_to_4.mcap"), ("arm_10.mcap", "mcap_0_to_2.mcap")]);
    let told = read(turned.path()).unwrap_err();
    assert!(told.contains("it must increase from row to row"), "{told}");
    let of = |folder: &TempDir| read(folder.path()).unwrap_err();
    let expected = "bag: this is a bag without a file of messages; one of .mcap or .db3 was expected beside metadata.yaml";
    assert_eq!(of(&bag(&[])), expected);
    let other = bag(&[("arm_0.mcap", "packed_log.csv.gz")]);
    let expected =
        "bag/arm_0.mcap: this is CSV or another kind of log; in a bag MCAP or SQLite was expected";
    assert_eq!(of(&other), expected);
}

#[test]
fn a_cut_file_is_told() {
    for name in MCAP {
        let bytes = golden(name);
        for cut in (8..bytes.len()).step_by(3) {
            let told = Scratch::new("run", &bytes[..cut]).message(&two_joints());
            assert!(told.contains("not a whole MCAP file"), "{name} cut at {cut}: {told}");
        }
    }
}

/// Behind the messages lie an index and free pages, which are not read.
#[test]
fn a_database_of_a_bag_that_is_cut_off_is_told_and_read_up_to_there() {
    for name in SQLITE {
        let bytes = golden(name);
        let (mut refused, mut partly) = (0, 0);
        for cut in (16..bytes.len()).step_by(211) {
            let file = Scratch::new("run", &bytes[..cut]);
            match file.read(&two_joints()) {
                Ok(run) => assert_golden(&run),
                Err(error) => {
                    let told = error.to_string();
                    assert!(
                        told.contains("not a whole SQLite file"),
                        "{name} cut at {cut}: {told}"
                    );
                    refused += 1;
                }
            }
            let until = read_run_until_damage(&file.path, &two_joints(), &ReadOptions::default());
            partly +=
                usize::from(until.is_ok_and(|(run, damage)| {
                    damage.is_some() && (2..5).contains(&run.time.len())
                }));
        }
        assert!(refused > 20 && partly > 0, "{name}: {refused} refused, {partly} read in part");
    }
}

/// The statement of the messages, each as long as the one that rosbag2 writes.
#[test]
fn columns_in_quotes_and_commas_in_parentheses_are_those_of_a_bag() {
    let bag = golden("sqlite_bag.db3");
    let at = bag.windows(25).position(|bytes| bytes == b"topic_id INTEGER NOT NULL").unwrap();
    for column in
        [b"\"topic_id\" CHECK (1, 2)  ", b"[topic_id] DEFAULT ('a,')", b"`topic_id` /* a, b */ INT"]
    {
        let mut bag = bag.clone();
        bag[at..][..25].copy_from_slice(&column[..]);
        assert_golden(&Scratch::new("run.db3", bag).read(&two_joints()).unwrap());
    }
}

#[test]
fn a_database_that_is_no_bag_or_lacks_its_last_messages_is_told() {
    assert_eq!(
        of_topic("sqlite_other.db3", None).unwrap_err(),
        "run: this is a SQLite database; a bag of ROS 2 was expected, with the tables topics and messages"
    );
    let file = Scratch::new("run.db3", golden("sqlite_bag.db3"));
    fs::write(file.path.with_file_name("run.db3-wal"), []).unwrap();
    assert_golden(&file.read(&two_joints()).unwrap());
    fs::write(file.path.with_file_name("run.db3-wal"), [1]).unwrap();
    let told = file.message(&two_joints());
    assert!(told.ends_with("sqlite3 FILE 'pragma wal_checkpoint(truncate)' puts it in"), "{told}");
    assert_eq!(
        of_topic("sqlite_bag.db3", Some("/note")).unwrap_err(),
        "run: there are no joint states on the topic /note; it has \
         /joint_states (sensor_msgs/msg/JointState, cdr), /note (std_msgs/msg/String, cdr)"
    );
}

#[test]
fn a_bag_that_was_made_to_be_large_is_refused() {
    let told = of_topic("mcap_bomb.mcap", None).unwrap_err();
    assert!(told.starts_with("run: unpacked it takes more than the"), "{told}");
}

#[test]
fn a_given_bag_is_read() {
    let joints = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"]
        .map(|name| (format!("{name}_joint"), JointKind::Revolute));
    let arm = robot(&joints.each_ref().map(|(name, kind)| (name.as_str(), *kind)));
    for name in ["bag_mcap", "bag_mcap/bag_mcap.mcap", "bag_sqlite3", "bag_sqlite3/bag_sqlite3.db3"]
    {
        let Some(path) = given(name) else { return };
        let run = read_run(&path, &arm, &ReadOptions::default()).unwrap();
        assert_eq!(run.time.len(), 300);
        assert!((run.joints[0].position[1] - 1.449495).abs() < 1e-6);
        assert!((run.time[1] - 0.008).abs() < 1e-12);
    }
}
