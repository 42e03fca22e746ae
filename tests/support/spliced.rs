//! Inputs that quick mistakes turned into others, some 10^5 a second: where `mutated` knows what a number or a line is,
//! this knows bytes, the words of a format, and other inputs of the same kind.

use rand::{Rng, RngExt};

/// Numbers where others stood.
const NUMBERS: [&str; 20] = [
    "0",
    "-0.0",
    "-1",
    "1e-320",
    "1e308",
    "-1e309",
    "nan",
    "inf",
    "-inf",
    "65536",
    "4294967295",
    "4294967296",
    "9007199254740993",
    "9223372036854775807",
    "-9223372036854775808",
    "18446744073709551616",
    "1e",
    "0x10",
    "00",
    "1_000",
];

/// Stretches that are taken out, doubled or filled (bytes).
const STRETCH: usize = 64;
/// What is put in over and over nests so deep.
const REPEATS: usize = 2000;
/// What grows beyond this is cut (bytes).
const LARGEST: usize = 1 << 20;

/// One to six changes of bytes, with words of the format and pieces of other inputs.
pub fn spliced(input: &[u8], others: &[Vec<u8>], words: &[&str], random: &mut impl Rng) -> Vec<u8> {
    let mut bytes = input.to_vec();
    let changes = if random.random_ratio(1, 2) { 1 } else { random.random_range(2..7) };
    for _ in 0..changes {
        if bytes.is_empty() {
            break;
        }
        change(&mut bytes, others, words, random);
    }
    bytes.truncate(LARGEST);
    bytes
}

fn change(bytes: &mut Vec<u8>, others: &[Vec<u8>], words: &[&str], random: &mut impl Rng) {
    let at = random.random_range(0..bytes.len());
    let end = (at + random.random_range(1..=STRETCH)).min(bytes.len());
    match random.random_range(0..16) {
        0 => bytes[at] ^= 1 << random.random_range(0..8),
        1 => bytes[at] = random.random(),
        2 => bytes[at] = bytes[at].wrapping_add(if random.random() { 1 } else { 255 }),
        3 => bytes[at..end].fill([0, 0xff, 0x7f, 0x80, b' ', b'9'][random.random_range(0..6)]),
        4 => drop(bytes.drain(at..end)),
        5 => {
            let piece = bytes[at..end].to_vec();
            let to = random.random_range(0..=bytes.len());
            bytes.splice(to..to, piece);
        }
        6 => {
            let to = random.random_range(0..bytes.len());
            let length = (end - at).min(bytes.len() - to);
            bytes.copy_within(at..at + length, to);
        }
        7 if random.random_ratio(1, 4) => bytes.truncate(at),
        8 | 9 => change_length(bytes, at, random),
        10..=12 => change_number(bytes, at, random),
        13 => {
            let Some(other) = others.get(random.random_range(0..others.len().max(1))) else {
                return;
            };
            let from = random.random_range(0..other.len().max(1)).min(other.len());
            let piece = &other[from..(from + end - at).min(other.len())];
            bytes.splice(at..end.min(at + piece.len()), piece.iter().copied());
        }
        _ if words.is_empty() => bytes[at] = random.random(),
        14 => {
            let word = words[random.random_range(0..words.len())].as_bytes();
            let over = if random.random() { word.len() } else { 0 };
            bytes.splice(at..(at + over).min(bytes.len()), word.iter().copied());
        }
        _ if random.random_ratio(1, 16) => {
            let word = words[random.random_range(0..words.len())].as_bytes();
            bytes.splice(at..at, word.repeat(random.random_range(1..REPEATS)));
        }
        _ => bytes.swap(at, end - 1),
    }
}

/// A number of 1, 2, 4 or 8 bytes: one at an end of its range, the length of the input, or a near one.
fn change_length(bytes: &mut [u8], at: usize, random: &mut impl Rng) {
    let width = [1, 2, 4, 8][random.random_range(0..4)].min(bytes.len() - at);
    let mut old = [0; 8];
    old[..width].copy_from_slice(&bytes[at..at + width]);
    let is_big = random.random_ratio(1, 4);
    let read = if is_big { u64::from_be_bytes(old) } else { u64::from_le_bytes(old) };
    let length = bytes.len() as u64;
    let new = match random.random_range(0..8) {
        0 => read.wrapping_add(random.random_range(1..9)),
        1 => read.wrapping_sub(random.random_range(1..9)),
        2 => read.wrapping_mul(2),
        3 => length.wrapping_sub(at as u64),
        4 => 1 << random.random_range(0..64),
        5 => (1 << random.random_range(0..64)) - 1,
        6 => u64::MAX - random.random_range(0..9),
        _ => 0,
    };
    let written = if is_big { new.to_be_bytes() } else { new.to_le_bytes() };
    let written = if is_big { &written[8 - width..] } else { &written[..width] };
    bytes[at..at + width].copy_from_slice(written);
}

/// The next digits in a text become another number, of any length.
fn change_number(bytes: &mut Vec<u8>, at: usize, random: &mut impl Rng) {
    let is_digit = |byte: &u8| byte.is_ascii_digit();
    let Some(start) = bytes[at..].iter().take(512).position(is_digit).map(|n| at + n) else {
        bytes[at] = random.random();
        return;
    };
    let in_number = |byte: &u8| byte.is_ascii_digit() || b".eE".contains(byte);
    let end = bytes[start..].iter().position(|byte| !in_number(byte));
    let end = end.map_or(bytes.len(), |length| start + length);
    match random.random_range(0..4) {
        0 => bytes[start] = b'0' + random.random_range(0..10),
        1 => bytes
            .splice(start..start, std::iter::repeat_n(b'9', random.random_range(1..400)))
            .for_each(drop),
        _ => {
            let new = NUMBERS[random.random_range(0..NUMBERS.len())];
            bytes.splice(start..end, new.bytes()).for_each(drop);
        }
    }
}
