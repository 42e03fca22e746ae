use std::fs;
use std::path::Path;
use std::sync::Mutex;
use std::time::Duration;

use benchmark::{
    Campaign, CampaignFolder, ChosenTrials, Hidden, Part, Record, TrialLogs, WorkProgress, Workers,
    read_finished, work,
};
use catalogue::EffectKind::CoulombFriction;
use document::Document;

use crate::trials::cheap;

#[test]
fn a_record_is_read_back_as_it_was_written() {
    let folder = tempfile::tempdir().unwrap();
    let judged = cheap(Hidden::One(CoulombFriction), 3).run(&folder.path().join("logs")).unwrap();
    assert!(judged.causes[0].sizes[0].estimate.is_some() && !judged.findings.is_empty());
    let record = |task, score| Record {
        task,
        hidden: Some(Hidden::One(CoulombFriction)),
        seed: u64::MAX >> 1,
        campaign: "c".to_owned(),
        score,
    };
    let records =
        [record(0, Ok(judged.clone().into())), record(7, Err("it \"ran\" away".to_owned()))];
    let path = folder.path().join("records.parquet");
    Record::write(&path, &records).unwrap();
    assert_eq!(Record::read(&path).unwrap(), records);

    // A number that JSON has not is no number.
    let mut endless = judged;
    let estimate = endless.causes[0].sizes[0].estimate.as_mut().unwrap();
    estimate.ci95 = [f64::NEG_INFINITY, 1.0];
    Record::write(&path, &[record(0, Ok(endless.into()))]).unwrap();
    let read = Record::read(&path).unwrap().remove(0);
    let read = read.judgement().unwrap();
    let [low, high] = read.causes[0].sizes[0].estimate.as_ref().unwrap().ci95;
    assert!(low.is_nan() && (high - 1.0).abs() < 1e-12);
}

#[test]
fn a_file_without_records_says_what_it_lacks() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("records.parquet");
    assert!(Record::read(&path).unwrap_err().contains("no such file"));
    fs::write(&path, "PAR1 and no more PAR1").unwrap();
    assert!(!Record::read(&path).unwrap_err().is_empty());
    let time = std::sync::Arc::new(arrow_array::Float64Array::from(vec![1.0]));
    logs::write_table(&path, vec![("time".to_owned(), time)], Vec::new()).unwrap();
    assert_eq!(Record::read(&path).unwrap_err(), "row 1 has no score and no error");
}

/// Trials that are stopped after the first.
#[derive(Default)]
struct OnlyOne(Mutex<Vec<usize>>);

impl WorkProgress for OnlyOne {
    fn begin(&self, _: usize) {}

    fn finish_trial(&self, record: &Record, took: Duration) {
        assert!(took > Duration::ZERO);
        self.0.lock().unwrap().push(record.task);
    }

    fn report_remade(&self, _: &Path, _: &str) {}

    fn is_stopped(&self) -> bool {
        !self.0.lock().unwrap().is_empty()
    }
}

/// The kinds of a campaign in the cheap scenario, and what is drawn from.
fn kinds(more: &str) -> (Vec<String>, String) {
    let scenario = cheap(Hidden::Nothing, 0).scenario;
    let text = format!("scenario = {scenario:?}\nseeds = 1\n{more}\n");
    let campaign = Campaign::from_document(&Document::from_text("c.toml", &text).unwrap()).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let planned = CampaignFolder::plan(folder.path(), campaign).unwrap();
    let kinds = planned.campaign().kinds().iter().map(Hidden::to_string).collect();
    (kinds, fs::read_to_string(folder.path().join("scenario.toml")).unwrap())
}

#[test]
fn each_effect_is_hidden_once_with_and_once_without_being_looked_for() {
    let (all, drawn) = kinds(r#"hidden = ["clean", "each", "without_each", "any+any"]"#);
    let effects = catalogue::EffectKind::ALL.len();
    assert_eq!(all.len(), 2 + 2 * effects);
    assert!(all.contains(&"without_backlash".to_owned()));
    assert!(!drawn.contains("from"), "{drawn}");
    let (some, drawn) =
        kinds("hidden = ['each', 'without_each', 'strange_each']\nexcept = ['backlash']");
    assert_eq!(some.len(), 3 * (effects - 1));
    assert!(some.contains(&"strange_payload".to_owned()));
    assert!(!some.iter().any(|kind| kind.contains("backlash")));
    assert!(drawn.contains("payload") && !drawn.contains("backlash"), "{drawn}");
}

/// Two clean trials of the cheap scenario.
fn planned(root: &Path) -> CampaignFolder {
    let trial = cheap(Hidden::Nothing, 0);
    let text = format!(
        "scenario = {:?}\nhidden = [\"clean\"]\nseeds = 2\nsettings = {:?}\n",
        trial.scenario, trial.settings
    );
    let document = Document::from_text("c.toml", &text).unwrap();
    CampaignFolder::plan(root, Campaign::from_document(&document).unwrap()).unwrap()
}

#[test]
fn work_that_is_stopped_ends_after_the_trial_and_keeps_logs_where_they_are_wanted() {
    let root = tempfile::tempdir().unwrap();
    let folder = planned(root.path());
    let workers = Workers {
        jobs: 1,
        part: Part::WHOLE,
        logs: TrialLogs::Kept,
        store: None,
        chosen: ChosenTrials::All,
    };
    let progress = OnlyOne::default();
    work(&folder, &workers, &progress).unwrap();
    assert_eq!(*progress.0.lock().unwrap(), [0]);
    assert_eq!(folder.remaining(Part::WHOLE).unwrap(), [1]);
    let record = folder.manifest().unwrap().records.remove(&0).unwrap();
    assert_eq!((record.hidden, record.seed), folder.campaign().task(0));
    let judged = record.judgement().unwrap();
    assert_eq!((judged.right(), judged.seed), (Some(true), record.seed));
    let logs = root.path().join(format!("logs/clean/{}", record.seed));
    assert!(logs.join("logs/a.parquet").is_file() && logs.join("logs/b.parquet").is_file());
}

/// As an earlier or another process would hold it.
#[test]
fn a_trial_that_another_process_makes_is_left_to_it() {
    let root = tempfile::tempdir().unwrap();
    let folder = planned(root.path());
    fs::create_dir(root.path().join("work")).unwrap();
    let held = fs::File::create(root.path().join("work/00000.lock")).unwrap();
    held.lock().unwrap();
    let workers = Workers {
        jobs: 1,
        part: "1/2".parse().unwrap(),
        logs: TrialLogs::Removed,
        store: None,
        chosen: ChosenTrials::All,
    };
    work(&folder, &workers, &OnlyOne::default()).unwrap();
    assert_eq!(folder.remaining(Part::WHOLE).unwrap(), [0, 1]);
    drop(held);
    work(&folder, &workers, &OnlyOne::default()).unwrap();
    assert_eq!(folder.remaining(Part::WHOLE).unwrap(), [1]);
    assert_eq!(fs::read_dir(root.path().join("work")).unwrap().count(), 0);
}

/// Removes the file of a lock while it is held, as the process that had it before may.
struct Unlocking<'a>(&'a Path);

impl WorkProgress for Unlocking<'_> {
    fn begin(&self, _: usize) {}

    fn finish_trial(&self, record: &Record, _: Duration) {
        let lock = self.0.join(format!("work/{:05}.lock", record.task));
        fs::remove_file(lock).unwrap();
    }

    fn report_remade(&self, _: &Path, _: &str) {}

    fn is_stopped(&self) -> bool {
        false
    }
}

#[test]
fn a_lock_whose_file_is_gone_is_no_reason_to_end_the_work() {
    let root = tempfile::tempdir().unwrap();
    let folder = planned(root.path());
    let workers = Workers {
        jobs: 1,
        part: Part::WHOLE,
        logs: TrialLogs::Removed,
        store: None,
        chosen: ChosenTrials::All,
    };
    work(&folder, &workers, &Unlocking(root.path())).unwrap();
    assert_eq!(folder.remaining(Part::WHOLE).unwrap(), [0; 0]);
}

/// Scenarios have their logs kept by other means, and an option that does nothing is none.
#[test]
fn a_store_is_for_populations_alone() {
    let root = tempfile::tempdir().unwrap();
    let folder = planned(root.path());
    let store = Some(root.path().join("store"));
    let workers = Workers {
        jobs: 1,
        part: Part::WHOLE,
        logs: TrialLogs::Removed,
        store,
        chosen: ChosenTrials::All,
    };
    let refused = work(&folder, &workers, &OnlyOne::default()).unwrap_err().to_string();
    assert!(refused.contains("a store holds logs of populations"), "{refused}");
    assert_eq!(folder.remaining(Part::WHOLE).unwrap(), [0, 1]);
    assert!(!root.path().join("store").exists());
}

fn population(more: &str) -> Campaign {
    let text = format!("[population]\ntrials = 3\n{more}");
    Campaign::from_document(&Document::from_text("p.toml", &text).unwrap()).unwrap()
}

#[test]
fn a_population_is_planned_and_its_folder_refuses_trials_of_another_kind() {
    let root = tempfile::tempdir().unwrap();
    let folder = CampaignFolder::plan(root.path(), population("seed = 5")).unwrap();
    let campaign = folder.campaign();
    assert_eq!((campaign.trials(), campaign.kinds().len()), (3, 0));
    // The digest is that of `printf '%s' 5/population/2 | sha256sum`.
    assert_eq!(campaign.task(2), (None, 0x309cd0360d2e7ea1 >> 1));
    assert!(!root.path().join("scenario.toml").exists());
    let again = CampaignFolder::open(root.path()).unwrap();
    assert_eq!(again.hash(), folder.hash());
    assert_eq!(again.remaining(Part::WHOLE).unwrap(), [0, 1, 2]);
    for other in ["seed = 6", "seed = 5\nstrangers = 0.5", "seed = 5\ncauses = [0, 1]"] {
        assert_ne!(population(other).hash(), folder.hash());
    }

    let shard = Record {
        task: 0,
        hidden: Some(Hidden::Nothing),
        seed: 1,
        campaign: "of a scenario".to_owned(),
        score: Err("it ran away".to_owned()),
    };
    let table = root.path().join("scenario.parquet");
    Record::write(&table, std::slice::from_ref(&shard)).unwrap();
    let refused = read_finished(folder.campaign(), &table).unwrap_err().to_string();
    assert!(refused.contains("its trials are of another campaign"), "{refused}");
    fs::create_dir_all(root.path().join("shards")).unwrap();
    Record::write(&folder.shard(0), &[shard]).unwrap();
    assert_eq!(folder.manifest().unwrap().broken[0].reason, "it is of another campaign");
    let refused = CampaignFolder::plan(root.path(), population("seed = 5")).unwrap_err();
    assert!(refused.to_string().contains("an empty folder was expected"), "{refused}");
}

#[test]
fn a_campaign_is_of_one_form() {
    let refused = |text: &str| {
        let document = Document::from_text("p.toml", text).unwrap();
        Campaign::from_document(&document).unwrap_err().to_string()
    };
    let both = refused("hidden = ['clean']\n[population]\ntrials = 3\n");
    assert!(both.contains("hidden"), "{both}");
    let scenario = cheap(Hidden::Nothing, 0).scenario;
    let one = "settings = [\"run=[{name='a', motion={sinusoids={seed=1, terms=2, lowest_hz=0.2, highest_hz=0.5, duration_s=5.0}}}]\"]";
    let gains = refused(&format!(
        "scenario = {scenario:?}\nhidden = ['clean']\nseeds = 1\ngains = true\n{one}\n"
    ));
    assert!(gains.contains("one run, two or more were expected"), "{gains}");
    let none = refused("[population]\ntrials = 0\n");
    assert!(none.contains("a number from 1 to 1000000 was expected"), "{none}");
}
