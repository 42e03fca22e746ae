use std::fs;
use std::path::Path;
use std::process::Command;

use crate::arm;
use crate::campaign::{done, folder, merged, shards};
use crate::program::{Answer, plumbline_bench};

/// A copy that can be run, made by another process: this one may be forked while a file is open.
fn install(from: &Path, to: &Path) {
    let copied = Command::new("install").args(["-D", "-m", "755"]).arg(from).arg(to).status();
    assert!(copied.unwrap().success(), "{}", to.display());
}

/// Submits with this program as the only one on the PATH, a script for a shell.
fn submit(folder: &Path, sbatch: Option<&str>, arguments: &[&str]) -> Answer {
    let bin = folder.join("bin");
    let _ = fs::remove_dir_all(&bin);
    fs::create_dir(&bin).unwrap();
    if let Some(sbatch) = sbatch {
        arm::write(folder, "sbatch.txt", &format!("#!/bin/sh\n{sbatch}\n"));
        install(&folder.join("sbatch.txt"), &bin.join("sbatch"));
    }
    let mut command = plumbline_bench();
    let all = [&["submit"], arguments].concat();
    command.current_dir(folder).env("PATH", &bin).args(all).output().unwrap().into()
}

/// A stand-in for Slurm that keeps what it was told.
const TAKES_ALL: &str = "printf '%s\\n' \"$@\" > told; echo 17";

#[test]
fn what_is_left_decides_what_is_submitted() {
    let folder = folder();
    let path = folder.path();
    done(path, &["plan", "campaign.toml", "--out", "a"]);
    let more = ["a", "--sbatch", "--partition=short", "--sbatch", "--comment=a lab's #1"];
    let answer = submit(path, Some(TAKES_ALL), &more);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    assert_eq!(
        answer.out,
        "6 trials left, in 6 tasks, submitted as job 17. To see how it goes on:\n  \
         squeue -j 17\n  plumbline-bench status a\nAt the end:\n  plumbline-bench merge a\n"
    );
    assert_eq!(fs::read_to_string(path.join("told")).unwrap(), "--parsable\na/slurm/job.sh\n");
    let root = fs::canonicalize(path).unwrap().join("a");
    let script = || fs::read_to_string(path.join("a/slurm/job.sh")).unwrap();
    let all = script();
    let expected = [
        "#SBATCH --array=1-6",
        "#SBATCH --cpus-per-task=1",
        "#SBATCH --requeue",
        "#SBATCH --open-mode=append",
        &format!("#SBATCH --output={}/slurm/%A_%a.log", root.display()),
        "#SBATCH --partition=short",
        "#SBATCH \"--comment=a lab's #1\"",
    ];
    let mut lines = all.lines();
    assert!(lines.next() == Some("#!/bin/sh") && expected.iter().all(|e| lines.any(|l| l == *e)));
    let work = format!("work {} --part \"$SLURM_ARRAY_TASK_ID/100\"", root.display());
    assert!(all.contains(&work) && all.ends_with(" --jobs 1 --quiet\n"), "{all}");

    done(path, &["work", "a", "--part", "2/3", "--quiet"]);
    let more = ["a", "--engine", "slurm", "--parts", "3", "--jobs", "2", "--dry-run"];
    fs::remove_file(path.join("told")).unwrap();
    let answer = submit(path, Some(TAKES_ALL), &more);
    let expected = "4 trials left, in 2 tasks. To submit them:\n  sbatch a/slurm/job.sh\n";
    assert_eq!((answer.code, answer.out.as_str()), (0, expected));
    let some = script();
    for expected in ["--array=1,3\n", "--cpus-per-task=2\n", "ID/3\" --jobs 2 --quiet\n"] {
        assert!(some.contains(expected), "{expected} is missing in\n{some}");
    }

    done(path, &["work", "a", "--quiet"]);
    let answer = submit(path, Some(TAKES_ALL), &["a"]);
    assert_eq!((answer.code, answer.out.as_str()), (0, "0 trials left, nothing is submitted\n"));
    assert!(!path.join("told").exists() && script() == some);
}

/// A job with such names is run by a shell; Slurm itself reads it in the test beside this one.
#[test]
fn a_name_in_a_job_is_data() {
    let folder = folder();
    let path = folder.path();
    let name = "it's a \"lab\" $(touch canary); touch canary #1 100%A `touch canary`";
    done(path, &["plan", "campaign.toml", "--out", name]);
    let program = path.join("bin of\n'all'").join(name).join("plumbline-bench");
    install(Path::new(env!("CARGO_BIN_EXE_plumbline-bench")), &program);
    let submit = |program: &Path, folder: &str| -> Answer {
        let arguments = ["submit", folder, "--parts", "2", "--dry-run"];
        Command::new(program).current_dir(path).args(arguments).output().unwrap().into()
    };
    let answer = submit(&program, name);
    assert_eq!(answer.code, 2);
    assert!(answer.err.contains("a path in UTF-8 without line breaks"), "{}", answer.err);
    assert!(!path.join(name).join("slurm").exists());

    let better = path.join(name).join("plumbline-bench");
    fs::rename(program, &better).unwrap();
    let answer = submit(&better, name);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    let job = path.join(name).join("slurm/job.sh");
    for task in ["1", "2"] {
        let mut sh = Command::new("sh");
        let output = sh.current_dir(path).arg(&job).env("SLURM_ARRAY_TASK_ID", task).output();
        let output = output.unwrap();
        assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
    }
    assert_eq!(shards(&path.join(name)).len(), 6);
    let root = fs::canonicalize(path).unwrap();
    let expected = format!(
        "#SBATCH \"--output={}/it's a \\\"lab\\\" $(touch canary); touch canary #1 100%%A \
         `touch canary`/slurm/%A_%a.log\"",
        root.display()
    );
    let script = fs::read_to_string(&job).unwrap();
    assert!(script.lines().any(|line| line == expected), "{script}");
    for place in [path, &path.join(name), &path.join(name).join("slurm")] {
        assert!(!place.join("canary").exists(), "{}", place.display());
    }
    done(path, &["plan", "campaign.toml", "--out", "a"]);
    done(path, &["work", "a"]);
    assert_eq!(merged(path, name), merged(path, "a"));
}

#[test]
fn what_cannot_be_submitted_is_said_and_the_job_stays() {
    let folder = folder();
    let path = folder.path();
    done(path, &["plan", "campaign.toml", "--out", "a"]);
    let refused = "echo 'sbatch: error: invalid partition specified: short' >&2; exit 1";
    let cases = [
        (None, "sbatch: it cannot be started ("),
        (
            Some(refused),
            "a/slurm/job.sh: sbatch does not take it: sbatch: error: invalid partition",
        ),
        (Some("exit 3"), "a/slurm/job.sh: sbatch does not take it: exit status: 3"),
        (Some("echo gone"), "a/slurm/job.sh: sbatch said \"gone\\n\", the number of a job was"),
    ];
    for (sbatch, expected) in cases {
        let answer = submit(path, sbatch, &["a"]);
        assert_eq!((answer.code, answer.out.as_str()), (2, ""), "{}", answer.err);
        assert!(answer.err.starts_with(&format!("error: {expected}")), "{}", answer.err);
        let helps = answer.err.contains("submit it with sbatch from a machine of the cluster");
        assert_eq!(helps, sbatch.is_none(), "{}", answer.err);
        assert!(path.join("a/slurm/job.sh").is_file());
        fs::remove_dir_all(path.join("a/slurm")).unwrap();
    }

    done(path, &["plan", "campaign.toml", "--out", "back\\slash"]);
    let cases: [(&[&str], i32, &str); 5] = [
        (&["back\\slash"], 2, "without line breaks and backslashes was expected"),
        (&["nowhere"], 3, "nowhere: no campaign was planned here"),
        (&["a", "--sbatch", "-p short"], 2, "in one piece, such as --partition=short"),
        (&["a", "--engine", "ray"], 2, "[possible values: slurm]"),
        (&["a", "--parts", "0"], 2, "--parts"),
    ];
    for (arguments, code, expected) in cases {
        let answer = submit(path, Some(TAKES_ALL), arguments);
        assert_eq!((answer.code, answer.out.as_str()), (code, ""), "{}", answer.err);
        assert!(answer.err.contains(expected), "{}", answer.err);
        assert!(!path.join("told").exists() && !path.join(arguments[0]).join("slurm").exists());
    }
}
