use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread::available_parallelism;
use std::time::{Duration, Instant};

use population::Store;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::disk_failure::is_of_the_disk;
use crate::error::BenchmarkError;
use crate::trials::campaign::Campaign;
use crate::trials::campaign_folder::CampaignFolder;
use crate::trials::part::Part;
use crate::trials::record::Record;
use crate::trials::trial_lock::{TrialLock, begun, ignore_missing, trial_folder};

/// Folder of the trials that are being made.
const WORK: &str = "work";

/// The workers of a campaign: their number, their part, and the handling of the logs.
#[derive(Debug, Clone)]
pub struct Workers {
    /// Number of trials made at a time; zero counts as one.
    pub jobs: usize,
    /// The part of the campaign to make.
    pub part: Part,
    /// The handling of the logs.
    pub logs: TrialLogs,
    /// A folder with logs of a population. Logs in it are read, and missing ones are added.
    pub store: Option<PathBuf>,
    /// Which trials are made.
    pub chosen: ChosenTrials,
}

/// Which trials of a part are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ChosenTrials {
    /// All that have no shard yet.
    All,
    /// Those of them whose logs the store has: none is simulated.
    Stored,
}

/// Handling of the logs of a finished trial.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TrialLogs {
    /// Logs are removed.
    Removed,
    /// Logs stay under `logs/KIND/SEED`, and a later run reads them instead of simulating again.
    Kept,
}

/// Receives every finished trial, and may stop the work.
pub trait WorkProgress: Sync {
    /// The work begins, with `left` trials to make.
    fn begin(&self, left: usize);

    /// A trial has its shard, after the time `took`.
    fn finish_trial(&self, record: &Record, took: Duration);

    /// An entry of the store was unusable for this reason, and was made again.
    fn report_remade(&self, entry: &Path, reason: &str);

    /// Whether to begin no further trial.
    fn is_stopped(&self) -> bool;
}

/// Makes every trial of a part that has no shard yet.
///
/// ```text
/// task --simulate, diagnose, score--> shards/NNNNN.parquet, by rename
/// ```
///
/// A trial that cannot be simulated or diagnosed gets a shard with the reason. A trial that another live process is
/// making is left to that process, which holds a lock on a file until it ends. What a process that was killed has left of
/// a trial with a shard is removed.
///
/// # Errors
///
/// [`BenchmarkError::NoStore`] when a store is given to a campaign that has none, and [`BenchmarkError`] when
/// something cannot be written. No further trial is then begun, trials in progress are finished as far as possible,
/// and every shard stays.
pub fn work(
    folder: &CampaignFolder,
    workers: &Workers,
    progress: &dyn WorkProgress,
) -> Result<(), BenchmarkError> {
    if let (Some(store), Campaign::Scenario(_)) = (&workers.store, folder.campaign()) {
        return Err(BenchmarkError::NoStore { path: store.clone() });
    }
    let store = workers.store.as_deref().map(Store::open).transpose()?;
    sweep(folder)?;
    let mut left = folder.remaining(workers.part)?;
    if workers.chosen == ChosenTrials::Stored {
        left.retain(|task| folder.campaign().is_stored(*task, store.as_ref()));
    }
    progress.begin(left.len());
    let jobs = workers.jobs.clamp(1, left.len().max(1));
    let worker_run = WorkerRun {
        folder,
        logs: workers.logs,
        store: store.as_ref(),
        progress,
        left: &left,
        next: AtomicUsize::new(0),
        ended: AtomicBool::new(false),
        failure: Mutex::new(None),
    };
    let pools = (0..jobs).map(|_| pool(jobs)).collect::<Result<Vec<_>, _>>()?;
    std::thread::scope(|scope| {
        for pool in &pools {
            scope.spawn(|| worker_run.worker(pool));
        }
    });
    worker_run.failure.into_inner().unwrap_or_else(PoisonError::into_inner).map_or(Ok(()), Err)
}

/// The threads of one worker: an equal share of the processors.
pub(crate) fn pool(jobs: usize) -> Result<ThreadPool, BenchmarkError> {
    let processors = available_parallelism().map_or(1, usize::from);
    let pool = ThreadPoolBuilder::new().num_threads((processors / jobs).max(1)).build();
    pool.map_err(|error| BenchmarkError::NoThreads { reason: error.to_string() })
}

struct WorkerRun<'a> {
    folder: &'a CampaignFolder,
    logs: TrialLogs,
    store: Option<&'a Store>,
    progress: &'a dyn WorkProgress,
    left: &'a [usize],
    /// Index in `left` of the next trial to begin.
    next: AtomicUsize,
    ended: AtomicBool,
    failure: Mutex<Option<BenchmarkError>>,
}

impl WorkerRun<'_> {
    fn worker(&self, pool: &ThreadPool) {
        while !self.ended.load(Ordering::Relaxed) && !self.progress.is_stopped() {
            let place = self.next.fetch_add(1, Ordering::Relaxed);
            let Some(&task) = self.left.get(place) else { return };
            if let Err(error) = self.make(task, pool) {
                self.ended.store(true, Ordering::Relaxed);
                let mut failure = self.failure.lock().unwrap_or_else(PoisonError::into_inner);
                failure.get_or_insert(error);
            }
        }
    }

    fn make(&self, task: usize, pool: &ThreadPool) -> Result<(), BenchmarkError> {
        let work = self.folder.folder(WORK)?;
        let Some(lock) = TrialLock::take(&work, task)? else { return Ok(()) };
        // Whoever held the lock before may have made it.
        if !self.folder.holds(task) {
            let (campaign, scenario) = (self.folder.campaign(), self.folder.scenario());
            let logs = match self.logs {
                TrialLogs::Removed => trial_folder(&work, task),
                TrialLogs::Kept => self.folder.folder("logs")?.join(campaign.logs(task)),
            };
            if self.logs == TrialLogs::Removed || !campaign.is_logged(task, &scenario, &logs) {
                clear(&logs)?;
            }
            let start = Instant::now();
            let make = || campaign.make(task, &scenario, &logs, self.store);
            let made = outcome_of(catch_unwind(AssertUnwindSafe(|| pool.install(make))))?;
            if let Ok((_, Some(remade))) = &made {
                self.progress.report_remade(&remade.path, &remade.reason);
            }
            let score = made.map(|(score, _)| score);
            let (hidden, seed) = campaign.task(task);
            let campaign = self.folder.hash().to_owned();
            let record = Record { task, hidden, seed, campaign, score };
            self.folder.keep(&record)?;
            if self.logs == TrialLogs::Removed {
                clear(&logs)?;
            }
            self.progress.finish_trial(&record, start.elapsed());
        }
        lock.remove()
    }
}

/// Removes what processes that were killed have left of trials that have their shard.
fn sweep(folder: &CampaignFolder) -> Result<(), BenchmarkError> {
    let work = folder.root().join(WORK);
    for task in begun(&work)? {
        if !folder.holds(task) {
            continue;
        }
        if let Some(lock) = TrialLock::take(&work, task)? {
            clear(&trial_folder(&work, task))?;
            lock.remove()?;
        }
    }
    Ok(())
}

/// Removes the logs of a trial, complete or not.
fn clear(logs: &Path) -> Result<(), BenchmarkError> {
    ignore_missing(std::fs::remove_dir_all(logs), logs)
}

/// The score of a trial, or in words why there is none. A disk failure is an error instead.
fn outcome_of<T>(
    outcome: Result<Result<T, BenchmarkError>, Box<dyn Any + Send>>,
) -> Result<Result<T, String>, BenchmarkError> {
    match outcome {
        Ok(Ok(score)) => Ok(Ok(score)),
        Ok(Err(error)) if is_of_the_disk(&error) => Err(error),
        Ok(Err(error)) => Ok(Err(error.to_string())),
        Err(panic) => {
            let words = panic.downcast_ref::<String>().map(String::as_str);
            let words = words.or_else(|| panic.downcast_ref::<&str>().copied());
            Ok(Err(format!("the program gave up: {}", words.unwrap_or("it said nothing"))))
        }
    }
}
