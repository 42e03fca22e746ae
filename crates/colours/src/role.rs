use crate::colour::Colour;

/// What a curve shows, which decides its colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// What sensors saw: nearly black on white, nearly white on dark.
    Measured,
    /// What the model as given predicts: vermillion.
    Nominal,
    /// What the model with the findings, or a learned one, predicts: blue.
    Extended,
    /// What was asked for: reddish purple.
    Desired,
    /// How far off something is, whatever the model: bluish green.
    Error,
}

impl Role {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::Measured, Self::Nominal, Self::Extended, Self::Desired, Self::Error];

    /// Its name, one word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::Nominal => "nominal",
            Self::Extended => "extended",
            Self::Desired => "desired",
            Self::Error => "error",
        }
    }

    /// Its colour.
    pub fn colour(self) -> Colour {
        match self {
            Self::Measured => Colour::new(0x1f2328, 0xe3e8ee),
            Self::Nominal => Colour::new(0xb84a00, 0xe66a00),
            Self::Extended => Colour::new(0x0072b2, 0x56b4e9),
            Self::Desired => Colour::new(0xcc79a7, 0xcc79a7),
            Self::Error => Colour::new(0x007052, 0x009e73),
        }
    }
}

/// Colours of models side by side, none of which is that of a role.
pub const MODELS: [Colour; 7] = [
    Colour::new(0x332288, 0x705cd6),
    Colour::new(0x999933, 0xddcc77),
    Colour::new(0x882255, 0xdb2480),
    Colour::new(0x8b5a2b, 0xe3b182),
    Colour::new(0x9b1ef3, 0xd05cff),
    Colour::new(0x065379, 0xb6e4fb),
    Colour::new(0x737373, 0xbfbfbf),
];

/// The colour of one of several models; an eighth has that of the first.
pub fn model(index: usize) -> Colour {
    MODELS[index % MODELS.len()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colour::Rgb;
    use crate::vision::{contrast, least_difference};

    /// A ground, and which of a colour's two values stands on it.
    type Ground = (Rgb, fn(Colour) -> Rgb);

    /// White and the ground of a dark page.
    const GROUNDS: [Ground; 2] = [
        (Rgb([0xff; 3]), |colour| colour.on_white),
        (Rgb([0x0f, 0x13, 0x18]), |colour| colour.on_dark),
    ];

    /// Least contrast of text and of lines (WCAG 2.1, criteria 1.4.3 and 1.4.11).
    const TEXT: f64 = 4.5;
    const LINES: f64 = 3.0;

    /// Least difference of two roles, and of a model and anything beside it, for whatever eye (CIE76).
    const ROLES_APART: f64 = 12.0;
    const MODELS_APART: f64 = 8.0;

    #[test]
    fn lines_stand_out_and_numbers_in_colour_can_be_read() {
        for (ground, on) in GROUNDS {
            for role in Role::ALL {
                let least = if role == Role::Desired { LINES } else { TEXT };
                let contrast = contrast(on(role.colour()), ground);
                assert!(contrast >= least, "{role:?} on {ground}: {contrast}");
            }
            for (index, colour) in MODELS.into_iter().enumerate() {
                let contrast = contrast(on(colour), ground);
                assert!(contrast >= LINES, "model {index} on {ground}: {contrast}");
            }
        }
    }

    #[test]
    fn every_eye_tells_the_roles_apart() {
        for (ground, on) in GROUNDS {
            for (i, a) in Role::ALL.into_iter().enumerate() {
                for b in &Role::ALL[..i] {
                    let apart = least_difference(on(a.colour()), on(b.colour()));
                    assert!(apart >= ROLES_APART, "{a:?} and {b:?} on {ground}: {apart}");
                }
            }
        }
    }

    #[test]
    fn every_eye_tells_a_model_from_what_stands_beside_it() {
        let beside = [Role::Measured, Role::Nominal, Role::Extended, Role::Desired];
        for (ground, on) in GROUNDS {
            let mut known: Vec<Colour> = beside.map(Role::colour).to_vec();
            for (index, colour) in MODELS.into_iter().enumerate() {
                for other in &known {
                    let apart = least_difference(on(colour), on(*other));
                    assert!(
                        apart >= MODELS_APART,
                        "model {index} and {other:?}, {ground}: {apart}"
                    );
                }
                known.push(colour);
            }
        }
    }
}
