use crate::run::rows::{JointNumbers, joint_numbers};
use crate::run::run_report::{RunReport, THOUSANDTHS};
use pages::{Dots, JointDots, LegendKey, Medium, ReportError};

/// A chart of the page, with what it shows.
pub(crate) struct GainChart {
    pub title: &'static str,
    pub words: String,
    pub svg: String,
}

impl RunReport<'_> {
    /// The numbers before and after, joint by joint, as dots.
    pub(crate) fn charts(&self) -> Result<Vec<GainChart>, ReportError> {
        let numbers = joint_numbers(self.metrics);
        let chart = |title: &'static str, axis: &'static str, of: fn(&JointNumbers) -> [f64; 2]| {
            let joints = self.metrics.joints.iter().zip(&numbers);
            let dots = Dots {
                title: format!("{}: {title}", self.metrics.robot),
                subtitle: String::new(),
                axis,
                keys: LegendKey::of_models(["nominal", "extended"].into_iter()),
                joints: joints
                    .map(|(name, numbers)| JointDots {
                        name: name.clone(),
                        values: of(numbers).to_vec(),
                        floor: None,
                    })
                    .collect(),
                mark: None,
            };
            dots.draw(Medium::Page)
        };
        let unseen = self.test_runs();
        let unit = self.position_unit();
        Ok(vec![
            GainChart {
                title: "Torque",
                words: format!("Measured minus predicted torque, RMS, on {unseen}."),
                svg: chart("error of the torque", "RMS error (N·m or N)", |n| n.torque)?,
            },
            GainChart {
                title: "Simulation",
                words: format!(
                    "The simulation starts from the measured state and is moved by the measured \
                     torque for 200 ms: how far it is off then, RMS over all such windows of \
                     {unseen}."
                ),
                svg: chart("drift of the simulation", unit, |n| n.drift)?,
            },
            GainChart {
                title: "Tracking",
                words: format!(
                    "RMS error of the arm along the motion of the scenario with the gains {}, \
                     the torque of the model fed forward.",
                    self.metrics.gains
                ),
                svg: chart("error of the tracking", unit, |n| n.tracking)?,
            },
        ])
    }

    /// The errors of the tracking with everything that was fed forward, as dots.
    pub(crate) fn tracking_dots(&self) -> Result<String, ReportError> {
        let error = |rms: &Option<Vec<f64>>, j: usize| {
            let rms = rms.as_ref().and_then(|rms| rms.get(j)).copied();
            THOUSANDTHS * rms.unwrap_or(f64::NAN)
        };
        let joints = self.metrics.joints.iter().enumerate().map(|(j, name)| JointDots {
            name: name.clone(),
            values: self.metrics.tracking.iter().map(|run| error(&run.rms, j)).collect(),
            floor: None,
        });
        let dots = Dots {
            title: format!("{}: error of the tracking with every model", self.metrics.robot),
            subtitle: String::new(),
            axis: self.position_unit(),
            keys: LegendKey::of_models(self.metrics.tracking.iter().map(|run| run.model.as_str())),
            joints: joints.collect(),
            mark: None,
        };
        dots.draw(Medium::Page)
    }
}

#[cfg(test)]
mod tests {
    use robot::JointKind;

    use crate::run::sample;

    /// Drift and tracking as the tables tell them: 80 mrad of the shoulder, and mm where a joint slides.
    #[test]
    fn charts_of_positions_are_in_thousandths_as_the_tables_are() {
        let mut sample = sample::run();
        let drawn = |sample: &sample::RunSample| {
            let charts = sample.report().charts().unwrap();
            let of = |title| charts.iter().find(|chart| chart.title == title).unwrap().svg.clone();
            ["Simulation", "Tracking"].map(of)
        };
        for (svg, shoulder) in drawn(&sample).iter().zip(["80.0", "30.0"]) {
            assert!(svg.contains(&format!("shoulder, nominal: {shoulder}")), "{svg}");
            assert!(svg.contains(">mrad<"), "{svg}");
        }
        let mut links = sample.diagnosed.robot.links().to_vec();
        links.iter_mut().for_each(|link| link.joint.kind = JointKind::Prismatic);
        sample.diagnosed.robot =
            robot::Robot::new("arm", nalgebra::Vector3::zeros(), links).unwrap();
        assert!(drawn(&sample).iter().all(|svg| svg.contains(">mm<")));
        let page = sample.report().page().unwrap();
        assert!(page.contains("Drift of the simulation (mm)") && page.contains(">80.0<"));
    }
}
