use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest, Sha256};

/// The script of every page: it zooms plots, tells the values below the pointer, sorts tables and
/// copies. A page shows the same without it.
pub const PAGE_SCRIPT: &str = include_str!("../../templates/page.js");

/// What a page may load and run: its own style, its own drawings, and the one script with this hash.
///
/// Source: Content Security Policy Level 3, section 2.3.1, `hash-source`.
pub fn script_policy() -> String {
    let hash = STANDARD.encode(Sha256::digest(PAGE_SCRIPT));
    format!(
        "default-src 'none'; style-src 'unsafe-inline'; img-src data:; script-src 'sha256-{hash}'"
    )
}

#[cfg(test)]
mod tests {
    use askama::Template;

    use super::*;
    use crate::html::page::render_page;
    use crate::output::provenance::Provenance;

    #[derive(Template)]
    #[template(source = "{% extends \"page.html\" %}", ext = "html")]
    struct Bare {
        provenance: Provenance,
        json: &'static str,
    }

    #[test]
    fn the_policy_names_the_one_script_of_the_page_by_its_hash() {
        let provenance = Provenance {
            program: "plumbline",
            version: "0",
            command: Vec::new(),
            files: Vec::new(),
            seed: None,
        };
        let page = render_page(&Bare { provenance, json: "{}" }).unwrap();
        let scripts: Vec<&str> = page.split("<script>").skip(1).collect();
        let [script] = scripts.as_slice() else { panic!("one script") };
        let script = script.split_once("</script>").unwrap().0;
        let hash = STANDARD.encode(Sha256::digest(script));
        assert!(page.contains(&format!("script-src 'sha256-{hash}'\"")), "{hash}");
        assert_eq!(page.matches("script-src").count(), 1);
        assert!(!script.contains("http") && !script.contains("innerHTML"));
    }

    #[test]
    fn the_hash_of_the_policy_agrees_with_the_published_one() {
        // Content Security Policy Level 2, section 7.17.2: alert('Hello, world.');
        let hash = STANDARD.encode(Sha256::digest("alert('Hello, world.');"));
        assert_eq!(hash, "qznLcsROx4GACP2dm0UCKCzCG+HiZ1guq6ZZDob/Tng=");
    }
}
