use std::fs;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, Instant};

use benchmark::Record;

use crate::arm::{self, Gap};
use crate::campaign::{CAMPAIGN, SCENARIO, done, folder, merged, shards, trials, without_costs};
use crate::program::{Answer, plumbline_bench, run};

#[test]
fn a_campaign_is_planned_made_and_merged() {
    let folder = folder();
    let path = folder.path();
    let out = done(path, &["plan", "campaign.toml", "--out", "a"]);
    assert!(
        out.starts_with(
            "6 trials, 2 of each kind:\nclean, coulomb_friction, rotor_inertia+payload"
        ),
        "{out}"
    );
    let status = trials(path, &["status", "a"]);
    assert_eq!(status.code, 1);
    assert!(
        status.out.contains(" all                       0       0       0     6\n"),
        "{}",
        status.out
    );
    assert!(status.out.contains("6 of 6 trials are left to make"), "{}", status.out);
    assert_eq!(done(path, &["work", "a", "--jobs", "2"]), "6 trials made; 0 left\n");
    assert_eq!(done(path, &["work", "a"]), "0 trials made; 0 left\n");
    let status = done(path, &["status", "a"]);
    assert!(status.contains(" all                       6       0       0     0\n"), "{status}");

    let text = done(path, &["merge", "a"]);
    for expected in ["FR02 Coulomb friction", "IN01 payload", "visible causes 2-3"] {
        assert!(text.contains(expected), "{expected} is missing in\n{text}");
    }
    let records = Record::read(&path.join("a/trials.parquet")).unwrap();
    assert_eq!(records.iter().map(|record| record.task).collect::<Vec<_>>(), [0, 1, 2, 3, 4, 5]);
    let causes = records.iter().map(|record| record.judgement().unwrap().causes.len());
    assert_eq!(causes.collect::<Vec<_>>(), [0, 1, 2, 0, 1, 2]);
    let whole = merged(path, "a");
    let json = &whole.1;
    assert_eq!(json["schema"], "plumbline.panel/2");
    assert_eq!(json["counts"].as_array().unwrap().len(), 4);
    assert!(fs::metadata(path.join("a/report.html")).unwrap().len() < 2_000_000);
    assert_eq!(fs::read_dir(path.join("a/work")).unwrap().count(), 0);
    // The campaign can be planned again, wherever its scenario has gone.
    fs::remove_file(path.join("scenario.toml")).unwrap();
    done(path, &["plan", "a/campaign.toml", "--out", "a"]);
    assert_eq!(merged(path, "a"), whole);
}

#[test]
fn jobs_parts_order_and_a_kill_make_no_difference() {
    let folder = folder();
    let path = folder.path();
    for name in ["a", "b", "c"] {
        done(path, &["plan", "campaign.toml", "--out", name, "--quiet"]);
    }
    assert_eq!(done(path, &["work", "a", "--jobs", "3", "--quiet"]), "");
    let whole = merged(path, "a");

    done(path, &["work", "b", "--part", "2/2", "--jobs", "1", "--quiet"]);
    assert_eq!(shards(&path.join("b")).len(), 3);
    done(path, &["work", "b", "--part", "1/2", "--keep", "--quiet"]);
    assert_eq!(merged(path, "b"), whole);
    assert_eq!(fs::read_dir(path.join("b/logs")).unwrap().count(), 3, "of the part with --keep");

    let work = ["work", "c", "--jobs", "1", "--quiet"];
    let mut child = plumbline_bench().current_dir(path).args(work).spawn().unwrap();
    let start = Instant::now();
    while shards(&path.join("c")).is_empty() && start.elapsed() < Duration::from_secs(60) {
        sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let made = shards(&path.join("c")).len();
    assert!((1..6).contains(&made), "{made}");
    let status = trials(path, &["status", "c"]);
    assert!(status.code == 1 && status.out.contains(&format!("{} of 6 trials are left", 6 - made)));
    // Two that know nothing of each other: each may leave what the other is at.
    let mut other = plumbline_bench().current_dir(path).args(work).spawn().unwrap();
    let answer = trials(path, &["work", "c", "--jobs", "1"]);
    assert!(answer.code <= 1 && answer.err.is_empty(), "{}", answer.err);
    assert!(other.wait().unwrap().code().is_some_and(|code| code <= 1));
    assert!(!answer.out.starts_with(&format!("{} trials made", 6 - made)), "they shared them");
    assert_eq!(merged(path, "c"), whole);
}

/// The logs of both trials with Coulomb friction, by name.
fn kept(folder: &Path) -> [PathBuf; 2] {
    let entries = fs::read_dir(folder.join("logs/coulomb_friction")).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths.try_into().unwrap()
}

#[test]
fn logs_that_are_kept_are_used_again_by_their_own_trial_alone() {
    let folder = folder();
    let path = folder.path();
    done(path, &["plan", "campaign.toml", "--out", "a"]);
    let work = || done(path, &["work", "a", "--part", "2/3", "--keep"]);
    let taken = || {
        let shards = shards(&path.join("a"));
        let records: Vec<_> = shards.iter().map(|shard| without_costs(shard)).collect();
        shards.iter().for_each(|shard| fs::remove_file(shard).unwrap());
        records
    };
    assert_eq!(work(), "2 trials made; 0 left\n");
    let logs = kept(&path.join("a"));
    let written = || {
        logs.clone()
            .map(|logs| fs::metadata(logs.join("logs/waves.parquet")).unwrap().modified().unwrap())
    };
    let (first, shards) = (written(), taken());
    assert_eq!(work(), "2 trials made; 0 left\n");
    assert_eq!(written(), first);
    assert!(taken() == shards);

    // Those of another trial, and those that are not whole, with a log that is none of theirs.
    fs::remove_dir_all(&logs[0]).unwrap();
    fs::rename(&logs[1], &logs[0]).unwrap();
    for name in ["truth/scenario.toml", "logs/waves.parquet"] {
        fs::create_dir_all(logs[1].join(name).parent().unwrap()).unwrap();
        fs::copy(logs[0].join(name), logs[1].join(name)).unwrap();
    }
    for logs in &logs {
        fs::write(logs.join("logs/another.parquet"), "no log").unwrap();
    }
    assert_eq!(work(), "2 trials made; 0 left\n");
    assert!(taken() == shards);
    assert!(logs.iter().all(|logs| !logs.join("logs/another.parquet").exists()));
}

#[test]
fn what_a_killed_worker_has_left_is_in_nobodys_way() {
    let folder = folder();
    let path = folder.path();
    for name in ["a", "b"] {
        done(path, &["plan", "campaign.toml", "--out", name, "--quiet"]);
    }
    done(path, &["work", "a", "--quiet"]);
    let work = path.join("b").join("work");
    let half = work.join("00001");
    fs::create_dir_all(&half).unwrap();
    fs::write(work.join("00001.lock"), "").unwrap();
    for name in ["waves.parquet", "another.parquet", "scenario.toml", "truth.json"] {
        fs::write(half.join(name), "half of").unwrap();
    }
    assert_eq!(done(path, &["work", "b"]), "6 trials made; 0 left\n");
    assert_eq!(merged(path, "b"), merged(path, "a"));
    assert_eq!(fs::read_dir(work).unwrap().count(), 0);
}

#[test]
fn what_a_worker_has_left_that_was_killed_behind_its_last_shard_is_gone_after_the_next() {
    let folder = folder();
    let path = folder.path();
    done(path, &["plan", "campaign.toml", "--out", "a", "--quiet"]);
    done(path, &["work", "a", "--quiet"]);
    let work = path.join("a/work");
    fs::create_dir_all(work.join("00001")).unwrap();
    fs::write(work.join("00001/waves.parquet"), "a log").unwrap();
    fs::write(work.join("00001.lock"), "").unwrap();
    fs::write(work.join("00003.lock"), "").unwrap();
    // Another process is at work on this one.
    let held = fs::File::create(work.join("00002.lock")).unwrap();
    held.lock().unwrap();
    assert_eq!(done(path, &["work", "a"]), "0 trials made; 0 left\n");
    let left: Vec<_> =
        fs::read_dir(&work).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left, ["00002.lock"]);
}

#[cfg(unix)]
#[test]
fn ctrl_c_lets_the_trials_that_are_being_made_come_to_their_end() {
    let folder = folder();
    let path = folder.path();
    done(path, &["plan", "campaign.toml", "--out", "a"]);
    let work = ["work", "a", "--jobs", "1"];
    let pipe = std::process::Stdio::piped;
    let mut command = plumbline_bench();
    let child = command.current_dir(path).args(work).stdout(pipe()).stderr(pipe()).spawn().unwrap();
    let start = Instant::now();
    while shards(&path.join("a")).is_empty() && start.elapsed() < Duration::from_secs(60) {
        sleep(Duration::from_millis(5));
    }
    let pid = child.id().to_string();
    assert!(std::process::Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
    let answer: Answer = child.wait_with_output().unwrap().into();
    assert_eq!(answer.code, 1);
    assert!(
        answer.err.starts_with("stopping: ") && answer.err.lines().count() == 1,
        "{}",
        answer.err
    );
    let made = shards(&path.join("a")).len();
    assert!((1..6).contains(&made), "{made}");
    assert_eq!(answer.out, format!("{made} trials made; {} left\n", 6 - made));
    assert_eq!(fs::read_dir(path.join("a/work")).unwrap().count(), 0);
}

#[test]
fn shards_that_do_not_count_are_named_and_made_again() {
    let folder = folder();
    let path = folder.path();
    arm::write(path, "other.toml", &CAMPAIGN.replace("seed = 7", "seed = 8"));
    done(path, &["plan", "campaign.toml", "--out", "a"]);
    done(path, &["work", "a"]);
    done(path, &["plan", "other.toml", "--out", "b"]);
    done(path, &["work", "b", "--part", "2/6"]);
    let whole = merged(path, "a");

    let shard = |number: usize| path.join(format!("a/shards/0000{number}.parquet"));
    fs::write(shard(0), "no shard").unwrap();
    fs::copy(path.join("b/shards/00001.parquet"), shard(1)).unwrap();
    fs::copy(shard(3), shard(2)).unwrap();
    fs::write(shard(3), &fs::read(shard(3)).unwrap()[..900]).unwrap();
    for command in ["status", "merge"] {
        let answer = trials(path, &[command, "a"]);
        assert_eq!((answer.code, answer.err.as_str()), (1, ""));
        for expected in [
            "a/shards/00000.parquet: it does not count, ",
            "a/shards/00001.parquet: it does not count, it is of another campaign",
            "a/shards/00002.parquet: it does not count, it is that of task 3",
            "a/shards/00003.parquet: it does not count, ",
            "4 of 6 trials are left to make",
        ] {
            assert!(answer.out.contains(expected), "{expected} is missing in\n{}", answer.out);
        }
    }
    assert_eq!(done(path, &["work", "a"]), "4 trials made; 0 left\n");
    assert_eq!(merged(path, "a"), whole);
}

#[test]
fn trials_that_another_folder_has_are_taken_and_not_made_again() {
    let folder = folder();
    let path = folder.path();
    done(path, &["plan", "campaign.toml", "--out", "a"]);
    done(path, &["work", "a"]);
    let whole = merged(path, "a");
    // A half of them, in a table of its own, for a folder that has one of that half.
    done(path, &["plan", "campaign.toml", "--out", "half"]);
    done(path, &["work", "half", "--part", "1/2"]);
    trials(path, &["merge", "half"]);
    done(path, &["plan", "campaign.toml", "--out", "b"]);
    done(path, &["work", "b", "--part", "1/6"]);
    let said =
        done(path, &["plan", "campaign.toml", "--out", "b", "--made", "half/trials.parquet"]);
    assert!(said.contains("\n2 are made already. To make the others:\n"), "{said}");
    assert_eq!(done(path, &["work", "b"]), "3 trials made; 0 left\n");
    assert_eq!(merged(path, "b"), whole);

    arm::write(path, "other.toml", &CAMPAIGN.replace("seed = 7", "seed = 8"));
    arm::write(path, "none.parquet", "none");
    for (table, expected) in [
        ("a/trials.parquet", "a/trials.parquet: its trials are of another campaign ("),
        ("none.parquet", "trials.parquet of a campaign was expected"),
        ("nowhere.parquet", "nowhere.parquet: "),
    ] {
        let answer = trials(path, &["plan", "other.toml", "--out", "c", "--made", table]);
        assert_eq!((answer.code, answer.out.as_str()), (3, ""));
        assert!(answer.err.contains(expected), "{}", answer.err);
        assert!(!path.join("c/shards").exists());
    }
}

/// In a clone elsewhere the campaign is the same; with a heavier link of the same file it is another one.
#[test]
fn a_campaign_is_its_content_wherever_it_lies() {
    let (here, there) = (folder(), folder());
    done(here.path(), &["plan", "campaign.toml", "--out", "a"]);
    done(here.path(), &["work", "a", "--part", "1/6"]);
    trials(here.path(), &["merge", "a"]);
    let table = here.path().join("a/trials.parquet");
    let plan = ["plan", "campaign.toml", "--made", table.to_str().unwrap(), "--out"];
    let said = done(there.path(), &[&plan[..], &["b"]].concat());
    assert!(said.contains("\n1 are made already."), "{said}");
    let urdf = fs::read_to_string(there.path().join("arm.urdf")).unwrap();
    arm::write(there.path(), "arm.urdf", &urdf.replace("mass value=\"3\"", "mass value=\"9\""));
    let answer = trials(there.path(), &[&plan[..], &["c"]].concat());
    assert_eq!(answer.code, 3, "{answer:?}");
    assert!(answer.err.contains("its trials are of another campaign"), "{}", answer.err);
    assert!(!there.path().join("c").exists());
}

#[test]
fn a_folder_with_trials_of_another_campaign_is_refused() {
    let folder = folder();
    let path = folder.path();
    arm::write(path, "other.toml", &CAMPAIGN.replace("seed = 7", "seed = 8"));
    done(path, &["plan", "campaign.toml", "--out", "a"]);
    // Nothing is lost where no trial is made yet.
    done(path, &["plan", "other.toml", "--out", "a"]);
    done(path, &["work", "a", "--part", "1/6"]);
    let planned = fs::read(path.join("a/campaign.toml")).unwrap();
    let answer = trials(path, &["plan", "campaign.toml", "--out", "a"]);
    assert_eq!((answer.code, answer.out.as_str()), (2, ""));
    assert!(answer.err.contains("a/shards/00000.parquet: it is of another campaign ("));
    assert!(answer.err.contains("an empty folder was expected"), "{}", answer.err);
    assert_eq!(fs::read(path.join("a/campaign.toml")).unwrap(), planned);
}

#[test]
fn what_cannot_be_written_ends_the_work_and_loses_nothing() {
    let folder = folder();
    let path = folder.path();
    done(path, &["plan", "campaign.toml", "--out", "a"]);
    done(path, &["work", "a", "--part", "1/3"]);
    fs::remove_dir(path.join("a/work")).unwrap();
    fs::write(path.join("a/work"), "").unwrap();
    let answer = trials(path, &["work", "a", "--jobs", "2"]);
    assert_eq!((answer.code, answer.out.as_str()), (2, ""));
    assert!(answer.err.starts_with("error: a/work: it cannot be the folder of a trial: "));
    assert_eq!(answer.err.lines().count(), 1);
    assert_eq!(shards(&path.join("a")).len(), 2);
    fs::remove_file(path.join("a/work")).unwrap();
    assert_eq!(done(path, &["work", "a"]), "4 trials made; 0 left\n");

    // The folder of one trial alone: nothing that a trial should be blamed for.
    #[cfg(unix)]
    {
        done(path, &["plan", "campaign.toml", "--out", "b"]);
        fs::create_dir(path.join("b/logs")).unwrap();
        std::os::unix::fs::symlink("nowhere/at/all", path.join("b/logs/clean")).unwrap();
        let answer = trials(path, &["work", "b", "--part", "1/6", "--keep"]);
        assert_eq!((answer.code, answer.err.lines().count()), (2, 1), "{}", answer.err);
        assert!(answer.err.starts_with("error: b/logs/clean/"), "{}", answer.err);
        assert!(shards(&path.join("b")).is_empty());
    }

    arm::write(path, "file", "");
    let answer = trials(path, &["plan", "campaign.toml", "--out", "file"]);
    assert_eq!(answer.code, 2);
    let answer = trials(path, &["work", "nowhere"]);
    assert!(answer.err.contains("plumbline-bench plan CAMPAIGN.toml --out nowhere"), "{answer:?}");
    assert_eq!(answer.code, 3);
}

/// Logs of three seconds of so slow a motion are too short to say anything.
#[test]
fn a_trial_that_cannot_be_diagnosed_is_refused_and_says_why() {
    let folder = folder();
    let path = folder.path();
    let waves = "highest_hz = 0.3, fade_s = 1.4, duration_s = 3";
    let scenario = SCENARIO.replace("highest_hz = 1, duration_s = 6", waves);
    arm::write(path, "scenario.toml", &scenario);
    done(path, &["plan", "campaign.toml", "--out", "a"]);
    assert_eq!(done(path, &["work", "a"]), "6 trials made; 0 left\n");
    let (records, tally) = merged(path, "a");
    assert_eq!((&tally["rows"][0]["trials"], &tally["rows"][0]["refused"]), (&6.into(), &6.into()));
    for record in records {
        let judged = record.score.unwrap();
        assert!(judged.findings.is_empty() && !judged.refused.unwrap().is_empty());
    }
}

#[test]
fn a_mistake_in_a_campaign_is_underlined() {
    let cases = [
        ("\"FR02\"", "\"backlsh\"", "\"backlsh\"", "unknown kind of trial `backlsh`, did you mean"),
        ("\"FR02\"", "\"clean\"", "\"clean\"", "clean is there already"),
        (
            "\"FR02\"",
            "\"rotor_inertia+payload\"",
            "\"payload+rotor_inertia\"",
            "rotor_inertia+payload is there already",
        ),
        ("seeds = 2", "seeds = 0", "0", "0, a number from 1 to 1000000 was expected"),
        ("seeds = 2", "seed_count = 2", "seed_count", "unknown key `seed_count`"),
        ("seed = 7", "seed = -7", "-7", "a"),
        ("scenario.toml", "no.toml", "\"no.toml\"", "no.toml: there is no such file"),
        ("scenario.toml", "arm.urdf", "\"arm.urdf\"", "arm.urdf: line 1 is no TOML"),
        ("scenario.toml", "campaign.toml", "\"campaign.toml\"", "campaign.toml: it names itself"),
        ("0.2, 0.3", "0.3, 0.2", "[0.3, 0.2]", "share above 0 up to 1 were expected"),
    ];
    for (old, new, underlined, message) in cases {
        let folder = folder();
        arm::write(folder.path(), "campaign.toml", &CAMPAIGN.replace(old, new));
        let answer = trials(folder.path(), &["plan", "campaign.toml", "--out", "a"]);
        assert_eq!((answer.code, answer.out.as_str()), (3, ""), "{}", answer.err);
        assert!(answer.err.contains(message), "{message} is missing in\n{}", answer.err);
        let line = |sign: char| answer.err.lines().find(|line| line.contains(sign)).unwrap();
        assert_eq!(line('^').matches('^').count(), underlined.len(), "{}", answer.err);
        assert!(!folder.path().join("a").exists());
    }
    let folder = folder();
    arm::write(
        folder.path(),
        "campaign.toml",
        &CAMPAIGN.replace("\"clean\", \"FR02\", \"payload+rotor_inertia\"", ""),
    );
    let answer = trials(folder.path(), &["plan", "campaign.toml", "--out", "a"]);
    assert!(answer.err.contains("nothing, at least one kind was expected"), "{}", answer.err);
    let answer = trials(folder.path(), &["work", "a", "--part", "5/4"]);
    assert!(answer.code == 2 && answer.err.contains("a part such as 1/4 was expected"));
}

#[test]
fn a_table_that_is_none_leaves_no_campaign_behind() {
    let folder = arm::folder(Gap::None);
    let path = folder.path();
    let scenario = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/demos/no_effects.toml");
    let campaign = format!("scenario = {scenario:?}\nhidden = [\"clean\"]\nseeds = 2\n");
    arm::write(path, "campaign.toml", &campaign);
    arm::write(path, "bad.parquet", "no table");
    let plan = ["plan", "campaign.toml", "--made", "bad.parquet", "--out", "out"];
    let answer = run(path, &plan);
    assert_eq!(answer.code, 3, "{}", answer.err);
    assert!(answer.err.contains("bad.parquet"), "{}", answer.err);
    assert!(!path.join("out").exists());
}
