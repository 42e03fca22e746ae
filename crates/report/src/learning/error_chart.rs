use crate::learning::comparison::LearningComparison;
use pages::{Dots, JointDots, LegendKey, Medium, ReportError};

impl LearningComparison {
    /// `figure.svg`: the error of every model at every joint as dots on a logarithmic axis, as
    /// in figure 2 of Nguyen-Tuong & Peters 2010, in a drawing that stands alone.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn figure(&self) -> Result<String, ReportError> {
        self.draw(Medium::Alone)
    }

    pub(crate) fn draw(&self, medium: Medium) -> Result<String, ReportError> {
        let joints = self.joints.iter().enumerate().map(|(i, joint)| JointDots {
            name: joint.name.clone(),
            values: self
                .models
                .iter()
                .map(|model| model.nmse.get(i).copied().unwrap_or(f64::NAN))
                .collect(),
            floor: None,
        });
        let dots = Dots {
            title: format!("{}: error of learned models by joint", self.robot),
            subtitle: format!(
                "MSE over variance of the effort on {} held-out samples, trained on {} of {}; \
                 logarithmic, lower is better",
                self.test.points, self.train.points, self.train.rows
            ),
            axis: "nMSE",
            keys: LegendKey::of_models(self.models.iter().map(|model| model.name.as_str())),
            joints: joints.collect(),
            mark: Some((1.0, "as far off as the mean effort")),
        };
        dots.draw(medium)
    }
}

#[cfg(test)]
mod tests {
    use crate::learning::sample;
    use crate::sample::text_of_xml;

    #[test]
    fn the_figure_is_xml_that_stands_alone() {
        let mut comparison = sample::comparison();
        comparison.joints[0].name = "<b>&".into();
        let svg = comparison.figure().unwrap();
        let text = text_of_xml(&svg);
        for expected in ["arm: error of learned models by joint", "elbow", "gp-rbd", "0.01"] {
            assert!(text.contains(expected), "{expected} is missing in {text}");
        }
        assert_eq!(svg.matches("http").count(), 1, "only the name space");
        assert!(!svg.contains("NaN") && !svg.contains("<b>"));
        comparison.models.clear();
        text_of_xml(&comparison.figure().unwrap());
    }
}
