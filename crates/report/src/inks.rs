use colours::{Colour, MODELS, Role, model};

use crate::chart::Ink;

/// What a drawing is drawn in, as SVG understands it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Colours {
    place: Place,
    pub ink: &'static str,
    pub soft: &'static str,
    pub line: &'static str,
    pub grid: &'static str,
    pub paper: &'static str,
}

/// Where a figure is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place {
    /// In a file of its own, on white.
    Alone,
    /// In a page, which defines its colours for light and dark.
    Page,
}

impl Place {
    /// The colours of a figure that is shown there.
    pub fn colours(self) -> Colours {
        match self {
            Self::Alone => Colours {
                place: self,
                ink: "#1f2328",
                soft: "#59636e",
                line: "#d1d9e0",
                grid: "#e4e8ec",
                paper: "#ffffff",
            },
            Self::Page => Colours {
                place: self,
                ink: "var(--ink)",
                soft: "var(--soft)",
                line: "var(--line)",
                grid: "var(--grid)",
                paper: "var(--page)",
            },
        }
    }
}

impl Colours {
    /// The colour of a series.
    pub fn of(&self, ink: Ink) -> String {
        match (self.place, ink) {
            (_, Ink::Noise) => self.ink.to_owned(),
            (Place::Page, Ink::Role(role)) => format!("var(--{})", role.name()),
            (Place::Page, Ink::Model(index)) => format!("var(--model{})", index % MODELS.len()),
            (Place::Alone, Ink::Role(role)) => role.colour().on_white.to_string(),
            (Place::Alone, Ink::Model(index)) => model(index).on_white.to_string(),
        }
    }

    /// The colour of what the model as given predicts.
    pub fn nominal(&self) -> String {
        self.of(Ink::Role(Role::Nominal))
    }

    /// The colour of what the model with the findings predicts.
    pub fn extended(&self) -> String {
        self.of(Ink::Role(Role::Extended))
    }

    /// The colour of what was measured.
    pub fn measured(&self) -> String {
        self.of(Ink::Role(Role::Measured))
    }
}

/// The colours of a page as a style sheet: on white, in the dark, on paper.
pub(crate) fn style() -> String {
    let named = Role::ALL.into_iter().map(|role| (role.name().to_owned(), role.colour()));
    let models = MODELS.into_iter().enumerate().map(|(i, colour)| (format!("model{i}"), colour));
    let all: Vec<(String, Colour)> = named.chain(models).collect();
    let white: String = all.iter().map(|(name, c)| format!("--{name}: {}; ", c.on_white)).collect();
    let dark: String = all.iter().map(|(name, c)| format!("--{name}: {}; ", c.on_dark)).collect();
    format!(
        ":root {{ {white}}}\n@media screen and (prefers-color-scheme: dark) {{ :root {{ {dark}}} }}"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_and_a_page_have_the_colours_of_every_role_and_model() {
        let style = style();
        for ink in Role::ALL.map(Ink::Role).into_iter().chain([Ink::Model(0), Ink::Model(6)]) {
            let alone = Place::Alone.colours().of(ink);
            let name = Place::Page.colours().of(ink);
            let name = name.trim_start_matches("var(").trim_end_matches(')');
            assert!(style.contains(&format!("{name}: {alone};")), "{name} {alone}");
        }
        assert_eq!(style.matches("--extended:").count(), 2, "light and dark");
    }
}
