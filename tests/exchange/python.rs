//! Scripts of Python that answer a question: JSON in, JSON out.

use std::io::Write;
use std::process::{Command, Stdio};

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
