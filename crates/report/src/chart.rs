use crate::numbers::significant;

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
    /// Width and height (px).
    pub size: (f64, f64),
}

/// An axis.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Axis {
    /// The quantity.
    pub label: String,
    /// Its unit.
    pub unit: &'static str,
}

impl Axis {
    /// Quantity and unit, as they stand at the axis.
    pub fn text(&self) -> String {
        format!("{} ({})", self.label, self.unit)
    }
}

/// One curve or area.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// What it is, which decides its colour.
    pub role: Role,
    /// Its points.
    pub shape: Shape,
}

/// What a series shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// The log.
    Measured,
    /// The model as given.
    Nominal,
    /// The model with the findings.
    Extended,
}

impl Role {
    /// The name in the legend and in the text that stands for the figure.
    pub fn words(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::Nominal => "nominal model",
            Self::Extended => "extended model",
        }
    }
}

/// The points of a series.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// Joined points `[x, y]`.
    Line(Vec<[f64; 2]>),
    /// The area between two curves, `[x, low, high]`.
    Band(Vec<[f64; 3]>),
}

impl Shape {
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
            let Shape::Line(points) = &series.shape else { continue };
            let [low, high] = range(points.iter().map(|p| p[1]));
            let (low, high) = (significant(low, 3), significant(high, 3));
            parts.push(format!("{} {low} to {high} {}", series.role.words(), self.y.unit));
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
    pub(crate) fn ranges(&self) -> [[f64; 2]; 2] {
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
            x: Axis { label: "time".into(), unit: "s" },
            y: Axis { label: "torque".into(), unit: "N·m" },
            series: vec![Series {
                role: Role::Measured,
                shape: Shape::Line(vec![[0.0, -1.5], [2.0, 3.25]]),
            }],
            size: (300.0, 200.0),
        };
        assert_eq!(
            chart.alt_text(),
            "Torque of elbow: torque against time from 0 to 2.00 s; measured -1.50 to 3.25 N·m"
        );
    }
}
