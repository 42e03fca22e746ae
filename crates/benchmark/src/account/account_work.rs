use std::num::NonZeroUsize;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use population::{PopulationSpec, Store};
use rayon::ThreadPool;

use crate::account::campaign_account::{AccountShard, FOLDER, simulated_trials};
use crate::account::trial_account::TrialAccount;
use crate::disk_failure::is_of_the_disk;
use crate::error::BenchmarkError;
use crate::panel::judgement::Judgement;
use crate::trial_folder::unusable;
use crate::trials::campaign::Campaign;
use crate::trials::campaign_folder::CampaignFolder;
use crate::trials::part::Part;
use crate::trials::work::pool;

/// Receives every finished account, and may stop the work.
pub trait AccountProgress: Sync {
    /// The work begins, with `left` accounts to make.
    fn begin(&self, left: usize);

    /// An account is in its place.
    fn finish_account(&self);

    /// Whether to begin no further account.
    fn is_stopped(&self) -> bool;
}

/// Makes the account of every judged trial of a part that has none yet.
///
/// ```text
/// task --logs from the store, search beside the truth--> accounts/NNNNN.json, by rename
/// ```
///
/// An account hangs on the judgement of its trial and is made again after that has changed. It may be ended and begun
/// again, and the result is the same for any number of jobs.
///
/// # Errors
///
/// [`BenchmarkError::NoTruthSheets`] for a campaign of a scenario, and [`BenchmarkError`] when something cannot be
/// read or written.
pub fn make_accounts(
    folder: &CampaignFolder,
    (part, jobs): (Part, NonZeroUsize),
    store: Option<&Path>,
    progress: &dyn AccountProgress,
) -> Result<(), BenchmarkError> {
    let Campaign::Population(campaign) = folder.campaign() else {
        return Err(BenchmarkError::NoTruthSheets { path: folder.root().to_owned() });
    };
    let made = folder.manifest()?;
    let has_none = |(task, judgement): &(usize, &Judgement)| {
        let path = AccountShard::path(folder.root(), *task);
        part.holds(*task) && AccountShard::read(&path, folder.hash(), judgement).is_none()
    };
    let left: Vec<(usize, &Judgement)> = simulated_trials(&made).filter(has_none).collect();
    progress.begin(left.len());
    folder.folder(FOLDER)?;
    let work = AccountWork {
        folder,
        spec: &campaign.population,
        store: store.map(Store::open).transpose()?,
        left,
        next: AtomicUsize::new(0),
        ended: AtomicBool::new(false),
        failure: Mutex::new(None),
        progress,
    };
    let jobs = jobs.get().clamp(1, work.left.len().max(1));
    let pools = (0..jobs).map(|_| pool(jobs)).collect::<Result<Vec<_>, _>>()?;
    std::thread::scope(|scope| {
        for pool in &pools {
            scope.spawn(|| work.worker(pool));
        }
    });
    work.failure.into_inner().unwrap_or_else(PoisonError::into_inner).map_or(Ok(()), Err)
}

struct AccountWork<'a> {
    folder: &'a CampaignFolder,
    spec: &'a PopulationSpec,
    store: Option<Store>,
    left: Vec<(usize, &'a Judgement)>,
    /// Index in `left` of the next account to begin.
    next: AtomicUsize,
    ended: AtomicBool,
    failure: Mutex<Option<BenchmarkError>>,
    progress: &'a dyn AccountProgress,
}

impl AccountWork<'_> {
    fn worker(&self, pool: &ThreadPool) {
        while !self.ended.load(Ordering::Relaxed) && !self.progress.is_stopped() {
            let place = self.next.fetch_add(1, Ordering::Relaxed);
            let Some(&(task, judgement)) = self.left.get(place) else { return };
            if let Err(error) = self.make(task, judgement, pool) {
                self.ended.store(true, Ordering::Relaxed);
                let mut failure = self.failure.lock().unwrap_or_else(PoisonError::into_inner);
                failure.get_or_insert(error);
            }
        }
    }

    /// Makes an account. One that cannot be made has a file with the reason; a failure of the disk is an error.
    fn make(
        &self,
        task: usize,
        judgement: &Judgement,
        pool: &ThreadPool,
    ) -> Result<(), BenchmarkError> {
        let made =
            catch_unwind(AssertUnwindSafe(|| pool.install(|| self.account(task, judgement))));
        let account = match made {
            Ok(Err(error)) if is_of_the_disk(&error) => return Err(error),
            Ok(account) => account.map_err(|error| error.to_string()),
            Err(_) => Err("the program gave up".to_owned()),
        };
        let path = AccountShard::path(self.folder.root(), task);
        AccountShard::new(self.folder.hash(), judgement, account).write(&path)?;
        self.progress.finish_account();
        Ok(())
    }

    /// The account of a trial, with its logs from the store or made for it.
    fn account(&self, task: usize, judgement: &Judgement) -> Result<TrialAccount, BenchmarkError> {
        if let Some(store) = &self.store {
            return TrialAccount::of_folder(
                &store.trial(self.spec, judgement.seed)?.folder,
                judgement,
            );
        }
        let folder = self.folder.folder("work")?.join(format!("{task:05}-account"));
        population::make(self.spec, judgement.seed, &folder)?;
        let account = TrialAccount::of_folder(&folder, judgement);
        std::fs::remove_dir_all(&folder).map_err(unusable(&folder))?;
        account
    }
}
