//! Column maps by pattern, and those of programs that are known.

use logs::{ColumnMap, LogError, ReadOptions, Run, read_run, recognise};
use robot::JointKind;

use crate::support::{Scratch, robot, two_joints};

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
