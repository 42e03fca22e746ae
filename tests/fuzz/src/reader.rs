//! The reader that `READER` names: `READER=CSV cargo +nightly fuzz run --fuzz-dir tests/fuzz reader`.
#![no_main]

use std::sync::LazyLock;

use checks::fuzz::Target;
use checks::targets::{Reader, readers};
use libfuzzer_sys::fuzz_target;

static READER: LazyLock<Reader> = LazyLock::new(|| {
    let name = std::env::var("READER").unwrap_or_else(|_| "CSV".to_owned());
    let all = readers();
    let names: Vec<&str> = all.iter().map(|reader| reader.name).collect();
    let told = format!("READER is {name}, one of {} was expected", names.join(", "));
    all.into_iter().find(|reader| reader.name == name).expect(&told)
});

thread_local! {
    static TARGET: Target<'static> = Target::new(&READER);
}

fuzz_target!(|data: &[u8]| TARGET.with(|target| drop(target.fuzz_target(data))));
