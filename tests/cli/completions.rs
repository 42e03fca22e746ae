//! Completions of shells, and manual pages.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::program::run;

/// Whether a shell is there.
fn has(shell: &str) -> bool {
    Command::new(shell).arg("--version").output().is_ok()
}

fn completions(folder: &Path, shell: &str) -> String {
    let answer = run(folder, &["completions", shell]);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""), "{shell}");
    answer.out
}

#[test]
fn every_shell_is_told_every_command() {
    let folder = tempfile::tempdir().unwrap();
    for shell in ["bash", "zsh", "fish"] {
        let script = completions(folder.path(), shell);
        for command in ["diagnose", "robot", "export", "completions", "cutoff-hz"] {
            assert!(script.contains(command), "{shell}: {command} is missing");
        }
    }
    assert_eq!(run(folder.path(), &["completions", "tcsh"]).code, 2);
}

#[test]
fn bash_completes_a_command_and_an_option() {
    if !has("bash") {
        println!("skipped: there is no bash");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("plumbline.bash"), completions(folder.path(), "bash")).unwrap();
    let complete = |words: &str, at: u32| {
        let script = format!(
            "source ./plumbline.bash; COMP_WORDS=({words}); COMP_CWORD={at}; \
             _plumbline plumbline \"${{COMP_WORDS[{at}]}}\" \"${{COMP_WORDS[{}]}}\"; echo \"${{COMPREPLY[@]}}\"",
            at - 1
        );
        let output = Command::new("bash")
            .current_dir(folder.path())
            .args(["--norc", "-c", &script])
            .output()
            .unwrap();
        String::from_utf8(output.stdout).unwrap().trim().to_owned()
    };
    assert_eq!(complete("plumbline dia", 1), "diagnose");
    assert_eq!(complete("plumbline diagnose --cut", 2), "--cutoff-hz");
}

#[test]
fn every_command_has_a_manual_page() {
    let folder = tempfile::tempdir().unwrap();
    let answer = run(folder.path(), &["man", "--out", "man"]);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    let page = |name: &str| {
        let text = fs::read_to_string(folder.path().join("man").join(name)).unwrap();
        text.replace("\\-", "-")
    };
    assert!(page("plumbline.1").contains(".TH plumbline 1"), "{}", page("plumbline.1"));
    assert!(page("plumbline.1").contains("plumbline-diagnose(1)"), "{}", page("plumbline.1"));
    let diagnose = page("plumbline-diagnose.1");
    assert!(
        diagnose.contains(".TH plumbline-diagnose 1") && diagnose.contains("cutoff-hz"),
        "{diagnose}"
    );
    assert!(page("plumbline-robot-check.1").contains("consistency"));
    assert!(!folder.path().join("man/plumbline-help.1").exists());
    assert_eq!(run(folder.path(), &["man"]).code, 0);
    assert!(folder.path().join("out/man/plumbline.1").exists());
}
