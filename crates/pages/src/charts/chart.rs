use colours::Role;

use crate::text::numbers::significant;

/// A figure: what is drawn, not how.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// What it shows, in a few words.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// What is drawn, the first at the back.
    pub series: Vec<Series>,
    /// RMS of the noise, drawn as an area about zero.
    pub floor: Option<f64>,
    /// Width of a figure that stands alone, and height (px).
    pub size: (f64, f64),
}

/// An axis.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Axis {
    /// The quantity.
    pub label: String,
    /// Its unit.
    pub unit: &'static str,
    /// Where it begins.
    pub begin: AxisBegin,
}

/// Where an axis begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisBegin {
    /// At the least number.
    Least,
    /// At zero.
    Zero,
}

impl Axis {
    /// An axis that begins at the least number.
    pub fn new(label: &str, unit: &'static str) -> Self {
        Self { label: label.to_owned(), unit, begin: AxisBegin::Least }
    }

    /// An axis that begins at zero.
    pub fn from_zero(label: &str, unit: &'static str) -> Self {
        Self { begin: AxisBegin::Zero, ..Self::new(label, unit) }
    }

    /// Quantity and unit, as they stand at the axis.
    pub fn text(&self) -> String {
        format!("{} ({})", self.label, self.unit)
    }
}

/// One curve or area.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Its name, in a legend and in the text that stands for the figure.
    pub name: String,
    /// What it shows, which decides its colour.
    pub ink: Ink,
    /// Its points.
    pub shape: CurveShape,
}

/// Whose colour a series has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ink {
    /// That of a role.
    Role(Role),
    /// That of one of several models, count_noun from 0.
    Model(usize),
    /// That of letters, for the noise.
    Noise,
}

impl Ink {
    /// The ink of a model by its name, `index` among those that are neither the robot as described
    /// nor the one with the findings.
    pub fn of_model(name: &str, index: usize) -> Self {
        match name {
            "cad" | "nominal" => Self::Role(Role::Nominal),
            "named" | "extended" => Self::Role(Role::Extended),
            _ => Self::Model(index),
        }
    }

    /// The inks of models side by side.
    pub fn of_models<'a>(names: impl Iterator<Item = &'a str>) -> Vec<Self> {
        let mut index = 0;
        let ink = |name| {
            let ink = Self::of_model(name, index);
            index += usize::from(matches!(ink, Self::Model(_)));
            ink
        };
        names.map(ink).collect()
    }
}

impl Series {
    /// A series under the name of its role.
    pub fn of(role: Role, shape: CurveShape) -> Self {
        Self { name: role_words(role).to_owned(), ink: Ink::Role(role), shape }
    }
}

/// The name of a role in a legend.
fn role_words(role: Role) -> &'static str {
    match role {
        Role::Nominal => "nominal model",
        Role::Extended => "extended model",
        Role::Measured | Role::Desired | Role::Error => role.name(),
    }
}

/// The points of a series.
#[derive(Debug, Clone, PartialEq)]
pub enum CurveShape {
    /// Joined points `[x, y]`.
    Line(Vec<[f64; 2]>),
    /// The area between two curves, `[x, low, high]`.
    Band(Vec<[f64; 3]>),
}

impl CurveShape {
    /// Every `[x, y]` that is drawn.
    fn points(&self) -> Vec<[f64; 2]> {
        match self {
            Self::Line(points) => points.clone(),
            Self::Band(band) => band.iter().flat_map(|&[x, a, b]| [[x, a], [x, b]]).collect(),
        }
    }
}

impl Chart {
    /// Whether there is anything to draw.
    pub fn is_empty(&self) -> bool {
        self.series.iter().all(|s| s.shape.points().is_empty())
    }

    /// The figure in a sentence, with the range of every line.
    pub fn alt_text(&self) -> String {
        let mut parts = Vec::new();
        for series in &self.series {
            let CurveShape::Line(points) = &series.shape else { continue };
            let [low, high] = range(points.iter().map(|p| p[1]));
            let (low, high) = (significant(low, 3), significant(high, 3));
            parts.push(format!("{} {low} to {high} {}", series.name, self.y.unit));
        }
        let [start, end] = self.ranges()[0];
        format!(
            "{}: {} against {} from {} to {} {}; {}",
            self.title,
            self.y.label,
            self.x.label,
            significant(start, 3),
            significant(end, 3),
            self.x.unit,
            parts.join(", ")
        )
    }

    /// Lowest and highest x, lowest and highest y.
    pub fn ranges(&self) -> [[f64; 2]; 2] {
        let points: Vec<[f64; 2]> = self.series.iter().flat_map(|s| s.shape.points()).collect();
        [range(points.iter().map(|p| p[0])), range(points.iter().map(|p| p[1]))]
    }
}

fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let finite = values.filter(|v| v.is_finite());
    finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(v), b.max(v)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_text_for_a_figure_is_computed_from_its_data() {
        let chart = Chart {
            title: "Torque of elbow".into(),
            x: Axis::new("time", "s"),
            y: Axis::new("torque", "N·m"),
            series: vec![Series::of(
                Role::Measured,
                CurveShape::Line(vec![[0.0, -1.5], [2.0, 3.25]]),
            )],
            floor: None,
            size: (300.0, 200.0),
        };
        assert_eq!(
            chart.alt_text(),
            "Torque of elbow: torque against time from 0 to 2.00 s; measured -1.50 to 3.25 N·m"
        );
    }

    #[test]
    fn the_described_and_the_extended_robot_have_the_colours_of_their_roles_among_models() {
        let inks = Ink::of_models(["none", "cad", "gp", "named"].into_iter());
        let [nominal, extended] = [Role::Nominal, Role::Extended].map(Ink::Role);
        assert_eq!(inks, [Ink::Model(0), nominal, Ink::Model(1), extended]);
    }
}
