use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::available_parallelism;

use benchmark::{AccountProgress, CampaignAccount, CampaignFolder, Part, make_accounts};
use cli::{Line, Watch, display_path, print};

use crate::commands::missing::sentences;
use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

/// Arguments of `account`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The folder of a campaign of a population, with trials that are made
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Accounts made at a time; as many as there are processors where it is left out
    #[arg(long, value_name = "N")]
    jobs: Option<NonZeroUsize>,
    /// One part of several, such as 1/4: every fourth trial
    #[arg(long, value_name = "K/N", default_value_t = Part::WHOLE)]
    part: Part,
    /// Take the logs from this folder, as `work --store` does; without it they are made again
    #[arg(long, value_name = "DIR")]
    store: Option<PathBuf>,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
}

/// Shows how many accounts are made; Ctrl-C lets those that are begun come to their end.
struct AccountLine {
    watch: Watch,
    all: AtomicUsize,
    made: AtomicUsize,
}

impl AccountProgress for AccountLine {
    fn begin(&self, left: usize) {
        self.all.store(left, Ordering::Relaxed);
        self.watch.begin(&format!("0 of {left} accounts made"));
    }

    fn finish_account(&self) {
        let made = 1 + self.made.fetch_add(1, Ordering::Relaxed);
        let all = self.all.load(Ordering::Relaxed);
        self.watch.begin(&format!("{made} of {all} accounts made"));
    }

    fn is_stopped(&self) -> bool {
        self.watch.is_stopped()
    }
}

/// Makes the accounts that are left, and prints what all of them say.
pub fn run(arguments: &Arguments) -> Result<BenchExitStatus, BenchError> {
    let folder = CampaignFolder::open(&arguments.folder)?;
    let jobs = arguments.jobs.or(available_parallelism().ok()).unwrap_or(NonZeroUsize::MIN);
    let line = AccountLine {
        watch: Watch::new((!arguments.quiet).then(Line::new))?,
        all: AtomicUsize::new(0),
        made: AtomicUsize::new(0),
    };
    let made = make_accounts(&folder, (arguments.part, jobs), arguments.store.as_deref(), &line);
    line.watch.finish();
    made?;
    let account = CampaignAccount::read(&folder, &folder.manifest()?);
    let json = serde_json::to_string_pretty(&account).map_err(std::io::Error::from)?;
    report::write_folder(&arguments.folder, &[("account.json", json.as_bytes())])?;
    let doubts = doubts(&account);
    if !arguments.quiet {
        let file = display_path(&arguments.folder.join("account.json"));
        print(&format!("{}{}\naccount  {file}\n", account.text(), sentences(&doubts)))?;
    }
    Ok(if doubts.is_empty() { BenchExitStatus::Good } else { BenchExitStatus::Gap })
}

/// What the account lacks, in sentences.
fn doubts(account: &CampaignAccount) -> Vec<String> {
    let failed = account.failed.iter().map(|(task, why)| format!("trial {task} has none: {why}"));
    let otherwise = account.made_otherwise.iter().map(|(task, names)| {
        let names = names.join(", ");
        format!("trial {task} was judged by another program: {names} is not found again")
    });
    let left = (account.left > 0).then(|| {
        format!("{} judged trials have no account yet: plumbline-bench account", account.left)
    });
    failed.chain(otherwise).chain(left).collect()
}
