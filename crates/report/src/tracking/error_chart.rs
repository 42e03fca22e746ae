use crate::tracking::comparison::TrackingComparison;
use pages::{Dots, JointDots, Medium, ReportError};

impl TrackingComparison {
    /// `figure3.svg`: the error of every run at every joint as dots on a logarithmic axis,
    /// after figure 3 of Nguyen-Tuong & Peters 2010, in a drawing that stands alone.
    ///
    /// A run that was stopped has no dots.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn error_figure(&self) -> Result<String, ReportError> {
        self.draw_errors(Medium::Alone)
    }

    pub(crate) fn draw_errors(&self, medium: Medium) -> Result<String, ReportError> {
        let joints = self.joints.iter().enumerate().map(|(i, joint)| JointDots {
            name: joint.name.clone(),
            values: self.models.iter().map(|model| 1e3 * model.error(i)).collect(),
            floor: None,
        });
        let dots = Dots {
            title: format!("{}: tracking error by joint", self.robot),
            subtitle: format!("{}; logarithmic, lower is better", self.circumstances()),
            axis: match self.thousandths() {
                "mrad" => "RMS error (mrad)",
                "mm" => "RMS error (mm)",
                _ => "RMS error (mrad or mm)",
            },
            keys: self.keys(),
            joints: joints.collect(),
            mark: None,
        };
        dots.draw(medium)
    }
}

#[cfg(test)]
mod tests {
    use crate::sample::text_of_xml;
    use crate::tracking::sample;

    #[test]
    fn the_figure_shows_whole_runs_in_thousandths_and_stands_alone() {
        let mut comparison = sample::comparison();
        comparison.joints[0].name = "<b>&".into();
        let svg = comparison.error_figure().unwrap();
        let text = text_of_xml(&svg);
        for expected in ["arm: tracking error", "none (stopped)", "RMS error (mrad or mm)"] {
            assert!(text.contains(expected), "{expected} is missing in {text}");
        }
        assert!(text.contains("slide, rbd: 4.00") && !text.contains(", none"), "{text}");
        assert_eq!(svg.matches("http").count(), 1, "only the name space");
        assert!(!svg.contains("NaN") && !svg.contains("<b>") && !svg.contains("var("));
        comparison.joints.clear();
        comparison.models.clear();
        text_of_xml(&comparison.error_figure().unwrap());
    }
}
