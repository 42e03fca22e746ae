//! Names are the field's: verbs for work, nouns for data, `is_` for questions. What was once called otherwise
//! does not come back.

use std::collections::BTreeMap;

use crate::assert_kept;
use crate::modules::{tokens, without_tests};
use crate::tree::{folders, rust_files, text};

/// Names that are refused in code, and what is said instead.
#[rustfmt::skip]
const REFUSED: [(&str, &str); 54] = [
    ("Germ", "TrialShape"), ("germ", "trial shape"), ("germs", "trial_shapes"), ("weeded", "without_unused_shapes"),
    ("sow", "set_shape"), ("sown", "with_best_shapes"),
    ("Still", "the noun of what it holds"), ("heard", "tones_left_by"), ("Heard", "Oscillations"),
    ("listened", "find_tones"), ("hearing", "with_tones"),
    ("Study", "Inputs"), ("Searched", "FittedModel"), ("Settled", "Accepted"), ("Conclusion", "Findings"), ("settle", "physical_inertias"), ("settled", "accept"),
    ("Contest", "Twins"), ("contested", "a verb"), ("Apart", "Separated"), ("Worse", "PairedDifference"),
    ("Failed", "KeptNominal"), ("withheld", "inconstant"), ("Between", "the noun of what lies between"),
    ("bearer", "modifier_of"), ("untenable", "find_undetermined"), ("Beliefs", "Prior"), ("beliefs", "prior"),
    ("that_predicts", "keep_what_predicts"),
    ("Nature", "Traits"), ("Seat", "Location"), ("Shows", "RevealedBy"), ("Firm", "Exact"), ("Rough", "Approximate"),
    ("Doubtful", "imitable"), ("rarity", "prior_log_odds_against"),
    ("Parted", "Deflection"), ("Carried", "LoadAlong"), ("Slack", "GapState"), ("Give", "Compliance"),
    ("Crew", "Workers"), ("crew", "workers"), ("Shift", "WorkerRun"), ("Lessened", "Reduction"), ("lessened", "reduction"), ("NoPart", "BadPart"), ("PutIn", "Injected"), ("gathered", "dataset"), ("Gathered", "Dataset"), ("sealed", "blinded"), ("Sealed", "Blinded"),
    ("Strange", "WithoutRelatives"),
    ("Asked", "Request"), ("Wanted", "Target"),
];

/// The refused names in the code of a file.
fn refused(text: &str) -> Vec<String> {
    let (code, _) = without_tests(tokens(text));
    let told = REFUSED.iter().filter(|(name, _)| code.iter().any(|token| token == name));
    told.map(|(name, instead)| format!("{name}: say {instead}")).collect()
}

#[test]
fn names_are_those_of_the_field() {
    let sources = folders("crates").into_iter().map(|name| format!("crates/{name}/src"));
    let files: Vec<String> = sources.flat_map(|folder| rust_files(&folder)).collect();
    assert!(!files.is_empty());
    let broken = files.iter().flat_map(|file| {
        let told = refused(&text(file));
        told.into_iter().map(move |told| format!("{file}: {told}"))
    });
    assert_kept(&broken.collect::<Vec<_>>());
}

#[test]
fn a_refused_name_is_reported_in_code_and_left_in_prose() {
    let told = refused("fn sown(germ: &Germ) {}");
    assert_eq!(told.len(), 3, "{told:?}");
    assert_kept(&refused("/// A germ.\nconst A: &str = \"germ\";"));
}

/// Past participles that do not end in `ed`.
const IRREGULAR: [&str; 19] = [
    "told", "known", "drawn", "given", "taken", "found", "left", "kept", "held", "made", "shown",
    "written", "worn", "said", "seen", "lost", "sown", "heard", "sought",
];

/// Words in `ed` that are verbs or nouns.
const NO_PARTICIPLES: [&str; 10] =
    ["seed", "speed", "feed", "need", "embed", "exceed", "proceed", "shed", "bed", "red"];

/// The functions of a file that are called by a past participle alone.
fn participles(text: &str) -> Vec<String> {
    let (code, _) = without_tests(tokens(text));
    let names = code.windows(2).filter(|pair| pair[0] == "fn").map(|pair| pair[1].clone());
    let is_participle = |name: &String| {
        let is_regular = name.ends_with("ed") && !name.contains('_');
        IRREGULAR.contains(&name.as_str())
            || (is_regular && !NO_PARTICIPLES.contains(&name.as_str()))
    };
    names.filter(is_participle).collect()
}

#[test]
fn functions_are_verbs_or_nouns() {
    let sources = folders("crates").into_iter().map(|name| format!("crates/{name}/src"));
    let files: Vec<String> = sources.flat_map(|folder| rust_files(&folder)).collect();
    assert!(!files.is_empty());
    let broken = files.iter().flat_map(|file| {
        let names = participles(&text(file));
        names.into_iter().map(move |name| {
            format!("{file}: fn {name}: say what it does (a verb) or what it gives (a noun)")
        })
    });
    assert_kept(&broken.collect::<Vec<_>>());
}

#[test]
fn a_function_called_by_a_participle_is_reported() {
    let text = "fn scaled() {} fn drawn() {} fn seed() {} fn is_named() {} fn scale() {}";
    assert_eq!(participles(text), ["scaled", "drawn"]);
    assert_kept(&participles("// fn drawn() {}\nfn draw(drawn: f64) {}"));
    assert_kept(&participles("#[cfg(test)]\nmod tests { fn drawn() {} }"));
}

/// A type with and without a feature of cargo: one thing in two files.
const ONE_THING: [&str; 1] = ["Recorder"];

/// The types that a file declares for its crate or for all; a command's `Arguments` stand in every command.
fn declared_types(text: &str) -> Vec<String> {
    let (code, _) = without_tests(tokens(text));
    let mut types = Vec::new();
    for (i, _) in code.iter().enumerate().filter(|(_, word)| *word == "pub") {
        // `pub(super)` is a room's own.
        let scope = match code.get(i + 1..i + 3) {
            Some([open, word]) if open == "(" && word == "crate" => 3,
            _ => 0,
        };
        let [kind, name] = [1, 2].map(|k| code.get(i + scope + k).map_or("", String::as_str));
        if ["struct", "enum", "trait", "type"].contains(&kind) && name != "Arguments" {
            types.push(name.to_owned());
        }
    }
    types
}

/// Whether all files are those of one effect on the two sides of the wall, where it has one name on purpose.
fn is_one_effect(files: &[&str]) -> bool {
    let stem = |file: &str| file.rsplit('/').next().unwrap_or_default().to_owned();
    let sides = ["crates/effects/src/causes/", "crates/simulator/src/effects/"];
    let at_side = |file: &&&str| sides.iter().any(|side| file.starts_with(side));
    files.len() == 2
        && files.iter().filter(at_side).count() == 2
        && stem(files[0]) == stem(files[1])
}

/// The names of types that stand for more than one thing, in files with these texts.
fn names_of_two(files: &[(&str, &str)]) -> Vec<String> {
    let mut all: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for (file, text) in files {
        for name in declared_types(text) {
            all.entry(name).or_default().push(file);
        }
    }
    let two = all.iter().filter(|(name, files)| {
        files.len() > 1 && !is_one_effect(files) && !ONE_THING.contains(&name.as_str())
    });
    two.map(|(name, files)| format!("{name} stands for a thing each in {}", files.join(", ")))
        .collect()
}

#[test]
fn a_type_name_stands_for_one_thing() {
    let sources = folders("crates").into_iter().map(|name| format!("crates/{name}/src"));
    let files: Vec<String> = sources.flat_map(|folder| rust_files(&folder)).collect();
    let texts: Vec<String> = files.iter().map(|file| text(file)).collect();
    let read: Vec<(&str, &str)> =
        files.iter().map(String::as_str).zip(texts.iter().map(String::as_str)).collect();
    assert!(!read.is_empty());
    assert_kept(&names_of_two(&read));
}

#[test]
fn a_type_name_of_two_things_is_reported() {
    let [a, b] = ["pub struct Row;", "pub(crate) enum Row { A }\nstruct Own;"];
    assert_eq!(
        names_of_two(&[("a.rs", a), ("b.rs", b)]),
        ["Row stands for a thing each in a.rs, b.rs"]
    );
    let [cause, effect] =
        ["crates/effects/src/causes/payload.rs", "crates/simulator/src/effects/payload.rs"];
    assert_kept(&names_of_two(&[(cause, "pub struct Payload;"), (effect, "pub struct Payload;")]));
    assert_eq!(names_of_two(&[(cause, a), ("b.rs", b)]).len(), 1);
    assert_kept(&names_of_two(&[
        ("a.rs", a),
        ("b.rs", "struct Row;\n#[cfg(test)]\npub struct Row;"),
    ]));
}
