use std::fs;
use std::path::Path;

use checks::arms::workspace_root;
use checks::book::can;

use crate::campaign::{done, folder, merged};
use crate::loopback_slurm::LoopbackSlurm;
use crate::program::{Answer, plumbline_bench, run};

/// Folder of the campaign, as a lab might have it.
const NAME: &str = "Ada's \"100%\" #1";

fn submit(slurm: &LoopbackSlurm, folder: &Path, parts: &str) -> String {
    let arguments = ["submit", NAME, "--engine", "slurm", "--parts", parts];
    let output =
        slurm.command(plumbline_bench()).current_dir(folder).args(arguments).output().unwrap();
    let answer: Answer = output.into();
    assert_eq!((answer.code, answer.err.as_str()), (0, ""), "{}\n{}", answer.out, slurm.logs());
    answer.out
}

/// Whether a worker is at a trial of a part of three: it has the lock, the shard is not there.
fn is_in_flight(folder: &Path, part: usize) -> bool {
    let is_begun = |task: &usize| folder.join(format!("work/{task:05}.lock")).exists();
    let is_made = |task: &usize| folder.join(format!("shards/{task:05}.parquet")).exists();
    [part - 1, part + 2].iter().any(|task| is_begun(task) && !is_made(task))
}

/// Stops the worker of a node when it is at a trial, and says at which part of the campaign.
fn caught_in_flight(slurm: &LoopbackSlurm, folder: &Path, node: &str) -> usize {
    let mut caught = None;
    slurm.wait(&format!("a trial in flight on {node}"), 60, |slurm| {
        let workers = slurm.processes(node);
        let part = workers.iter().find_map(|w| w.variable("SLURM_ARRAY_TASK_ID")?.parse().ok());
        let Some(part) = part.filter(|part| is_in_flight(folder, *part)) else { return false };
        workers.iter().for_each(|worker| worker.signal("STOP"));
        // It may have come to the end of the trial before it was stopped.
        if !is_in_flight(folder, part) {
            workers.iter().for_each(|worker| worker.signal("CONT"));
            return false;
        }
        caught = Some(part);
        true
    });
    caught.unwrap()
}

#[test]
fn a_cluster_that_loses_a_node_makes_what_one_machine_makes() {
    let Some(mut slurm) = LoopbackSlurm::start() else { return };
    let root = folder();
    let path = root.path();
    let lab = path.join(NAME);
    for name in ["here", NAME] {
        done(path, &["plan", "campaign.toml", "--out", name, "--quiet"]);
    }
    let said = submit(&slurm, path, "3");
    assert!(said.starts_with("6 trials left, in 3 tasks, submitted as job "), "{said}");
    let job = said.lines().find_map(|line| line.strip_prefix("  squeue -j ")).unwrap().to_owned();

    let part = caught_in_flight(&slurm, &lab, "n2");
    slurm.lose("n2");
    assert!(is_in_flight(&lab, part), "the lock and no shard are left");
    let task = format!("{job}_{part}");
    slurm.wait("n2 to count as lost", 120, |slurm| {
        slurm.ask("sinfo", &["-hn", "n2", "-o", "%T"]).starts_with("down")
    });
    slurm.wait("its task to be put back", 60, |slurm| slurm.fact(&task, "Restarts") == "1");
    done(path, &["work", "here", "--quiet"]);
    let whole = merged(path, "here");

    let parts = [1, 2, 3].map(|part| format!("{job}_{part}"));
    slurm.wait("the job to come to its end", 180, |slurm| {
        let goes_on = |state: String| ["PENDING", "RUNNING", "COMPLETING"].contains(&&*state);
        !parts.iter().any(|part| goes_on(slurm.fact(part, "JobState")))
    });
    for part in &parts {
        assert_eq!(slurm.fact(part, "JobState"), "COMPLETED", "{part}\n{}", slurm.logs());
        assert!(lab.join(format!("slurm/{part}.log")).is_file(), "{part}");
    }
    assert_eq!(slurm.fact(&task, "BatchHost"), "n1", "{}", slurm.logs());
    assert_eq!(merged(path, NAME), whole);
    assert_eq!(fs::read_dir(lab.join("work")).unwrap().count(), 0);
    assert_eq!(submit(&slurm, path, "3"), "0 trials left, nothing is submitted\n");
}

/// An entrant of CauseBench on two nodes: the same scores as here, and nothing left to submit.
#[test]
fn a_cluster_answers_a_set_as_one_machine_does() {
    if !can("python3", &["-c", ""]) {
        println!("no python3 here: the entrant is left out");
        return;
    }
    let Some(slurm) = LoopbackSlurm::start() else { return };
    let root = tempfile::tempdir().unwrap();
    let path = root.path();
    done(path, &["export", "--set", "smoke", "--first", "4", "--out", "set", "--quiet"]);
    let script = workspace_root().join("tests/benches/entrants/coulomb.py");
    let script = script.to_str().unwrap();
    let submit = || -> Answer {
        let arguments = ["submit", "set", "--answers", "two nodes", "--parts", "3", "--"];
        let command = ["python3", script, "set", "two nodes"];
        let mut program = slurm.command(plumbline_bench());
        program.current_dir(path).args(arguments).args(command).output().unwrap().into()
    };
    let answer = submit();
    assert_eq!((answer.code, answer.err.as_str()), (0, ""), "{}", slurm.logs());
    let said = answer.out;
    assert!(said.starts_with("4 trials left, in 3 tasks, submitted as job "), "{said}");
    assert!(said.ends_with("  plumbline-bench score set 'two nodes' --truth FILE\n"), "{said}");
    let job = said.lines().find_map(|line| line.strip_prefix("  squeue -j ")).unwrap();
    let parts = [1, 2, 3].map(|part| format!("{job}_{part}"));
    slurm.wait("the job to come to its end", 120, |slurm| {
        parts.iter().all(|part| slurm.fact(part, "JobState") == "COMPLETED")
    });
    let nodes = parts.each_ref().map(|part| slurm.fact(part, "BatchHost"));
    assert!(nodes.contains(&"n1".to_owned()) && nodes.contains(&"n2".to_owned()), "{nodes:?}");
    assert!(can(
        "python3",
        &[script, path.join("set").to_str().unwrap(), path.join("here").to_str().unwrap()]
    ));
    let scores = |answers: &str| {
        let score = ["score", "set", answers, "--truth", "set.truth.json", "--json"];
        let answer = run(path, &score);
        assert_eq!((answer.code, answer.err.as_str()), (0, ""), "{answers}");
        answer.out.replace(answers, "entrant")
    };
    assert_eq!(scores("two nodes"), scores("here"));
    assert_eq!(submit().out, "0 trials left, nothing is submitted\n");
}
