//! What the tests of this crate share.

use quick_xml::Reader;
use quick_xml::events::Event;

/// The text between the tags of a well-formed document.
pub fn text_of_xml(xml: &str) -> String {
    let mut reader = Reader::from_str(xml);
    let mut text = String::new();
    loop {
        match reader.read_event().unwrap() {
            Event::Eof => return text,
            Event::Text(piece) => text.push_str(&piece.decode().unwrap()),
            _ => {}
        }
    }
}
