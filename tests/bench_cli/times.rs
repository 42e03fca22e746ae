use std::fs;

use serde_json::Value;

use crate::arm::{self, Gap};
use crate::program::run;

#[test]
fn every_model_is_timed_and_it_is_said_why_there_are_no_peers() {
    let folder = arm::folder(Gap::None);
    let answer = run(folder.path(), &["times", "--robot", "arm.urdf", "--out", "out"]);
    assert_eq!(answer.code, 0, "{}{}", answer.out, answer.err);
    assert!(answer.out.contains("no peers: they are timed for 7 joints only"), "{}", answer.out);
    let text = fs::read_to_string(folder.path().join("out/prediction_times.json")).unwrap();
    let times: Value = serde_json::from_str(&text).unwrap();
    let curves = times["curves"].as_array().unwrap();
    assert_eq!(curves.len(), 5);
    let last = |name: &str| {
        let curve = curves.iter().find(|curve| curve["name"] == name).unwrap();
        let point = curve["points"].as_array().unwrap().last().unwrap().clone();
        assert_eq!(point["n"], 30_000);
        point["microseconds"].as_f64().unwrap()
    };
    assert!(last("rbd") < last("gp") && last("gp") < last("rbd-kernel as in eq. 10"), "{times}");
    assert!(folder.path().join("out/figure1.svg").exists());
}
