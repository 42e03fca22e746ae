//! Files that are read as a part of something else: datasets of LeRobot, bags of several files, meshes; and columns that
//! are called otherwise.

use std::fmt::Write as _;
use std::path::Path;

use checks::lerobot::{self, Layout};
use checks::mutated;
use logs::{ColumnMap, ReadOptions, read_run, recognise};
use rand_chacha::ChaCha8Rng;
use robot::Robot;

use super::logs_of_kinds::{self, ROBOT, golden, parse_with};
use super::robots::{self, changed_text};
use super::{Reader, tables};

/// Words of descriptions of datasets.
const JSON: &[&str] = &[
    "\"v2.1\"",
    "\"v3.0\"",
    "\"names\":",
    "\"observation.state\"",
    "\"data_path\": \"../../{chunk_index}\"",
    "null",
    "{",
    "}",
    "[",
    "]",
    "\\u0000",
    "\"",
    ",",
    ":",
];

/// A map with an entry of every form.
const MAP: &str = r#"time = { column = "t_ns", unit = "ns" }
joints = ["j1", "j2"]
position = "q_{i}"
velocity = ["dq_a", "dq_b"]
effort = { column = "i[0:2]", unit = "raw", scale = [0.12, 0.08] }
desired_position = "goal_{joint}"

[joint.j1]
position = { column = "q0", unit = "deg" }
"#;

/// As little of a robot as there can be beside a mesh.
const ONE_LINK: &str = r#"<robot name="a"><link name="base"><visual><geometry>
<mesh filename="part.stl" scale="1 1 1"/></geometry></visual></link><link name="arm"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="j" type="continuous"><parent link="base"/><child link="arm"/></joint></robot>"#;

/// Read alone: where they are used they name other files than their own.
pub fn readers() -> Vec<Reader> {
    let of = |name, file, words, seeds, change, parse| Reader {
        name,
        file,
        short: 0,
        seeds,
        parsed: None,
        change,
        read: parse,
        parse,
        words,
    };
    let binary = |bytes: &[u8], random: &mut ChaCha8Rng| mutated::bytes(bytes, random);
    vec![
        of("LeRobot", "data_2/meta/info.json", JSON, description, changed_text, dataset),
        of(
            "LeRobot episodes",
            "data_3/data/chunk-000/file-000.parquet",
            tables::PARQUET,
            episodes,
            tables::changed,
            |path| dataset(path.parent().unwrap()),
        ),
        of("bag of files", "bag/second.mcap", logs_of_kinds::BAG, bag, binary, |path| {
            parse_with(path.parent().unwrap(), &ReadOptions::default())
        }),
        of("rostopic", "run.csv", logs_of_kinds::TEXT, rostopic, changed_text, |path| {
            let asked = ReadOptions::default();
            let found = recognise(path, &ROBOT, Some("rostopic"), &asked);
            let map = found.map_err(|e| e.to_string())?.map(|found| found.map);
            parse_with(path, &ReadOptions { map: map.as_ref(), ..asked })
        }),
        of(
            "map",
            "map.toml",
            robots::TOML,
            |_| vec![MAP.as_bytes().to_vec()],
            changed_text,
            |path| {
                let map = ColumnMap::load(path).map_err(|e| e.to_string())?;
                map.for_robot(&ROBOT).map(drop).map_err(|e| e.to_string())
            },
        ),
        of(
            "mesh",
            "part.stl",
            &["solid a\n", "facet normal 0 0 1\n", "glTF"],
            mesh,
            binary,
            |path| {
                Robot::load(&path.with_file_name("mesh.urdf")).map(drop).map_err(|e| e.to_string())
            },
        ),
    ]
}

/// Two episodes of a tenth of a second in a folder.
fn write_dataset(folder: &Path, layout: Layout) {
    let path = folder.join("short.csv");
    std::fs::write(&path, logs_of_kinds::rows(12)).unwrap();
    let run = read_run(&path, &ROBOT, &ReadOptions::default()).unwrap();
    lerobot::write(folder, &[run.clone(), run], layout, &[logs::Channel::Velocity]);
}

fn description(folder: &Path) -> Vec<Vec<u8>> {
    let folder = folder.join("data_2");
    std::fs::create_dir(&folder).unwrap();
    write_dataset(&folder, Layout::FileAnEpisode);
    vec![std::fs::read(folder.join("meta/info.json")).unwrap()]
}

fn episodes(folder: &Path) -> Vec<Vec<u8>> {
    let folder = folder.join("data_3");
    std::fs::create_dir(&folder).unwrap();
    write_dataset(&folder, Layout::OneFile);
    vec![std::fs::read(folder.join("data/chunk-000/file-000.parquet")).unwrap()]
}

/// The first episode of the dataset that the description, or another file beside it, is of.
fn dataset(path: &Path) -> Result<(), String> {
    let folder = path.parent().and_then(Path::parent).unwrap();
    let asked = ReadOptions { episode: Some(0), ..ReadOptions::default() };
    let found = recognise(folder, &ROBOT, Some("lerobot"), &asked).map_err(|e| e.to_string())?;
    let map = found.map(|found| found.map);
    parse_with(folder, &ReadOptions { map: map.as_ref(), ..asked })
}

/// The first file stays as it is.
fn bag(folder: &Path) -> Vec<Vec<u8>> {
    let bag = folder.join("bag");
    std::fs::create_dir(&bag).unwrap();
    std::fs::write(bag.join("metadata.yaml"), "rosbag2_bagfile_information:\n").unwrap();
    let [first, second] = ["mcap_0_to_2.mcap", "mcap_3_to_4.mcap"].map(|name| golden(&[name]));
    std::fs::write(bag.join("first.mcap"), &first[0]).unwrap();
    second
}

/// What `rostopic echo -p` writes: names in every row, a header behind a percent sign, times in ns.
fn rostopic(_: &Path) -> Vec<Vec<u8>> {
    let mut text =
        "%time,field.header.stamp,field.name0,field.name1,field.position0,field.position1,\
                    field.effort0,field.effort1\n"
            .to_owned();
    for k in 0..12 {
        let (q, tau) = (f64::from(k).sin(), f64::from(k).cos());
        writeln!(text, "{k},{}000000,j2,j1,{q:.4},{tau:.4},{tau:.3},{q:.3}", 1000 + 10 * k)
            .unwrap();
    }
    vec![text.into_bytes()]
}

fn mesh(folder: &Path) -> Vec<Vec<u8>> {
    std::fs::write(folder.join("mesh.urdf"), ONE_LINK).unwrap();
    let text =
        b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n\
                 endloop\nendfacet\nendsolid a\n";
    let binary = [&[0; 80][..], &1u32.to_le_bytes(), &[0; 50]].concat();
    vec![text.to_vec(), binary]
}
