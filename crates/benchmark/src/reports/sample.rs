//! Samples that the tests of this folder share.

use pages::Provenance;
use quick_xml::Reader;
use quick_xml::events::Event;

use crate::reports::times::prediction_times::{Maker, PredictionTimes, TimeCurve, TimePoint};

/// Rigid bodies, a Gaussian process and a peer, which was not asked for many points.
pub fn times() -> PredictionTimes {
    let curve = |name: &str, maker, points: &[(usize, f64)]| TimeCurve {
        name: name.into(),
        maker,
        points: points.iter().map(|&(n, microseconds)| TimePoint { n, microseconds }).collect(),
    };
    PredictionTimes {
        robot: "arm".into(),
        joints: 7,
        machine: "a machine".into(),
        curves: vec![
            curve("rbd", Maker::Plumbline, &[(100, 1.1), (10_000, 1.1)]),
            curve("gp", Maker::Plumbline, &[(100, 3.2), (10_000, 900_000.0)]),
            curve("scikit-learn", Maker::Peer, &[(100, 830.0)]),
        ],
        remarks: vec!["numpy: not installed".into()],
        provenance: provenance(),
    }
}

/// A made-up command.
pub fn provenance() -> Provenance {
    Provenance {
        program: "plumbline-bench",
        version: "0.1.0",
        command: vec!["plumbline-bench".into(), "figure".into()],
        files: Vec::new(),
        seed: Some(1),
    }
}

/// The text between the tags of a well-formed document.
pub fn text_of_xml(xml: &str) -> String {
    let mut reader = Reader::from_str(xml);
    let mut text = String::new();
    loop {
        match reader.read_event().unwrap() {
            Event::Eof => return text,
            Event::Text(piece) => text.push_str(&piece.decode().unwrap()),
            _ => {}
        }
    }
}
