/// Layout of a number in bytes, by a NumPy type code such as `<f8`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Numeral {
    kind: Kind,
    /// Number of bytes, 1 to 8.
    bytes: usize,
    order: Order,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Signed,
    Unsigned,
    Float,
}

/// Byte order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Order {
    Little,
    Big,
}

/// An item with a type code: its length, and its layout where it is a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Item {
    pub bytes: u64,
    pub numeral: Option<Numeral>,
}

impl Item {
    /// The item of a type code; `None` for Python objects and for an invalid code.
    pub(crate) fn of(code: &str) -> Option<Self> {
        let mut characters = code.chars();
        let (order, kind) = (characters.next()?, characters.next()?);
        let order = match order {
            '<' | '|' => Order::Little,
            '>' => Order::Big,
            _ => return None,
        };
        // A unit of time may stand behind: `M8[ns]`.
        let size = characters.as_str().split('[').next()?.parse::<u64>().ok()?;
        let kind = match (kind, size) {
            ('i', 1 | 2 | 4 | 8) => Some(Kind::Signed),
            ('u', 1 | 2 | 4 | 8) => Some(Kind::Unsigned),
            ('f', 4 | 8) => Some(Kind::Float),
            ('U', _) => return Some(Self { bytes: size.checked_mul(4)?, numeral: None }),
            ('O', _) => return None,
            _ => None,
        };
        let numeral = kind.map(|kind| Numeral { kind, bytes: size as usize, order });
        Some(Self { bytes: size, numeral })
    }
}

impl Numeral {
    /// Number of bytes of a number.
    pub(crate) fn bytes(self) -> usize {
        self.bytes
    }

    /// The number in the first bytes.
    pub(crate) fn read(self, bytes: &[u8]) -> f64 {
        let own = bytes.iter().take(self.bytes).map(|&byte| u64::from(byte));
        let raw = match self.order {
            Order::Big => own.fold(0, |number, byte| number << 8 | byte),
            Order::Little => own.rev().fold(0, |number, byte| number << 8 | byte),
        };
        match (self.kind, self.bytes) {
            (Kind::Float, 4) => f64::from(f32::from_bits(raw as u32)),
            (Kind::Float, _) => f64::from_bits(raw),
            (Kind::Unsigned, _) => raw as f64,
            (Kind::Signed, bytes) => {
                let above = 64 - 8 * bytes as u32;
                ((raw << above) as i64 >> above) as f64
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(code: &str, bytes: &[u8]) -> f64 {
        Item::of(code).unwrap().numeral.unwrap().read(bytes)
    }

    #[test]
    fn numbers_are_read_in_either_order() {
        assert_eq!(read("<f8", &(-0.1_f64).to_le_bytes()).to_bits(), (-0.1_f64).to_bits());
        assert_eq!(read(">f8", &(-0.1_f64).to_be_bytes()).to_bits(), (-0.1_f64).to_bits());
        assert_eq!(read("<f4", &1.5_f32.to_le_bytes()).to_bits(), 1.5_f64.to_bits());
        assert_eq!(read(">i4", &(-7_i32).to_be_bytes()).to_bits(), (-7.0_f64).to_bits());
        assert_eq!(read("<i8", &i64::MIN.to_le_bytes()).to_bits(), (i64::MIN as f64).to_bits());
        assert_eq!(read("<u2", &65535_u16.to_le_bytes()).to_bits(), 65535.0_f64.to_bits());
        assert_eq!(read("|i1", &[0xff]).to_bits(), (-1.0_f64).to_bits());
    }

    #[test]
    fn what_is_no_number_has_a_length_all_the_same() {
        let bytes = |code: &str| Item::of(code).filter(|i| i.numeral.is_none()).map(|i| i.bytes);
        assert_eq!(bytes("<U19"), Some(76));
        assert_eq!(bytes("|V4"), Some(4));
        assert_eq!(bytes("<M8[ns]"), Some(8));
        assert_eq!(bytes("|b1"), Some(1));
        for code in ["|O", "|O8", "", "<", "<f", "f8", "<U9999999999999999999", "<f8x"] {
            assert_eq!(Item::of(code), None, "{code}");
        }
    }
}
