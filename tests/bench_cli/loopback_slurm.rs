//! A cluster of two nodes, `n1` and `n2`, on this machine alone.

use std::fs::{self, File};
use std::io::Read;
use std::net::TcpListener;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

const PROGRAMS: [&str; 7] =
    ["munged", "slurmctld", "slurmd", "sbatch", "scontrol", "sinfo", "squeue"];

/// Where daemons lie besides the PATH.
const PLACES: [&str; 2] = ["/usr/sbin", "/usr/local/sbin"];

/// Lines of each log that a failure shows.
const LINES: usize = 25;

/// Its daemons run until it is dropped.
pub struct LoopbackSlurm {
    folder: tempfile::TempDir,
    daemons: Vec<(&'static str, Child)>,
}

impl LoopbackSlurm {
    /// Starts it on free ports. None, with a line on stdout, where Slurm is not installed.
    pub fn start() -> Option<Self> {
        if let Some(missing) = PROGRAMS.iter().find(|name| found(name).is_none()) {
            println!("skipped: there is no {missing} here (apt-get install slurm-wlm munge)");
            return None;
        }
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path();
        // Whoever speaks to munge has to reach its socket.
        fs::set_permissions(path, fs::Permissions::from_mode(0o755)).unwrap();
        fs::write(path.join("munge.key"), random_bytes()).unwrap();
        fs::set_permissions(path.join("munge.key"), fs::Permissions::from_mode(0o600)).unwrap();
        fs::create_dir(path.join("state")).unwrap();
        ["n1", "n2"].iter().for_each(|node| fs::create_dir(path.join(node)).unwrap());
        fs::write(path.join("slurm.conf"), configuration(path)).unwrap();

        let mut slurm = Self { folder, daemons: Vec::new() };
        let at = |name: &str| slurm.at(name).display().to_string();
        let [socket, key, seed, pid] =
            ["munge.socket", "munge.key", "munge.seed", "munged.pid"].map(at);
        let options = [
            "--foreground".to_owned(),
            "--force".to_owned(),
            format!("--socket={socket}"),
            format!("--key-file={key}"),
            format!("--seed-file={seed}"),
            format!("--pid-file={pid}"),
        ];
        slurm.spawn("munged", "munged", &options);
        slurm.wait("munged to open its socket", 30, |slurm| slurm.at("munge.socket").exists());
        slurm.spawn("slurmctld", "slurmctld", &["-D".to_owned()]);
        for node in ["n1", "n2"] {
            slurm.spawn(node, "slurmd", &["-D", "-N", node].map(str::to_owned));
        }
        slurm.wait("two idle nodes", 60, |slurm| {
            slurm.ask("sinfo", &["-hNo", "%T"]) == "idle\nidle"
        });
        Some(slurm)
    }

    /// A command that speaks to this cluster and knows of no other.
    pub fn command(&self, mut command: Command) -> Command {
        for (name, _) in std::env::vars_os() {
            let text = name.to_string_lossy();
            if ["SLURM", "SBATCH", "SQUEUE", "SINFO"].iter().any(|start| text.starts_with(start)) {
                command.env_remove(&name);
            }
        }
        command.env("SLURM_CONF", self.at("slurm.conf"));
        command
    }

    /// What one of Slurm's own programs says; nothing where it fails.
    pub fn ask(&self, program: &str, arguments: &[&str]) -> String {
        let command = Command::new(found(program).unwrap());
        let output = self.command(command).args(arguments).output().unwrap();
        let text = String::from_utf8_lossy(&output.stdout).trim().to_owned();
        if output.status.success() { text } else { String::new() }
    }

    /// What Slurm knows of a job, such as `Restarts`.
    pub fn fact(&self, job: &str, name: &str) -> String {
        let text = self.ask("scontrol", &["--oneliner", "show", "job", job]);
        let mut facts = text.split_whitespace().filter_map(|fact| fact.split_once('='));
        facts.find(|(found, _)| *found == name).map_or(String::new(), |(_, fact)| fact.to_owned())
    }

    /// The processes of jobs on a node.
    pub fn processes(&self, node: &str) -> Vec<Process> {
        let configuration = self.at("slurm.conf").display().to_string();
        let entries = fs::read_dir("/proc").unwrap().filter_map(Result::ok);
        let numbers = entries.filter_map(|entry| entry.file_name().to_str()?.parse().ok());
        let is_ours = |process: &Process| {
            process.variable("SLURM_CONF") == Some(&configuration)
                && process.variable("SLURMD_NODENAME") == Some(node)
        };
        numbers.map(Process::of_number).filter(is_ours).collect()
    }

    /// Kills all there is of a node at once, as a loss of power would; Slurm is told nothing.
    pub fn lose(&mut self, node: &str) {
        let jobs = self.processes(node);
        let (_, slurmd) = self.daemons.iter_mut().find(|(name, _)| *name == node).unwrap();
        slurmd.kill().unwrap();
        slurmd.wait().unwrap();
        jobs.iter().filter_map(Process::step).for_each(|step| signal("KILL", step));
        jobs.iter().for_each(|job| job.signal("KILL"));
        self.wait(&format!("the processes of {node} to be gone"), 30, |slurm| {
            slurm.processes(node).is_empty()
        });
    }

    /// Waits for something, some seconds at most; stops the test with what the daemons have
    /// written when it does not come.
    pub fn wait(&self, what: &str, limit_s: u64, mut is_there: impl FnMut(&Self) -> bool) {
        let start = Instant::now();
        while !is_there(self) {
            let waited = start.elapsed();
            let logs = || self.logs();
            assert!(waited < Duration::from_secs(limit_s), "{limit_s} s for {what}\n{}", logs());
            sleep(Duration::from_millis(10));
        }
    }

    /// The last lines of what the daemons have written.
    pub fn logs(&self) -> String {
        let entries = fs::read_dir(self.folder.path()).unwrap();
        let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
        paths.retain(|path| path.extension().is_some_and(|e| e == "log"));
        paths.sort();
        let last = |path: &PathBuf| {
            let text = fs::read(path).unwrap_or_default();
            let text = String::from_utf8_lossy(&text).into_owned();
            let lines: Vec<&str> = text.lines().collect();
            let last = lines[lines.len().saturating_sub(LINES)..].join("\n");
            format!("== {}\n{last}\n", path.file_name().unwrap().display())
        };
        paths.iter().map(last).collect()
    }

    fn at(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn spawn(&mut self, name: &'static str, program: &str, options: &[String]) {
        let said = File::create(self.at(&format!("{name}.log"))).unwrap();
        let mut command = self.command(Command::new(found(program).unwrap()));
        command.args(options).stdin(Stdio::null()).stdout(said.try_clone().unwrap()).stderr(said);
        self.daemons.push((name, command.spawn().unwrap()));
    }
}

impl Drop for LoopbackSlurm {
    fn drop(&mut self) {
        for node in ["n1", "n2"] {
            self.processes(node).iter().for_each(|job| job.signal("KILL"));
        }
        for (_, daemon) in self.daemons.iter_mut().rev() {
            signal("TERM", daemon.id());
            let start = Instant::now();
            while matches!(daemon.try_wait(), Ok(None)) && start.elapsed() < Duration::from_secs(5)
            {
                sleep(Duration::from_millis(10));
            }
            let _ = daemon.kill();
            let _ = daemon.wait();
        }
    }
}

/// A process of a job.
pub struct Process {
    number: u32,
    environment: Vec<String>,
}

impl Process {
    fn of_number(number: u32) -> Self {
        let environment = fs::read(format!("/proc/{number}/environ")).unwrap_or_default();
        let environment = String::from_utf8_lossy(&environment);
        Self { number, environment: environment.split('\0').map(str::to_owned).collect() }
    }

    /// A variable of the environment that it was started with.
    pub fn variable(&self, name: &str) -> Option<&str> {
        let mut all = self.environment.iter().filter_map(|variable| variable.split_once('='));
        all.find(|(found, _)| *found == name).map(|(_, value)| value)
    }

    /// Sends it a signal; it may be gone.
    pub fn signal(&self, name: &str) {
        signal(name, self.number);
    }

    /// The process of Slurm that has started it, and would tell of its end.
    fn step(&self) -> Option<u32> {
        let status = fs::read_to_string(format!("/proc/{}/status", self.number)).ok()?;
        let parent = status.lines().find_map(|line| line.strip_prefix("PPid:"))?;
        let parent = parent.trim().parse().ok()?;
        let name = fs::read_to_string(format!("/proc/{parent}/comm")).ok()?;
        name.starts_with("slurmstepd").then_some(parent)
    }
}

fn signal(name: &str, process: u32) {
    let mut kill = Command::new("kill");
    let _ = kill.args([&format!("-{name}"), &process.to_string()]).stderr(Stdio::null()).status();
}

fn found(program: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders = std::env::split_paths(&path).chain(PLACES.map(PathBuf::from));
    folders.map(|folder| folder.join(program)).find(|path| path.is_file())
}

fn random_bytes() -> Vec<u8> {
    let mut bytes = vec![0; 128];
    File::open("/dev/urandom").unwrap().read_exact(&mut bytes).unwrap();
    bytes
}

/// A node counts as lost after `SlurmdTimeout`; what ran on it begins anew when the credential of
/// its job has run out, after `cred_expire`.
fn configuration(folder: &Path) -> String {
    let free = [(); 3].map(|()| TcpListener::bind("127.0.0.1:0").unwrap());
    let [controller, n1, n2] = free.map(|port| port.local_addr().unwrap().port());
    let host = fs::read_to_string("/proc/sys/kernel/hostname").unwrap();
    let host = host.trim().split('.').next().unwrap();
    let user = Command::new("id").arg("-un").output().unwrap().stdout;
    let user = String::from_utf8(user).unwrap();
    let (user, at) = (user.trim(), folder.display());
    format!(
        "ClusterName=loopback\nSlurmctldHost={host}(127.0.0.1)\nSlurmctldPort={controller}\n\
         AuthType=auth/munge\nCredType=cred/munge\n\
         AuthInfo=socket={at}/munge.socket,cred_expire=5\n\
         SlurmUser={user}\nSlurmdUser={user}\n\
         StateSaveLocation={at}/state\nSlurmdSpoolDir={at}/%n\n\
         SlurmctldPidFile={at}/slurmctld.pid\nSlurmdPidFile={at}/%n.pid\n\
         ProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\nMpiDefault=none\n\
         SwitchType=switch/none\nJobAcctGatherType=jobacct_gather/none\n\
         AccountingStorageType=accounting_storage/none\n\
         SelectType=select/cons_tres\nSelectTypeParameters=CR_Core\n\
         SchedulerParameters=batch_sched_delay=0,sched_interval=1\n\
         SlurmdTimeout=5\nMessageTimeout=5\nReturnToService=2\n\
         NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={n1} CPUs=1\n\
         NodeName=n2 NodeHostname={host} NodeAddr=127.0.0.1 Port={n2} CPUs=1\n\
         PartitionName=main Nodes=ALL Default=YES State=UP\n"
    )
}
