//! Commands that are ended at any moment or find the disk full: what is finished is whole, and the command that is
//! started again gives what it would have given.
//!
//! The long form: `PLUMBLINE_LONG=1 cargo test --release --workspace --test cli faults -- --nocapture`, and `--test bench_cli`.

use std::fs;
use std::io::Read;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use recording::Contents;

use crate::limits::{killed_beyond, with_room};
use crate::program::{Answer, interruptible, run};
use crate::writers::{COMMANDS, content, folder, plan};

/// A command ends, or says that it will, within this time of a signal.
const ANSWER: Duration = Duration::from_secs(1);

/// The signal of a file that becomes larger than it may.
const SIGXFSZ: i32 = 25;

/// Whether files may be there that grow while a command works: logs and recordings of the runs that it tracks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Growing {
    Allowed,
    Refused,
}

/// A folder with what the commands read.
pub struct Place {
    folder: tempfile::TempDir,
    random: ChaCha8Rng,
    /// How long each command takes, its exit code, and its file.
    known: Vec<(Duration, i32, Vec<u8>)>,
    /// The largest file of each command (kB).
    largest_kb: Vec<usize>,
}

impl Place {
    /// The files alone.
    pub fn of_files(seed: u64) -> Self {
        let folder = folder();
        let random = ChaCha8Rng::seed_from_u64(seed);
        Self { folder, random, known: Vec::new(), largest_kb: Vec::new() }
    }

    /// With what every command gives.
    fn new(seed: u64) -> Self {
        let mut place = Self::of_files(seed);
        for (index, (command, _)) in COMMANDS.iter().enumerate() {
            place.prepare(index);
            let start = Instant::now();
            let answer = run(place.path(), &words(index));
            assert!(answer.code <= 1, "{command}: {}", answer.err);
            let file = content(&place.same(index));
            place.known.push((start.elapsed(), answer.code, file));
            place.largest_kb.push(largest_kb(&place.out()));
        }
        place
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    fn out(&self) -> PathBuf {
        self.path().join("out")
    }

    fn same(&self, index: usize) -> PathBuf {
        self.out().join(COMMANDS[index].1)
    }

    /// No folder of an earlier command, but what the command needs to find there.
    pub fn prepare(&self, index: usize) {
        if self.out().exists() {
            fs::remove_dir_all(self.out()).unwrap();
        }
        plan(self.path(), COMMANDS[index].0);
    }

    /// Ends a command at some moment, looks at what is there, and starts it again.
    fn end(&mut self, index: usize) {
        self.prepare(index);
        let mut command = interruptible();
        command.current_dir(self.path()).args(words(index));
        let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        sleep(self.known[index].0.mul_f64(self.random.random_range(0.0..1.1)));
        let signal = ["-INT", "-TERM", "-KILL"][self.random.random_range(0..3)];
        ended(child, signal, COMMANDS[index].0);
        assert_whole(&self.out(), Growing::Allowed);
        let again = run(self.path(), &words(index));
        self.assert_same(index, &again);
    }

    /// Runs a command where no file may become as large as its largest one is.
    fn fill(&mut self, index: usize) {
        self.prepare(index);
        let kb = self.random.random_range(0..self.largest_kb[index].max(1));
        let answer = with_room(self.path(), kb, &words(index));
        assert_eq!(answer.code, 2, "{}, {kb} kB: {}", COMMANDS[index].0, answer.err);
        assert!(answer.err.contains("out/"), "{kb} kB: {}", answer.err);
        assert_whole(&self.out(), Growing::Allowed);
    }

    /// Kills a command in the middle of its largest file, or of an earlier one, looks at what is there, and starts it
    /// again.
    fn kill_in_a_file(&mut self, index: usize) {
        self.prepare(index);
        let kb = self.random.random_range(0..self.largest_kb[index].max(1));
        let killed = killed_beyond(self.path(), kb, &words(index)).status;
        assert_eq!(killed.signal(), Some(SIGXFSZ), "{}, {kb} kB: {killed}", COMMANDS[index].0);
        assert_whole(&self.out(), Growing::Allowed);
        let again = run(self.path(), &words(index));
        self.assert_same(index, &again);
    }

    fn assert_same(&self, index: usize, answer: &Answer) {
        let (_, code, file) = &self.known[index];
        assert_eq!(answer.code, *code, "{}: {}", COMMANDS[index].0, answer.err);
        assert!(content(&self.same(index)) == *file, "{}", COMMANDS[index].0);
        assert_whole(&self.out(), Growing::Refused);
        assert!(temporary(&self.out()).is_empty(), "{}", COMMANDS[index].0);
    }

    fn campaign(&mut self, [ends, kills, disks]: [usize; 3]) {
        for number in 0..ends {
            self.end(number % COMMANDS.len());
        }
        for number in 0..kills {
            self.kill_in_a_file(number % COMMANDS.len());
        }
        for number in 0..disks {
            self.fill(number % COMMANDS.len());
        }
        println!(
            "{ends} commands were ended, {kills} killed in the middle of a file, {disks} found the disk full"
        );
    }
}

/// Size of the largest file in and below a folder (kB).
fn largest_kb(folder: &Path) -> usize {
    let size = |path: PathBuf| {
        if path.is_dir() { largest_kb(&path) } else { fs::read(path).unwrap().len() / 1024 }
    };
    fs::read_dir(folder).unwrap().map(|entry| size(entry.unwrap().path())).max().unwrap_or(0)
}

/// The files under temporary names in and below a folder.
fn temporary(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let of = |path: PathBuf| match path.is_dir() {
        true => temporary(&path),
        false => vec![path],
    };
    let is_temporary = |path: &PathBuf| {
        path.file_name().is_some_and(|name| name.to_string_lossy().starts_with(".plumbline-"))
    };
    entries.flat_map(of).filter(is_temporary).collect()
}

/// The arguments of a command.
pub fn words(index: usize) -> Vec<&'static str> {
    COMMANDS[index].0.split(' ').collect()
}

/// Sends a signal. The program ends; at Ctrl-C it may say that it comes to its end, and a second one ends it.
fn ended(mut child: Child, signal: &str, command: &str) {
    if ends_at(&mut child, signal) {
        return;
    }
    assert_eq!(signal, "-INT", "{command}");
    assert!(ends_at(&mut child, "-INT"), "{command}: two interrupts");
    let mut told = String::new();
    child.stderr.take().unwrap().read_to_string(&mut told).unwrap();
    assert!(told.contains("stopping: "), "{command}: {told}");
}

/// Whether a program ends within [`ANSWER`] of a signal. Beside other work it gets its turn later, as the program that
/// sends the signal does.
fn ends_at(child: &mut Child, signal: &str) -> bool {
    let start = Instant::now();
    // A program that has ended already cannot be reached.
    let _ = Command::new("kill").args([signal, &child.id().to_string()]).output().unwrap();
    let patience = ANSWER + 20 * start.elapsed();
    while start.elapsed() < patience {
        if child.try_wait().unwrap().is_some() {
            return true;
        }
        sleep(Duration::from_millis(5));
    }
    false
}

/// Every file of a finished name is whole: its beginning and its end are those of its kind.
fn assert_whole(folder: &Path, growing: Growing) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for path in entries.map(|entry| entry.unwrap().path()) {
        let name = path.file_name().unwrap().to_str().unwrap();
        // What is being worked on has a folder of its own, or a temporary name.
        if name.starts_with('.') || name == "work" {
            continue;
        }
        if path.is_dir() {
            assert_whole(&path, growing);
            continue;
        }
        if growing == Growing::Allowed && grows(&path) {
            continue;
        }
        assert!(is_whole(&path), "{}", path.display());
    }
}

/// Whether the beginning and the end of a file are those of its kind.
pub fn is_whole(path: &Path) -> bool {
    let bytes = fs::read(path).unwrap();
    let ends = |end: &str| bytes.trim_ascii_end().ends_with(end.as_bytes());
    match path.extension().and_then(|e| e.to_str()).unwrap_or_default() {
        "json" => serde_json::from_slice::<serde_json::Value>(&bytes).is_ok(),
        "toml" => std::str::from_utf8(&bytes).is_ok_and(|t| t.parse::<toml::Table>().is_ok()),
        "parquet" => bytes.len() > 8 && bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"),
        "html" => ends("</html>"),
        "svg" => ends("</svg>"),
        "urdf" => ends("</robot>"),
        "csv" => bytes.ends_with(b"\n"),
        "rrd" => Contents::read(path).is_ok_and(|found| found.is_whole),
        // A kind of file that nothing is known of.
        _ => false,
    }
}

/// Whether a file is the log or the recording of a run that is tracked, there while it is written.
pub fn grows(path: &Path) -> bool {
    let of = |folder: &str, kind: &str| {
        path.parent().is_some_and(|parent| parent.ends_with(folder))
            && path.extension().is_some_and(|e| e == kind)
    };
    of("logs", "csv") || of("recordings", "rrd")
}

#[test]
fn commands_that_are_ended_or_find_the_disk_full_lose_nothing() {
    match checks::round::fresh_seeds() {
        None => Place::new(1).campaign([COMMANDS.len(); 3]),
        Some(first) => Place::new(first).campaign([200, 55, 33]),
    }
}
