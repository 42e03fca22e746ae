//! Scripts of Python that answer a question: JSON in, JSON out.

use std::io::Write;
use std::process::{Command, Stdio};

/// Whether Python has MuJoCo; says that a test is skipped where it does not.
pub fn has_mujoco() -> bool {
    let found = Command::new("python3").args(["-c", "import mujoco"]).output();
    let has = found.is_ok_and(|output| output.status.success());
    if !has {
        println!("skipped: python3 has no mujoco, pip install mujoco brings it");
    }
    has
}

/// What `script` prints for a question; `refusal` is said where it fails.
pub fn ask(script: &str, question: &serde_json::Value, refusal: &str) -> String {
    let mut python = Command::new("python3")
        .args(["-c", script])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    python.stdin.take().unwrap().write_all(question.to_string().as_bytes()).unwrap();
    let output = python.wait_with_output().unwrap();
    assert!(output.status.success(), "{refusal}");
    String::from_utf8(output.stdout).unwrap()
}
