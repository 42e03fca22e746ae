//! Names are the field's: verbs for work, nouns for data, `is_` for questions. What was once called otherwise
//! does not come back.

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
