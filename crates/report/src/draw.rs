use std::sync::Arc;

use kuva::backend::svg::SvgBackend;
use kuva::plot::{BandPlot, LinePlot};
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::render_multiple;
use kuva::render::theme::Theme;

use crate::{Chart, Role, Series, Shape};

/// The colours of a figure, as SVG understands them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Colours {
    pub measured: &'static str,
    pub nominal: &'static str,
    pub extended: &'static str,
    pub ink: &'static str,
    pub soft: &'static str,
    pub line: &'static str,
    pub grid: &'static str,
    pub paper: &'static str,
}

impl Colours {
    /// Those that the style sheet of the page defines, for light and dark.
    pub const OF_PAGE: Self = Self {
        measured: "var(--measured)",
        nominal: "var(--nominal)",
        extended: "var(--extended)",
        ink: "var(--ink)",
        soft: "var(--soft)",
        line: "var(--line)",
        grid: "var(--grid)",
        paper: "var(--page)",
    };

    /// The page's light ones, for a drawing that stands alone on white.
    pub const ON_WHITE: Self = Self {
        measured: "#30363d",
        nominal: "#c8500a",
        extended: "#1668c5",
        ink: "#1f2328",
        soft: "#59636e",
        line: "#d1d9e0",
        grid: "#e4e8ec",
        paper: "#ffffff",
    };

    fn of(&self, role: Role) -> &'static str {
        match role {
            Role::Measured => self.measured,
            Role::Nominal => self.nominal,
            Role::Extended => self.extended,
        }
    }
}

impl Chart {
    /// The figure as an SVG element for a page that defines the colours `--measured`,
    /// `--nominal`, `--extended`, `--ink` and `--grid`; empty when there is nothing to draw.
    pub fn svg(&self) -> String {
        self.drawn(&Colours::OF_PAGE)
    }

    /// The figure in these colours, without a name space and without a place; empty when
    /// there is nothing to draw.
    pub(crate) fn drawn(&self, colours: &Colours) -> String {
        if self.is_empty() {
            return String::new();
        }
        let plots = self.series.iter().map(|series| plot(series, colours)).collect();
        let scene = render_multiple(plots, self.layout(colours));
        let drawn = SvgBackend::new().render_scene(&scene);
        embed(&drawn, self.size, &self.alt_text())
    }

    fn layout(&self, colours: &Colours) -> Layout {
        let [x, y] = self.ranges();
        let ink = colours.ink.to_owned();
        let theme = Theme {
            background: "none".into(),
            axis_color: ink.clone(),
            grid_color: colours.grid.into(),
            tick_color: ink.clone(),
            text_color: ink,
            font_family: Some("inherit".into()),
            ..Theme::light()
        };
        Layout::new((x[0], x[1]), padded(y))
            .with_width(self.size.0)
            .with_height(self.size.1)
            .with_x_axis_min(x[0])
            .with_x_axis_max(x[1])
            .with_x_label(self.x.text())
            .with_y_label(self.y.text())
            .with_label_size(12)
            .with_tick_size(11)
            .with_ticks(5)
            .with_tick_format(TickFormat::Custom(Arc::new(tick)))
            .with_theme(theme)
    }
}

/// A range with room above and below, never of zero height.
fn padded([low, high]: [f64; 2]) -> (f64, f64) {
    let size = low.abs().max(high.abs());
    let is_flat = high - low <= 1e-9 * size;
    let room = if is_flat { (0.1 * size).max(0.01) } else { 0.04 * (high - low) };
    (low - room, high + room)
}

/// A number at an axis, without zeros at its end.
fn tick(value: f64) -> String {
    if value.abs() > 0.0 && !(1e-4..1e6).contains(&value.abs()) {
        return format!("{value:.1e}");
    }
    let text = format!("{value:.5}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn plot(series: &Series, colours: &Colours) -> Plot {
    let colour = colours.of(series.role);
    match &series.shape {
        Shape::Line(points) => {
            let width = if series.role == Role::Measured { 1.8 } else { 1.4 };
            let points = points.iter().map(|&[x, y]| (x, y));
            LinePlot::new().with_data(points).with_color(colour).with_stroke_width(width).into()
        }
        Shape::Band(band) => BandPlot::new(
            band.iter().map(|b| b[0]),
            band.iter().map(|b| b[1]),
            band.iter().map(|b| b[2]),
        )
        .with_color(colour)
        .with_opacity(0.22)
        .into(),
    }
}

/// The drawing with a scalable size and words for those who cannot see it, without the
/// name space that inline SVG does not need, its numbers rounded to what the eye can see.
///
/// The clip is taken out: the axes hold every point, and its name counts up from figure to
/// figure, so that the same figure would not give the same bytes.
fn embed(drawn: &str, (width, height): (f64, f64), words: &str) -> String {
    let body = drawn.split_once("-->").map_or(drawn, |(_, body)| body);
    let words = words.replace('&', "&amp;").replace('"', "&quot;").replace('<', "&lt;");
    let mut svg =
        format!(r#"<svg viewBox="0 0 {width} {height}" role="img" aria-label="{words}">"#);
    // Text between tags holds no quotes, so every second piece is the value of an attribute.
    let mut pieces = without_clip(body).split('"').map(str::to_owned).collect::<Vec<_>>();
    for i in (1..pieces.len()).step_by(2) {
        if pieces[i - 1].ends_with(" d=") {
            pieces[i] = compact(&pieces[i]);
        } else if let Ok(number) = pieces[i].parse::<f64>() {
            pieces[i] = ((100.0 * number).round() / 100.0).to_string();
        }
    }
    svg.push_str(&pieces.join("\""));
    svg
}

fn without_clip(svg: &str) -> String {
    let cut = |text: &str, from: &str, to: &str| {
        let start = text.find(from)?;
        let inside = start + from.len();
        let end = inside + text[inside..].find(to)? + to.len();
        Some(format!("{}{}", &text[..start], &text[end..]))
    };
    let mut svg = cut(svg, "<defs>", "</defs>").unwrap_or_else(|| svg.to_owned());
    while let Some(shorter) = cut(&svg, " clip-path=\"", "\"") {
        svg = shorter;
    }
    svg
}

/// A path of straight lines, its numbers rounded: `M 1.234 5 L 2 3.01` becomes `M1.2 5 2 3`.
fn compact(path: &str) -> String {
    let mut out = String::with_capacity(path.len());
    let spaced = path.replace('M', " M ").replace(['L', ','], " ").replace('Z', " Z");
    let mut is_first = true;
    for token in spaced.split_whitespace() {
        match token.parse::<f64>() {
            Ok(number) => {
                if !is_first {
                    out.push(' ');
                }
                out.push_str(&((10.0 * number).round() / 10.0).to_string());
                is_first = false;
            }
            Err(_) => {
                out.push_str(token);
                is_first = true;
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Axis;

    #[test]
    fn a_path_keeps_its_points_and_loses_its_length() {
        let path = compact("M 1.234 5.0 L 2.0 3.01 L 10.06 -3.04 Z");
        assert_eq!(path, "M1.2 5 2 3 10.1 -3Z");
    }

    #[test]
    fn ticks_are_short() {
        let ticks = [0.0, -0.005, 12.5, 200.0, 3e-6].map(tick);
        assert_eq!(ticks, ["0", "-0.005", "12.5", "200", "3.0e-6"]);
    }

    #[test]
    fn a_figure_has_words_colours_and_no_address() {
        let chart = Chart {
            title: "a < b".into(),
            x: Axis { label: "time".into(), unit: "s" },
            y: Axis { label: "torque".into(), unit: "N·m" },
            series: vec![Series {
                role: Role::Nominal,
                shape: Shape::Line(vec![[0.0, 0.0], [1.0, 0.0]]),
            }],
            size: (300.0, 200.0),
        };
        let svg = chart.svg();
        assert!(
            svg.starts_with("<svg viewBox=\"0 0 300 200\" role=\"img\" aria-label=\"a &lt; b:")
        );
        assert!(svg.ends_with("</svg>") && svg.contains("var(--nominal)"), "{svg}");
        assert!(!svg.contains("http") && !svg.contains("NaN"), "{svg}");
        assert_eq!(svg, chart.svg());
    }
}
