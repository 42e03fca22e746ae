use nalgebra::DVector;
use robot::Robot;

use crate::regression::uncertainty::Uncertainty;
use crate::result::Estimate;
use crate::search::constancy::size_variation;
use crate::search::model_state::{LastFit, SizeQuestion};
use crate::search::refusal::Refusal;
use crate::search::select::Selection;

/// The rules about the last fit, whose robot has the findings.
impl Selection<'_> {
    /// The size of `g` is determined and constant, as far as it is asked.
    pub fn has_a_size(&self, last: &LastFit, g: usize) -> Result<(), Refusal> {
        if last.question != SizeQuestion::Constancy {
            self.is_determined(last, g)?;
        }
        if last.question != SizeQuestion::Sizes {
            self.is_constant(last, g)?;
        }
        Ok(())
    }

    /// The logs determine the size of `g`. None of these holds:
    ///
    /// - its size, together with all others, is physically impossible,
    /// - it has one weight, and the 95 per cent interval of every parameter contains the described value,
    /// - it is a body, and the 95 per cent region of its ten parameters contains the described ones,
    /// - it is an asymmetry or an excess near rest, and its interval contains zero.
    fn is_determined(&self, last: &LastFit, g: usize) -> Result<(), Refusal> {
        let Some(uncertainty) = &last.uncertainty else { return Ok(()) };
        let thresholds = self.problem.thresholds;
        let group = &self.problem.design.groups[g];
        if !group.hypothesis.is_sound(&last.robot, &thresholds.priors) {
            return Err(Refusal::NotPhysical { weight: None });
        }
        if group.columns.len() == 1 {
            differs_from_description(
                &uncertainty.estimates(&last.linear, group.hypothesis, &[]),
                thresholds.sizes.rounding,
            )?;
        }
        self.is_changed_body(last, uncertainty, g)?;
        self.is_more_than_plain(last, uncertainty, g)
    }

    /// The 95 per cent region of a link's ten inertial parameters does not contain the described ones.
    fn is_changed_body(
        &self,
        last: &LastFit,
        uncertainty: &Uncertainty,
        g: usize,
    ) -> Result<(), Refusal> {
        let hypothesis = self.problem.design.groups[g].hypothesis;
        let design = last.linear.problem.design;
        let (Some(link), Some(group)) = (hypothesis.link(), design.find(hypothesis)) else {
            return Ok(());
        };
        let of =
            |robot: &Robot| DVector::from_column_slice(&robot.links()[link].inertia.parameters());
        let change = of(&last.robot) - of(last.linear.nominal);
        may_not_be_none(uncertainty, &design.groups[group].columns, &change)
    }

    /// The weights that distinguish an effect from a simpler one at the same place are not zero.
    fn is_more_than_plain(
        &self,
        last: &LastFit,
        uncertainty: &Uncertainty,
        g: usize,
    ) -> Result<(), Refusal> {
        let hypothesis = self.problem.design.groups[g].hypothesis;
        let design = last.linear.problem.design;
        let Some(group) = design.find(hypothesis) else { return Ok(()) };
        let columns = &design.groups[group].columns;
        let robots = [last.linear.nominal, &last.robot];
        let more = hypothesis.more_than_plain(robots, &design.frame, &design.priors);
        more.into_iter().try_for_each(|(weight, change)| match columns.get(weight) {
            Some(&k) => may_not_be_none(uncertainty, &[k], &DVector::from_element(1, change)),
            None => Ok(()),
        })
    }

    /// One size of `g` holds for all of the logs.
    fn is_constant(&self, last: &LastFit, g: usize) -> Result<(), Refusal> {
        let group = &self.problem.design.groups[g];
        let size: Vec<f64> = group.columns.iter().map(|&k| last.first_weights[k]).collect();
        let own = last.linear.problem.design.find(group.hypothesis);
        let variation = own.and_then(|own| size_variation(&last.linear, own, &size));
        variation.map_or(Ok(()), |variation| Err(Refusal::Varies(variation)))
    }
}

/// The interval of one of the parameters does not contain the described value.
fn differs_from_description(estimates: &[Estimate], rounding: f64) -> Result<(), Refusal> {
    let holds = |e: &Estimate| {
        let rounding = rounding * (e.ci95[1] - e.ci95[0]);
        (e.ci95[0] - rounding..=e.ci95[1] + rounding).contains(&e.nominal)
    };
    if !estimates.iter().all(holds) {
        return Ok(());
    }
    Err(estimates.first().map_or(Refusal::NotShown, |e| Refusal::MayBeDescribed {
        parameter: e.name,
        described: e.nominal,
        ci95: e.ci95,
        unit: e.unit,
    }))
}

/// The 95 per cent region of some weights excludes that they do not change.
fn may_not_be_none(
    uncertainty: &Uncertainty,
    columns: &[usize],
    change: &DVector<f64>,
) -> Result<(), Refusal> {
    match uncertainty.chi2_and_limit(columns, change) {
        Some([chi2, limit]) if chi2 < limit => Err(Refusal::MayBeNone { chi2, limit }),
        _ => Ok(()),
    }
}
