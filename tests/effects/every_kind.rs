//! Every effect of the catalogue has what `crates/effects/README.md` asks of one.

use std::path::Path;

use catalogue::EffectKind;
use checks::arms::workspace_root;
use effects::model;

/// Effects whose model side shares a file: a delay and a lag are one law.
const TOGETHER: [(EffectKind, &str); 2] =
    [(EffectKind::ActuatorDelay, "late_torque"), (EffectKind::ActuatorLag, "late_torque")];

fn text(path: &str) -> String {
    std::fs::read_to_string(workspace_root().join(path)).unwrap_or_default()
}

/// What is missing of an effect, as paths below `root` and words.
fn missing(kind: EffectKind, root: &Path) -> Vec<String> {
    let name = kind.name();
    let mut files = vec![
        format!("crates/simulator/src/effects/{name}.rs"),
        format!("tests/simulator/{name}.rs"),
        format!("scenarios/effects/{name}.toml"),
    ];
    if model(kind).is_ok() {
        let file = TOGETHER.iter().find(|(k, _)| *k == kind).map_or(name, |(_, file)| file);
        files.push(format!("crates/effects/src/causes/{file}.rs"));
    }
    files.retain(|file| !root.join(file).is_file());
    files
}

#[test]
fn every_effect_has_its_files() {
    let root = workspace_root();
    for kind in EffectKind::ALL {
        assert_eq!(missing(kind, &root), [""; 0], "{kind}");
        let scenario = text(&format!("scenarios/effects/{}.toml", kind.name()));
        let written = ["\n", "\n[effect."].map(|before| format!("{before}{}", kind.name()));
        assert!(written.iter().any(|key| scenario.contains(key)), "{kind}: its scenario");
    }
    assert_eq!(missing(EffectKind::Payload, Path::new("nowhere")).len(), 4);
}

/// What has no model says why, in a sentence.
#[test]
fn every_effect_has_a_model_or_says_what_one_would_need() {
    for kind in EffectKind::ALL {
        if let Err(why) = model(kind) {
            assert!(why.split_whitespace().count() > 5, "{kind}: {why}");
        }
    }
}

/// The steps name files and folders that are there.
#[test]
fn the_steps_name_files_that_exist() {
    let readme = text("crates/effects/README.md");
    let paths: Vec<&str> =
        readme.split('`').skip(1).step_by(2).filter(|word| word.contains('/')).collect();
    assert!(paths.len() >= 5, "{paths:?}");
    for path in paths {
        assert!(workspace_root().join(path).exists(), "{path}");
    }
}
