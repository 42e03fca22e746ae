//! `diagnosis.json`, as `design` and `export` read it.

use std::path::Path;

use cli::DiagnosisFile;
use diagnosis::SCHEMA;

use super::Reader;
use super::logs_of_kinds::ROBOT;
use super::robots::changed_text;

/// Words of a diagnosis.
const WORDS: &[&str] = &[
    "\"plumbline.diagnosis/1\"",
    "\"coulomb_friction\"",
    "\"joint\": \"j1\"",
    "\"link\": \"fore\"",
    "\"findings\":",
    "null",
    "{",
    "}",
    "[",
    "]",
    "\\u0000",
    "\"",
    ",",
    ":",
];

pub fn readers() -> Vec<Reader> {
    vec![Reader {
        name: "diagnosis",
        file: "diagnosis.json",
        short: 0,
        seeds,
        parsed: None,
        change: changed_text,
        read,
        parse: read,
        words: WORDS,
    }]
}

fn seeds(_: &Path) -> Vec<Vec<u8>> {
    let joint = |name: &str| {
        format!(
            "{{\"name\": {name:?}, \"remaining_rms_nm\": 0.05, \"autocorrelation_time_s\": null}}"
        )
    };
    let at = |effect: &str| format!("\"effect\": {effect:?}, \"joint\": \"j1\", \"link\": null");
    let text = format!(
        r#"{{"schema": {SCHEMA:?}, "data": {{"cutoff_hz": 12.5}}, "joints": [{}, {}],
"findings": [{{{}, "not_separable_from": [{{{}}}], "undetermined": ["level"], "parameters": {{"level":
{{"value": 1.5, "ci95": [1.4, 1.6], "nominal": 0.0, "determined": true}}}}}}],
"provenance": {{"files": [{{"role": "log", "path": "run.csv", "sha256": "00"}}]}}}}"#,
        joint("j1"),
        joint("j2"),
        at("coulomb_friction"),
        at("stribeck_friction")
    );
    vec![text.into_bytes()]
}

fn read(path: &Path) -> Result<(), String> {
    let file = DiagnosisFile::read(path, &ROBOT).map_err(|e| e.to_string())?;
    let _ = (file.findings(&ROBOT).is_ok(), file.goals(&ROBOT).is_ok());
    let _ = (file.noise(), file.cutoff_hz(), file.knows("00"));
    Ok(())
}
