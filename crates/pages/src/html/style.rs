use colours::{Colour, MODELS, Role};

/// The colours of a page as a style sheet: on white, in the dark, on paper.
pub fn page_style() -> String {
    let named = Role::ALL.into_iter().map(|role| (role.name().to_owned(), role.colour()));
    let models = MODELS.into_iter().enumerate().map(|(i, colour)| (format!("model{i}"), colour));
    let all: Vec<(String, Colour)> = named.chain(models).collect();
    let white: String = all.iter().map(|(name, c)| format!("--{name}: {}; ", c.on_white)).collect();
    let dark: String = all.iter().map(|(name, c)| format!("--{name}: {}; ", c.on_dark)).collect();
    format!(
        ":root {{ {white}}}\n@media screen and (prefers-color-scheme: dark) {{ :root {{ {dark}}} }}"
    )
}
