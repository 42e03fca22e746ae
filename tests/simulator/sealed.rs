use std::collections::BTreeSet;
use std::fs::{self, File};
use std::path::Path;

use catalogue::EffectKind;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use simulator::{LogFormat, simulate, write};

use crate::scenario::{EFFECTS, scenario};

const FORMATS: [LogFormat; 2] = [LogFormat::Parquet, LogFormat::Csv];

/// Everything that a folder of logs tells besides numbers: files, columns, metadata.
#[derive(Debug, PartialEq)]
struct Blinded {
    files: BTreeSet<String>,
    /// Of the log in both formats: its header or schema, and who made it.
    log: Vec<String>,
}

fn blind(more: &str) -> Blinded {
    let scenario = scenario(more);
    let simulation = simulate(&scenario, &|| {}).unwrap();
    let folder = tempfile::tempdir().unwrap();
    for format in FORMATS {
        write(folder.path(), &scenario, &simulation, format).unwrap();
    }
    let entries = fs::read_dir(folder.path()).unwrap();
    let files = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    let mut log = metadata(&folder.path().join("one.parquet"));
    let csv = fs::read_to_string(folder.path().join("one.csv")).unwrap();
    log.push(csv.lines().next().unwrap().to_owned());
    assert!(csv.lines().skip(1).all(|row| row.split(',').all(|x| x.parse::<f64>().is_ok())));
    Blinded { files, log }
}

/// All text of a Parquet file: its footer, and the Arrow schema that is encoded in it.
fn metadata(path: &Path) -> Vec<String> {
    let builder = ParquetRecordBatchReaderBuilder::try_new(File::open(path).unwrap()).unwrap();
    let footer = builder.metadata().file_metadata();
    let pairs = footer.key_value_metadata().into_iter().flatten();
    let keys: Vec<&str> = pairs.map(|pair| pair.key.as_str()).collect();
    assert_eq!(keys, ["ARROW:schema"], "of which the words are those of the schema below");
    let mut all = Vec::new();
    all.extend(footer.created_by().map(str::to_owned));
    all.push(format!("{:?}", footer.schema_descr().root_schema()));
    all.push(format!("{:?} {:?}", builder.schema().metadata(), builder.schema().fields()));
    all
}

#[test]
fn a_log_tells_the_same_whatever_was_put_in() {
    let without = blind("");
    let files = ["one.csv", "one.parquet", "scenario.toml", "truth.json"].map(str::to_owned);
    assert_eq!(without.files, BTreeSet::from(files));
    for effect in EFFECTS {
        assert_eq!(blind(&format!("[[effect]]\n{effect}")), without, "{effect}");
    }
    let hidden = "[hidden]\ncount = [1, 1]\nfrom = ['viscous_friction', 'coulomb_friction']";
    assert_eq!(blind(hidden), without);
}

/// What is never said of a log.
fn words(kind: EffectKind) -> impl Iterator<Item = &'static str> {
    let parameters = kind.entry().parameters.iter().map(|p| p.name);
    parameters.chain([kind.name(), "truth", "hidden", "effect", "effects", "seed", "scenario"])
}

/// Whole words: `ratio` is in `acceleration`.
#[test]
fn no_name_of_an_effect_or_of_its_parameters_is_in_a_log() {
    let text = blind(&format!("[[effect]]\n{}", EFFECTS[0])).log.join("\n").to_lowercase();
    let names = text.split(|c: char| !c.is_ascii_alphabetic() && c != '_');
    let said: BTreeSet<&str> = names.flat_map(|name| name.split('_').chain([name])).collect();
    for expected in ["effort", "velocity", "elbow", "desired_acceleration", "parquet"] {
        assert!(said.contains(expected), "{expected}: the search is blind");
    }
    for kind in EffectKind::ALL {
        for word in words(kind) {
            assert!(!said.contains(word), "{word} of {kind} is said of the log");
        }
        assert!(!text.contains(&kind.code().to_lowercase()), "the code of {kind} is in the log");
    }
}

/// Scenario and truth stand in files of their own.
#[test]
fn the_truth_is_in_its_own_file_and_a_stated_effect_in_the_scenario() {
    for effect in EFFECTS {
        let scenario = scenario(&format!("[[effect]]\n{effect}"));
        let simulation = simulate(&scenario, &|| {}).unwrap();
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), &scenario, &simulation, LogFormat::Csv).unwrap();
        let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
        let name = scenario.effects()[0].kind().name();
        assert!(read("truth.json").contains(&format!("\"{name}\"")), "{name}");
        assert!(read("scenario.toml").contains(name) && !read("one.csv").contains(name), "{name}");
    }
}
