//! Column maps by pattern, and those of programs that are known.

use logs::{ColumnMap, LogError, ReadOptions, Run, file_overview, read_run, recognise};
use robot::JointKind;

use crate::support::{Scratch, golden, robot, two_joints};

const ROWS: &str = "0,1,2,3,4,5,6\n0.1,1.1,2.1,3.1,4.1,5.1,6.1\n";

fn read(header: &str, map: &str) -> Result<Run, LogError> {
    let file = Scratch::new("run.csv", format!("{header}\n{ROWS}"));
    let map = ColumnMap::load(&Scratch::new("map.toml", map).path)?;
    read_run(&file.path, &two_joints(), &ReadOptions { map: Some(&map), ..ReadOptions::default() })
}

/// Second joint's position, and the first one's effort, in the first row.
fn first(run: &Run) -> (f64, f64) {
    (run.joints[1].position[0], run.joints[0].effort[0])
}

#[test]
fn a_pattern_a_list_and_a_slice_say_the_same() {
    let header = "time,q[0],q[1],v0,v1,i[0],i[1]";
    for map in [
        "position = \"q[{i}]\"\neffort = \"i[{i}]\"\nvelocity = [\"v0\", \"v1\"]\n",
        "position = [\"q[0]\", \"q[1]\"]\neffort = \"i[0:2]\"\nvelocity = \"v{i}\"\n",
        "position = \"q[:]\"\neffort = { column = \"i[:2]\", scale = 1.0 }\n",
        "joints = [\"j2\", \"j1\"]\nposition = [\"q[1]\", \"q[0]\"]\neffort = [\"i[1]\", \"i[0]\"]\n",
        "position = \"q[:]\"\n[joint.j1]\neffort = \"i[0]\"\n[joint.j2]\neffort = \"i[1]\"\n",
    ] {
        let run = read(header, map).unwrap();
        assert_eq!(first(&run), (2.0, 5.0), "{map}");
    }
}

#[test]
fn a_joint_of_its_own_counts_more_than_a_pattern_and_factors_are_one_a_joint() {
    let header = "time,q0,q1,v0,v1,i0,i1";
    let map = "position = \"q{i}\"\neffort = { column = \"i{i}\", unit = \"raw\", scale = [10, 100] }\n\
               [joint.j2]\nposition = \"v0\"\n";
    let run = read(header, map).unwrap();
    assert_eq!(first(&run), (3.0, 50.0));
    assert_eq!(run.joints[1].effort[0], 600.0);
}

#[test]
fn mistakes_are_shown_where_they_stand() {
    let header = "time,q0,q1,v0,v1,i0,i1";
    let told = |map: &str| {
        let error = read(header, map).unwrap_err();
        let LogError::Map { problem } = &error else { panic!("{error}") };
        problem.render(document::Coloring::Plain)
    };
    for (map, line, message) in [
        ("position = \"q0\"\n", "map.toml:1:12", "one column for 2 joints"),
        ("\nposition = [\"q0\"]\n", "map.toml:2:12", "1 columns were found, 2 were expected"),
        ("effort = { column = \"i{i}\", scale = [1, 2, 3] }\n", "map.toml:1:10", "3 numbers"),
        ("effort = { column = \"i{i}\", scal = 1 }\n", "map.toml:1:29", "did you mean `scale`?"),
        ("effort = { column = \"i{i}\", scale = [1, 0] }\n", "map.toml:1:10", "found scale 0"),
        ("positon = \"q{i}\"\n", "map.toml:1:1", "did you mean `position`?"),
        ("position = 3\n", "map.toml:1:12", "a pattern of columns"),
    ] {
        let text = told(map);
        assert!(text.contains(line) && text.contains(message) && text.contains('^'), "{text}");
    }
}

fn found(header: &str, name: Option<&str>) -> Option<(&'static str, Run)> {
    let file = Scratch::new("run.csv", format!("{header}\n{ROWS}"));
    let arm = two_joints();
    let found = recognise(&file.path, &arm, name, &ReadOptions::default()).unwrap()?;
    let options = ReadOptions { map: Some(&found.map), ..ReadOptions::default() };
    Some((found.name, read_run(&file.path, &arm, &options).unwrap()))
}

#[test]
fn files_of_known_programs_are_recognised() {
    let ur =
        "timestamp,actual_q_0,actual_q_1,actual_qd_0,actual_qd_1,actual_current_0,actual_current_1";
    let franka = "time,q[0],q[1],dq[0],dq[1],tau_J[0],tau_J[1]";
    let named = "__time,/joint_states/j1/position,/joint_states/j2/position,a,b,\
                 /joint_states/j1/effort,/joint_states/j2/effort";
    for (header, name, step) in
        [(ur, "ur", 0.1), (franka, "franka", 1e-4), (named, "plotjuggler", 0.1)]
    {
        let (own, run) = found(header, None).unwrap();
        assert_eq!((own, first(&run)), (name, (2.0, 5.0)));
        assert!((run.time[1] - run.time[0] - step).abs() < 1e-12, "{:?}", run.time);
    }
}

/// What `rostopic echo -p` writes: names in every row, a header behind a percent sign, times in ns.
#[test]
fn a_list_of_joints_in_the_rows_names_the_columns() {
    let header = "%time,field.header.stamp,field.name0,field.name1,field.position0,field.position1,\
                  field.effort0,field.effort1";
    let file = |rows: &str| Scratch::new("run.csv", format!("{header}\n{rows}"));
    let rows = "17,1000000000,j2,j1,2,1,5,4\n18,1100000000,j2,j1,2.1,1.1,5.1,4.1\n";
    let arm = two_joints();
    let of = |rows: &str| {
        let file = file(rows);
        let found = recognise(&file.path, &arm, None, &ReadOptions::default()).unwrap().unwrap();
        let options = ReadOptions { map: Some(&found.map), ..ReadOptions::default() };
        (found.name, read_run(&file.path, &arm, &options).map_err(|e| file.told::<Run>(Err(e))))
    };
    let (name, run) = of(rows);
    let run = run.unwrap();
    assert_eq!((name, first(&run)), ("rostopic", (2.0, 4.0)));
    assert!((run.time[1] - run.time[0] - 0.1).abs() < 1e-6, "{:?}", run.time);
    // Another order of the joints in a later row.
    let told = of(&rows.replace("18,1100000000,j2,j1", "18,1100000000,j1,j2")).1.unwrap_err();
    assert!(told.contains("row 2, column field.name0: found j1, j2 was expected"), "{told}");
}

#[test]
fn joint_states_of_plotjuggler_may_be_under_any_topic() {
    let named = |topic: &str| {
        format!(
            "__time,{topic}/j1/position,{topic}/j2/position,a,b,{topic}/j1/effort,{topic}/j2/effort"
        )
    };
    for topic in ["/joint_states", "/ur/joint_states", "/left/arm/states"] {
        let (own, run) = found(&named(topic), None).unwrap();
        assert_eq!((own, first(&run)), ("plotjuggler", (2.0, 5.0)), "{topic}");
    }
    let other = named("/left").replace("/left/j2/position", "/right/j2/position");
    assert!(found(&other, None).is_none(), "joints of two topics");
    for strange in ["/a\"b", "/a\\b"] {
        let quoted = named(strange).replace('"', "\"\"").replace(',', "\",\"");
        assert!(found(&format!("\"{quoted}\""), None).is_none(), "{strange}");
    }
}

#[test]
fn vectors_of_fewer_joints_than_the_robot_has_are_told_with_both_counts() {
    let joints = ["j1", "j2", "finger"].map(|name| (name, JointKind::Revolute));
    let arm = robot(&joints);
    for (effort, words) in
        [("tau", "arrays q, dq and tau over time"), ("tau_J", "libfranka, time in ms")]
    {
        let header = format!("time,q[0],q[1],dq[0],dq[1],{effort}[0],{effort}[1]");
        let file = Scratch::new("run.csv", format!("{header}\n{ROWS}"));
        let refused = recognise(&file.path, &arm, None, &ReadOptions::default()).unwrap_err();
        assert_eq!(
            file.told::<Run>(Err(refused)),
            format!(
                "run.csv: it has the columns of 2 joints (q[{{i}}]; {words}), and the robot has 3 joints: j1, j2, finger"
            )
        );
    }
}

#[test]
fn what_is_usual_or_has_no_order_is_not_guessed() {
    assert!(found("time,j1.position,j2.position,q[0],q[1],tau_J[0],tau_J[1]", None).is_none());
    let vectors = "__time,/joint_states/position[0],/joint_states/position[1],a,b,\
                   /joint_states/effort[0],/joint_states/effort[1]";
    assert!(found(vectors, None).is_none());
    assert_eq!(found(vectors, Some("plotjuggler")).map(|(_, run)| first(&run)), Some((2.0, 5.0)));
    assert!(found("time,a,b,c,d,e,f", None).is_none());
}

/// A slice is of one joint as well, and a pattern of a slide has no unit of an angle.
#[test]
fn a_pattern_has_units_that_fit_every_joint() {
    let arm = robot(&[("turn", JointKind::Revolute), ("slide", JointKind::Prismatic)]);
    let map = "position = { column = \"q{i}\", unit = \"deg\" }\n";
    let map = ColumnMap::load(&Scratch::new("map.toml", map).path).unwrap();
    let message = map.for_robot(&arm).unwrap_err().to_string();
    assert!(message.contains("joint.slide.position: found the unit \"deg\""), "{message}");
}

/// The columns of every format, whatever they are called, and the map that fits them.
#[test]
fn a_file_is_told_by_its_columns() {
    let of = |name: &str, bytes: Vec<u8>| {
        let file = Scratch::new(name, bytes);
        file_overview(&file.path, &ReadOptions::default()).unwrap()
    };
    for name in [
        "hdf5_plain.h5",
        "matlab_plain.mat",
        "matlab73_plain.mat",
        "mcap_zstd.mcap",
        "numpy_plain.npz",
        "numpy_turned.npz",
        "numpy_columns.npy",
        "packed_log.csv.gz",
        "sqlite_bag.db3",
    ] {
        let overview = of(name, golden(name));
        assert!(overview.rows > 1, "{name}");
        let numbers = overview.columns.iter().filter(|column| column.range.is_some()).count();
        assert!(numbers > 2, "{name}: {:?}", overview.columns);
        assert!(overview.columns.iter().any(|column| column.rises_by.is_some()), "{name}");
    }
    let text = "t,q[0],q[1],qd[0],qd[1],tau[0],tau[1],note\n0,1,2,3,4,5,6,a\n0.1,1,2,3,4,5,6,b\n";
    let overview = of("run", text.into());
    let fitting = overview.fitting.unwrap();
    assert_eq!((fitting.name, fitting.count, fitting.joints.len()), ("numpy", 2, 0));
    let last = overview.columns.last().unwrap();
    assert_eq!((last.name.as_str(), last.range, last.rises_by), ("note", None, None));
    assert_eq!(overview.columns[0].range, Some((0.0, 0.1)));
    assert_eq!(of("run", "a,b\n1,2\n3,4\n".into()).fitting, None);
}
