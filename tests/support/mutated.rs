//! Inputs that a few mistakes turned into others. Most still pass the door, so that what lies behind it is tried.

use rand::{Rng, RngExt};

/// Numbers at which readers go wrong.
const ODD: [&str; 22] = [
    "0",
    "-0.0",
    "1",
    "-1",
    "2",
    "1e-320",
    "1e-9",
    "0.5",
    "1e9",
    "1e30",
    "1e308",
    "-1e308",
    "nan",
    "inf",
    "-inf",
    "65536",
    "4294967296",
    "9007199254740993",
    "-9223372036854775808",
    "18446744073709551616",
    "1e",
    "0x10",
];

/// Texts where another one was expected.
const STRANGE: [&str; 12] =
    ["", " ", "\"", "'", "<", "&#0;", "\0", "\u{feff}", "../../etc/passwd", "/dev/zero", "ä", "[["];

/// A text with one to four changes of its numbers, words, lines and stretches; rarely of its bytes.
pub fn text(text: &str, random: &mut impl Rng) -> Vec<u8> {
    let mut pieces: Vec<String> = pieces(text);
    for _ in 0..changes(random) {
        if !pieces.is_empty() {
            change(&mut pieces, random);
        }
    }
    let changed = pieces.concat().into_bytes();
    if random.random_ratio(1, 12) { bytes(&changed, random) } else { changed }
}

/// One in most inputs, up to four in the rest.
fn changes(random: &mut impl Rng) -> usize {
    if random.random_ratio(3, 5) { 1 } else { random.random_range(2..5) }
}

/// Numbers, words, and every other character on its own.
fn pieces(text: &str) -> Vec<String> {
    let mut pieces: Vec<String> = Vec::new();
    for c in text.chars() {
        let joins = |last: &String| {
            let word = |c: char| c.is_alphanumeric() || c == '_';
            let number = is_number(last) && (c == '.' || (c == '-' && last.ends_with('e')));
            last.chars().next_back().is_some_and(|l| word(l) || ".-".contains(l))
                && (word(c) || number)
        };
        match pieces.last_mut() {
            Some(last) if joins(last) => last.push(c),
            _ => pieces.push(c.to_string()),
        }
    }
    pieces
}

fn is_number(piece: &str) -> bool {
    piece.trim_start_matches('-').starts_with(|c: char| c.is_ascii_digit())
}

fn change(pieces: &mut Vec<String>, random: &mut impl Rng) {
    let at = random.random_range(0..pieces.len());
    let other = random.random_range(0..pieces.len());
    let end = (at + random.random_range(1..60)).min(pieces.len());
    let one_of = |pieces: &[String], fits: &dyn Fn(&str) -> bool| {
        let from = pieces.iter().skip(at).position(|p| fits(p)).map(|found| at + found);
        from.or_else(|| pieces.iter().position(|p| fits(p)))
    };
    match random.random_range(0..12) {
        0..=3 => {
            if let Some(number) = one_of(pieces, &is_number) {
                pieces[number] = ODD[random.random_range(0..ODD.len())].to_owned();
            }
        }
        4 => {
            if let Some(number) = one_of(pieces, &is_number) {
                let value: f64 = pieces[number].parse().unwrap_or(1.0);
                pieces[number] = format!("{}", value * random.random_range(-3.0..3.0));
            }
        }
        5..=6 => {
            let is_word = |p: &str| p.starts_with(char::is_alphabetic);
            if let Some(word) = one_of(pieces, &is_word) {
                pieces[word] = pieces[other].clone();
            }
        }
        7 => STRANGE[random.random_range(0..STRANGE.len())].clone_into(&mut pieces[at]),
        8 => drop(pieces.drain(at..end)),
        9 => {
            let doubled = pieces[at..end].to_vec();
            pieces.splice(other..other, doubled);
        }
        10 => {
            // A whole line goes or comes twice.
            let is_end = |p: &String| p == "\n";
            let first = pieces[..at].iter().rposition(is_end).map_or(0, |found| found + 1);
            let last = pieces[at..].iter().position(is_end).map_or(pieces.len(), |n| at + n + 1);
            let line: Vec<String> = pieces.drain(first..last).collect();
            if random.random_ratio(1, 2) {
                let into = random.random_range(0..=pieces.len());
                pieces.splice(into..into, [line.clone(), line].concat());
            }
        }
        _ => pieces.swap(at, other),
    }
}

/// Bytes of which one to four are set, bits turned, pieces cut out, doubled or written over, lengths and numbers
/// changed.
pub fn bytes(bytes: &[u8], random: &mut impl Rng) -> Vec<u8> {
    let mut damaged = bytes.to_vec();
    for _ in 0..changes(random) {
        if damaged.is_empty() {
            break;
        }
        let at = random.random_range(0..damaged.len());
        let end = (at + random.random_range(1..40)).min(damaged.len());
        match random.random_range(0..9) {
            0 => damaged.truncate(at),
            1 => damaged[at] ^= 1 << random.random_range(0..8),
            2 => damaged[at] = random.random(),
            3 => drop(damaged.drain(at..end)),
            4 => {
                let piece = damaged[at..end].to_vec();
                damaged.splice(at..at, piece);
            }
            5 => damaged[at..end].fill([0, 0xff, 0x7f, 0x80][random.random_range(0..4)]),
            6 => {
                let other = random.random_range(0..damaged.len());
                let length = (end - at).min(damaged.len() - other);
                damaged.copy_within(at..at + length, other);
            }
            _ => {
                let number = number(random);
                let width = [1, 2, 4, 8][random.random_range(0..4)].min(damaged.len() - at);
                damaged[at..at + width].copy_from_slice(&number.to_le_bytes()[..width]);
            }
        }
    }
    damaged
}

/// A count, a length or the bits of a number where another was expected.
fn number(random: &mut impl Rng) -> u64 {
    let whole =
        [0, 1, 2, 127, 255, 65_535, 1 << 20, 1 << 31, 1 << 32, 1 << 40, u64::MAX >> 1, u64::MAX];
    let real = [f64::NAN, f64::INFINITY, -1.0, 1e308, 1e-320];
    let choice = random.random_range(0..whole.len() + real.len());
    whole.get(choice).copied().unwrap_or_else(|| real[choice - whole.len()].to_bits())
}

/// One of the odd numbers that a float can hold.
pub fn odd_number(random: &mut impl Rng) -> f64 {
    ODD[random.random_range(0..ODD.len())].parse().unwrap_or(f64::MAX)
}
