//! HDF5 files, and those of MATLAB, of as many groups and arrays as are read and one more, and as deep ones.

use checks::watch::processor_s;

use crate::support::{Scratch, two_joints};

/// Most groups and arrays of a file.
const MOST: usize = 10_000;
/// Groups in one another whose arrays are read.
const DEEPEST: usize = 8;
/// What a file of any of these takes at most (s of processor of all tests that run meanwhile).
const PATIENCE_S: f64 = 2.0;
/// A program puts so many bytes before the file in MATLAB.
const HEADER: usize = 512;
/// An address of nothing.
const NOWHERE: u64 = u64::MAX;

/// Which program's file is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Hdf5,
    Matlab,
}

/// An HDF5 file of the first version (HDF5 File Format Specification, version 3.0): headers of objects without
/// checksums, groups whose links are messages.
struct Writer {
    kind: Kind,
    bytes: Vec<u8>,
}

impl Writer {
    fn new(kind: Kind) -> Self {
        // The superblock is put in at the end.
        Self { kind, bytes: vec![0; 96] }
    }

    /// An object of these messages. Returns its address.
    fn object(&mut self, messages: &[(u16, Vec<u8>)]) -> u64 {
        let mut content = Vec::new();
        for (number, data) in messages {
            let length = data.len().next_multiple_of(8);
            content.extend(number.to_le_bytes());
            content.extend((length as u16).to_le_bytes());
            content.extend([0; 4]);
            content.extend(data);
            content.resize(content.len() + length - data.len(), 0);
        }
        let address = self.bytes.len() as u64;
        self.bytes.extend([1, 0]);
        self.bytes.extend((messages.len() as u16).to_le_bytes());
        self.bytes.extend(1_u32.to_le_bytes());
        self.bytes.extend((content.len() as u32).to_le_bytes());
        self.bytes.extend([0; 4]);
        self.bytes.extend(content);
        address
    }

    /// A group of what lies at these addresses.
    fn group(&mut self, members: &[(String, u64)]) -> u64 {
        let link = |(name, address): &(String, u64)| {
            let head = [1, 0, name.len() as u8];
            (6, [&head[..], name.as_bytes(), &address.to_le_bytes()].concat())
        };
        let none = [&[0, 0][..], &NOWHERE.to_le_bytes(), &NOWHERE.to_le_bytes()].concat();
        let messages: Vec<_> = std::iter::once((2, none)).chain(members.iter().map(link)).collect();
        self.object(&messages)
    }

    /// An array of numbers.
    fn array(&mut self, numbers: [f64; 5]) -> u64 {
        let at = self.bytes.len() as u64;
        self.bytes.extend(numbers.map(f64::to_le_bytes).concat());
        let sizes: &[u64] = if self.kind == Kind::Matlab { &[1, 5] } else { &[5] };
        let mut space = vec![1, sizes.len() as u8, 0, 0, 0, 0, 0, 0];
        space.extend(sizes.iter().flat_map(|size| size.to_le_bytes()));
        // A number of 64 bits: sign, 11 of exponent from 52, 52 of mantissa, bias 1023.
        let double =
            [&[0x11, 0x20, 0x3f, 0, 8, 0, 0, 0, 0, 0, 64, 0, 52, 11, 0, 52][..], &[0xff, 3, 0, 0]];
        let place = [&[3, 1][..], &at.to_le_bytes(), &40_u64.to_le_bytes()];
        self.object(&[(1, space), (3, double.concat()), (8, place.concat())])
    }

    /// The columns of two joints.
    fn columns(&mut self) -> Vec<(String, u64)> {
        let names = ["time", "j1.position", "j1.effort", "j2.position", "j2.effort"];
        let mut of = |(column, name): (usize, &str)| {
            let numbers = [0.0, 1.0, 2.0, 3.0, 4.0].map(|k| 0.125 * k * (1 + column) as f64);
            (name.to_owned(), self.array(numbers))
        };
        names.into_iter().enumerate().map(&mut of).collect()
    }

    /// The file whose root is the group at this address.
    fn file(mut self, root: u64) -> Vec<u8> {
        let end = self.bytes.len() as u64;
        let mut start = b"\x89HDF\r\n\x1a\n\0\0\0\0\0\x08\x08\0\x04\0\x10\0\0\0\0\0".to_vec();
        for number in [0, NOWHERE, end, NOWHERE, 0, root] {
            start.extend(number.to_le_bytes());
        }
        self.bytes[..start.len()].copy_from_slice(&start);
        if self.kind == Kind::Hdf5 {
            return self.bytes;
        }
        let mut header = b"MATLAB 7.3 MAT-file".to_vec();
        header.resize(124, b' ');
        header.extend(b"\0\x02IM");
        header.resize(HEADER, 0);
        [header, self.bytes].concat()
    }
}

/// What is in a file beside the columns of two joints.
#[derive(Debug, Clone, Copy)]
enum Many {
    Arrays,
    Groups,
    /// Groups of groups.
    Nested,
    /// Links to one group.
    Links,
}

const ALL: [Many; 4] = [Many::Arrays, Many::Groups, Many::Nested, Many::Links];

/// A file of so many groups and arrays.
fn file(kind: Kind, many: Many, count: usize) -> Vec<u8> {
    let mut writer = Writer::new(kind);
    let mut members = writer.columns();
    let more = count - members.len();
    let one = writer.group(&[]);
    for k in 0..more {
        let address = match many {
            Many::Arrays => writer.array([k as f64; 5]),
            Many::Groups => writer.group(&[]),
            Many::Links => one,
            Many::Nested if k >= more.div_ceil(100) => break,
            Many::Nested => {
                let own = (more - 100 * k).min(100) - 1;
                let inside: Vec<_> =
                    (0..own).map(|j| (format!("b{j}"), writer.group(&[]))).collect();
                writer.group(&inside)
            }
        };
        members.push((format!("a{k}"), address));
    }
    let root = writer.group(&members);
    writer.file(root)
}

#[test]
fn ten_thousand_groups_and_arrays_are_read_and_one_more_is_refused() {
    for kind in [Kind::Hdf5, Kind::Matlab] {
        for many in ALL {
            let [read, refused] =
                [MOST, MOST + 1].map(|count| Scratch::new("run", file(kind, many, count)));
            let begun = processor_s();
            let run = read.read(&two_joints()).unwrap();
            let told = refused.message(&two_joints());
            let took = processor_s().zip(begun).map_or(0.0, |(end, start)| end - start);
            let about = format!("{kind:?} of {many:?}");
            assert_eq!(run.joints[1].effort, [0.0, 0.625, 1.25, 1.875, 2.5], "{about}");
            let further = if matches!(many, Many::Arrays) { MOST - 5 } else { 0 };
            assert_eq!(run.extra.len(), further, "{about}");
            assert!(told.contains("it has more than 10000 groups and arrays"), "{about}: {told}");
            assert!(took < PATIENCE_S, "{about}: {took} s");
            println!("{about}: {took:.2} s of processor for both");
        }
    }
}

#[test]
fn groups_are_followed_eight_deep_and_what_lies_deeper_is_left_out() {
    for kind in [Kind::Hdf5, Kind::Matlab] {
        for depth in [DEEPEST, DEEPEST + 1, 2000] {
            let mut writer = Writer::new(kind);
            let mut inner = ("x".to_owned(), writer.array([7.0; 5]));
            for _ in 0..depth {
                inner = ("a".to_owned(), writer.group(&[inner]));
            }
            let mut members = writer.columns();
            members.push(inner);
            let root = writer.group(&members);
            let run = Scratch::new("run", writer.file(root)).read(&two_joints()).unwrap();
            let name = format!("{}x", "a.".repeat(depth));
            let is_read = run.extra.contains_key(&name);
            assert_eq!(is_read, depth <= DEEPEST, "{kind:?}, {depth}: {:?}", run.extra.keys());
        }
    }
}
