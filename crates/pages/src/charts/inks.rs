use colours::{MODELS, Role, model};

use crate::charts::chart::Ink;

/// The colours of a drawing, as SVG writes them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Palette {
    medium: Medium,
    /// Of letters and axes.
    pub ink: &'static str,
    /// Of letters that matter less.
    pub soft: &'static str,
    /// Of borders.
    pub line: &'static str,
    /// Of the lines at the numbers of an axis.
    pub grid: &'static str,
    /// Of the ground.
    pub paper: &'static str,
}

/// Where a figure is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Medium {
    /// In a file of its own, on white.
    Alone,
    /// In a page, which defines its colours for light and dark.
    Page,
}

impl Medium {
    /// The colours of a figure that is shown there.
    pub fn palette(self) -> Palette {
        match self {
            Self::Alone => Palette {
                medium: self,
                ink: "#1f2328",
                soft: "#59636e",
                line: "#d1d9e0",
                grid: "#e4e8ec",
                paper: "#ffffff",
            },
            Self::Page => Palette {
                medium: self,
                ink: "var(--ink)",
                soft: "var(--soft)",
                line: "var(--line)",
                grid: "var(--grid)",
                paper: "var(--page)",
            },
        }
    }
}

impl Palette {
    /// The colour of a series.
    pub fn of(&self, ink: Ink) -> String {
        match (self.medium, ink) {
            (_, Ink::Noise) => self.ink.to_owned(),
            (Medium::Page, Ink::Role(role)) => format!("var(--{})", role.name()),
            (Medium::Page, Ink::Model(index)) => format!("var(--model{})", index % MODELS.len()),
            (Medium::Alone, Ink::Role(role)) => role.colour().on_white.to_string(),
            (Medium::Alone, Ink::Model(index)) => model(index).on_white.to_string(),
        }
    }

    /// The colour of the nominal model.
    pub fn nominal(&self) -> String {
        self.of(Ink::Role(Role::Nominal))
    }

    /// The colour of the model with the findings.
    pub fn extended_model(&self) -> String {
        self.of(Ink::Role(Role::Extended))
    }

    /// The colour of measured signals.
    pub fn measurement(&self) -> String {
        self.of(Ink::Role(Role::Measured))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::html::style::page_style;

    #[test]
    fn a_figure_and_a_page_have_the_colours_of_every_role_and_model() {
        let style = page_style();
        for ink in Role::ALL.map(Ink::Role).into_iter().chain([Ink::Model(0), Ink::Model(6)]) {
            let alone = Medium::Alone.palette().of(ink);
            let name = Medium::Page.palette().of(ink);
            let name = name.trim_start_matches("var(").trim_end_matches(')');
            assert!(style.contains(&format!("{name}: {alone};")), "{name} {alone}");
        }
        assert_eq!(style.matches("--extended:").count(), 2, "light and dark");
    }
}
