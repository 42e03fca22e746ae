use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

/// Bytes at the start of a text that are examined.
const HEAD: u64 = 1 << 16;

/// Bytes of a binary STL before its triangles, and of each of them.
const STL_HEAD: u64 = 84;
const STL_TRIANGLE: u64 = 50;

/// Whether a regular file is a mesh of the kind that its name says: STL, OBJ, COLLADA, glTF or GLB.
///
/// ```text
/// .stl   84 bytes and 50 a triangle, as many as it says, or `solid` with facets
/// .obj   lines of known words, a vertex among them
/// .dae   XML of <COLLADA>
/// .gltf  JSON with `asset`
/// .glb   `glTF` and its own length
/// ```
///
/// The extension alone is not trusted, since the content of the file would be copied into a recording.
pub(crate) fn is_mesh(path: &Path, bytes: u64) -> bool {
    let kind = path.extension().and_then(|e| e.to_str()).map(str::to_lowercase);
    let Ok(mut file) = files::open(path) else { return false };
    let head = head(&mut file);
    let is_text = !head.contains(&0);
    let text = String::from_utf8_lossy(&head);
    match kind.as_deref() {
        Some("stl") => {
            is_binary_stl(&head, bytes) || is_text && is_text_stl(&text, &mut file, bytes)
        }
        Some("obj") => is_text && is_obj(&text, bytes),
        Some("dae") => is_text && text.trim_start().starts_with('<') && text.contains("<COLLADA"),
        Some("gltf") => is_text && text.trim_start().starts_with('{') && text.contains("\"asset\""),
        Some("glb") => {
            head.starts_with(b"glTF") && number(&head, 8).is_some_and(|own| u64::from(own) == bytes)
        }
        _ => false,
    }
}

fn head(file: &mut File) -> Vec<u8> {
    let mut bytes = Vec::new();
    // What cannot be read is no mesh.
    let _ = file.take(HEAD).read_to_end(&mut bytes);
    bytes
}

/// The little-endian number of four bytes at an offset.
fn number(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?))
}

fn is_binary_stl(head: &[u8], bytes: u64) -> bool {
    number(head, 80).is_some_and(|count| STL_HEAD + STL_TRIANGLE * u64::from(count) == bytes)
}

fn is_text_stl(head: &str, file: &mut File, bytes: u64) -> bool {
    let mut lines = head.lines().map(str::trim).filter(|line| !line.is_empty());
    let begins = lines.next().is_some_and(|line| line.starts_with("solid"));
    let facets =
        lines.next().is_some_and(|line| line.starts_with("facet") || line.starts_with("endsolid"));
    let mut tail = String::new();
    let ends = file.seek(SeekFrom::Start(bytes.saturating_sub(200))).is_ok()
        && file.read_to_string(&mut tail).is_ok()
        && tail.contains("endsolid");
    begins && facets && ends
}

fn is_obj(head: &str, bytes: u64) -> bool {
    const WORDS: [&str; 18] = [
        "v", "vt", "vn", "vp", "f", "l", "p", "o", "g", "s", "mtllib", "usemtl", "mg", "lod",
        "bevel", "c_interp", "d_interp", "cstype",
    ];
    // The last line of a longer file may be cut.
    let whole =
        if bytes > HEAD { head.rsplit_once('\n').map_or("", |(lines, _)| lines) } else { head };
    let mut lines =
        whole.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let known =
        |line: &str| line.split_whitespace().next().is_some_and(|word| WORDS.contains(&word));
    lines.clone().any(|line| line.starts_with("v ")) && lines.all(known)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_recognised(name: &str, content: &[u8]) -> bool {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, content).unwrap();
        is_mesh(&path, content.len() as u64)
    }

    #[test]
    fn meshes_are_told_from_files_that_have_their_names() {
        let triangle = [&[0_u8; 80][..], &1_u32.to_le_bytes(), &[0; 50]].concat();
        let glb = [&b"glTF"[..], &2_u32.to_le_bytes(), &12_u32.to_le_bytes()].concat();
        for (name, content) in [
            ("a.stl", &triangle[..]),
            ("a.STL", b"solid a\n facet normal 0 0 1\n endfacet\nendsolid a\n"),
            ("a.obj", b"# cube\no cube\nv 0 0 0\nv 1 0 0\nf 1 2 1\n"),
            ("a.dae", b"<?xml version=\"1.0\"?>\n<COLLADA/>"),
            ("a.gltf", b"{\"asset\": {\"version\": \"2.0\"}}"),
            ("a.glb", &glb),
        ] {
            assert!(is_recognised(name, content), "{name}");
            let secret = b"root:x:0:0:root:/root:/bin/sh\n".repeat(20);
            assert!(!is_recognised(name, &secret) && !is_recognised(name, b""), "{name}");
            assert!(!is_recognised("a.txt", content));
        }
        assert!(!is_recognised("a.stl", &triangle[..130]));
    }
}
