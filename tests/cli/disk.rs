//! The calls of a program to the files of a folder, told one by one, and one of them refused.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::program::{Answer, PROGRAM};

/// A library that stands between a program and the files of a folder.
pub struct Disk {
    folder: tempfile::TempDir,
}

/// What becomes of one call.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    NoSpace,
    Broken,
    Interrupted,
    /// Half of the bytes are read or written.
    Short,
}

impl Fault {
    /// Its number in Linux, or the word of `disk.c`.
    fn word(self) -> &'static str {
        match self {
            Self::NoSpace => "28",
            Self::Broken => "5",
            Self::Interrupted => "4",
            Self::Short => "short",
        }
    }
}

/// A call, in the words of `disk.c`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Call {
    /// From 1, in the order of the program.
    pub number: u64,
    pub operation: String,
    pub is_refused: bool,
    pub bytes: i64,
    pub path: PathBuf,
    /// The new name of what is renamed.
    pub to: PathBuf,
}

impl Call {
    fn read(line: &str) -> Self {
        let fields: Vec<&str> = line.split('\t').collect();
        Self {
            number: fields[0].parse().unwrap(),
            operation: fields[1].to_owned(),
            is_refused: fields[2] != "0",
            bytes: fields[3].parse().unwrap(),
            path: fields[4].into(),
            to: fields[5].into(),
        }
    }

    /// The faults that such a call can have.
    pub fn faults(&self) -> &'static [Fault] {
        match self.operation.as_str() {
            "write" if self.bytes > 1 => {
                &[Fault::NoSpace, Fault::Broken, Fault::Interrupted, Fault::Short]
            }
            "write" | "create" | "open" | "sync" => {
                &[Fault::NoSpace, Fault::Broken, Fault::Interrupted]
            }
            "read" if self.bytes > 1 => &[Fault::Broken, Fault::Interrupted, Fault::Short],
            "read" | "look" | "close" => &[Fault::Broken, Fault::Interrupted],
            "folder" | "rename" => &[Fault::NoSpace, Fault::Broken],
            "remove" | "cut" => &[Fault::Broken],
            // What fails without a fault, such as a folder that is there already.
            _ => &[],
        }
    }
}

impl Disk {
    /// The library, where there is a compiler of C.
    pub fn build() -> Option<Self> {
        let folder = tempfile::tempdir().unwrap();
        let source = folder.path().join("disk.c");
        fs::write(&source, include_str!("disk.c")).unwrap();
        let mut compiler = Command::new("cc");
        compiler.args(["-O1", "-shared", "-fPIC", "-o"]).arg(folder.path().join("disk.so"));
        let is_built = compiler.arg(&source).arg("-ldl").status().is_ok_and(|s| s.success());
        is_built.then_some(Self { folder })
    }

    /// Runs a command of one thread with a fault, or with none.
    pub fn run(
        &self,
        folder: &Path,
        arguments: &[&str],
        fault: Option<(u64, Fault)>,
    ) -> (Answer, Vec<Call>) {
        let told = self.folder.path().join(folder.file_name().unwrap());
        let _ = fs::remove_file(&told);
        let mut command = checks::program::command(PROGRAM);
        command.current_dir(folder).args(arguments).env("RAYON_NUM_THREADS", "1");
        command.env("LD_PRELOAD", self.folder.path().join("disk.so"));
        command.env("DISK_FOLDER", fs::canonicalize(folder).unwrap()).env("DISK_CALLS", &told);
        if let Some((number, fault)) = fault {
            command.env("DISK_FAULT", format!("{number} {}", fault.word()));
        }
        let answer = command.output().unwrap().into();
        let mut calls: Vec<Call> =
            fs::read_to_string(&told).unwrap().lines().map(Call::read).collect();
        calls.sort_by_key(|call| call.number);
        (answer, calls)
    }
}
