use std::io::Write;
use std::process::{Command, Output, Stdio};

use benchmark::{Maker, TimeCurve, TimePoint};
use serde::Deserialize;

/// Times the queries of other programs; see there.
const SCRIPT: &str = include_str!("../../../../gaussian_process/benches/peers_query.py");

/// Joints that the script is written for.
pub const JOINTS: usize = 7;

/// A line that the script prints.
#[derive(Deserialize)]
struct Line {
    peer: String,
    n: usize,
    microseconds_p50: f64,
}

/// The times of scikit-learn and NumPy for these numbers of points; a sentence where they
/// cannot be had.
pub fn measure(points: &[usize]) -> Result<Vec<TimeCurve>, String> {
    let output =
        run(points).map_err(|error| format!("no peers: python3 cannot be run ({error})"))?;
    let text = String::from_utf8_lossy(&output.stdout);
    let lines: Vec<Line> =
        text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    if lines.is_empty() {
        let said = String::from_utf8_lossy(&output.stderr);
        return Err(format!("no peers: {}", said.lines().last().unwrap_or("python3 said nothing")));
    }
    Ok(curves(lines))
}

fn run(points: &[usize]) -> std::io::Result<Output> {
    let mut child = Command::new("python3")
        .arg("-")
        .args(points.iter().map(usize::to_string))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    if let Some(mut script) = child.stdin.take() {
        script.write_all(SCRIPT.as_bytes())?;
    }
    child.wait_with_output()
}

/// The lines by peer, in the order of their first appearance.
fn curves(lines: Vec<Line>) -> Vec<TimeCurve> {
    let mut curves: Vec<TimeCurve> = Vec::new();
    for Line { peer, n, microseconds_p50 } in lines {
        let point = TimePoint { n, microseconds: microseconds_p50 };
        match curves.iter_mut().find(|curve| curve.name == peer) {
            Some(curve) => curve.points.push(point),
            None => curves.push(TimeCurve { name: peer, maker: Maker::Peer, points: vec![point] }),
        }
    }
    curves
}
