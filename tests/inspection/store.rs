//! What is told of the trials of a store, by fault, and falsely of those that nothing has spoilt.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

use inspection::{Observation, Spoils, inspect};
use population::TruthSheet;
use robot::Robot;

use crate::recorded::read_logs;

/// Share of unspoilt trials of which something may be told that spoils them.
const FALSE: f64 = 0.01;

fn trials(root: &Path) -> Vec<PathBuf> {
    let inner = |folder: PathBuf| std::fs::read_dir(folder).unwrap().map(|f| f.unwrap().path());
    let of_a_key = |f: &PathBuf| f.is_dir() && f.file_name().is_some_and(|name| name.len() == 2);
    let folders = inner(root.to_owned()).filter(of_a_key).flat_map(inner);
    let mut all: Vec<PathBuf> = folders.filter(|f| f.join(TruthSheet::FILE).exists()).collect();
    all.sort();
    all
}

/// Trials with a fault: told, not told, and refused while their logs are read.
#[derive(Default)]
struct Count {
    told: usize,
    missed: usize,
    refused: usize,
}

/// With `PLUMBLINE_STORE`, the folder of a store.
#[test]
fn unspoilt_trials_of_a_store_are_let_through() {
    let Some(root) = std::env::var_os("PLUMBLINE_STORE") else {
        println!("skipped: set PLUMBLINE_STORE to the folder of a store");
        return;
    };
    let mut faults: BTreeMap<String, Count> = BTreeMap::new();
    let (mut unspoilt, mut wrong, mut slowest_s) = (0, Vec::new(), 0.0_f64);
    for folder in trials(Path::new(&root)) {
        let sheet = TruthSheet::open(&folder).unwrap();
        let fault = sheet.strangers.iter().find(|s| s.name.starts_with("log: "));
        let robot = Robot::load(&folder.join("nominal/robot.toml")).unwrap().robot;
        let Ok(runs) = read_logs(&folder.join("logs"), &robot) else {
            let name = fault.map_or("none", |fault| &fault.name);
            faults.entry(name.to_owned()).or_default().refused += 1;
            continue;
        };
        let start = Instant::now();
        let told = inspect(&robot, &runs);
        slowest_s = slowest_s.max(start.elapsed().as_secs_f64());
        let spoils = told.iter().any(|o: &Observation| o.spoils > Spoils::Nothing);
        let sentences = || told.iter().map(|o| o.sentence(&robot, &runs)).collect::<Vec<_>>();
        println!("{}: {:?} {:#?}", folder.display(), fault.map(|f| &f.name), sentences());
        match fault {
            Some(fault) => {
                let count = faults.entry(fault.name.clone()).or_default();
                if spoils { count.told += 1 } else { count.missed += 1 }
            }
            None => {
                unspoilt += 1;
                wrong.extend(spoils.then(sentences));
            }
        }
    }
    for (name, Count { told, missed, refused }) in &faults {
        println!("{name:32} told {told}, not told {missed}, refused {refused}");
    }
    println!("false at {} of {unspoilt} unspoilt trials; slowest {slowest_s:.3} s", wrong.len());
    assert!(wrong.len() as f64 <= FALSE * f64::from(unspoilt), "{wrong:#?}");
}
