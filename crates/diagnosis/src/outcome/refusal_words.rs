use crate::outcome::effect_at::effect_at;
use crate::outcome::finding_builder::FindingBuilder;
use crate::outcome::size::size;
use crate::search::constancy::Variation;
use crate::search::refusal::Refusal;
use crate::signals::response::Response;

impl FindingBuilder<'_> {
    /// The entry of `g` in the ledger, in words. What adds too little is not shown by logs that would show none of its
    /// sizes.
    pub fn words_for_refusal(&self, g: usize, smallest: Option<(usize, f64)>) -> String {
        let Some(refusal) = self.ledger.refusal(g) else {
            return "no rule refuses it: the search ended before it was asked beside these findings"
                .to_owned();
        };
        match refusal {
            Refusal::NotShown => "these logs cannot show it".to_owned(),
            Refusal::TooLittleEvidence { .. } | Refusal::AddsTooLittle { .. }
                if smallest.is_none() =>
            {
                "these logs cannot show it".to_owned()
            }
            Refusal::OtherName { of } => {
                format!("{} changes the same numbers", self.words_for(*of))
            }
            Refusal::TooLittleEvidence { gain, least, taken_by } => {
                let words = format!("it adds {gain:.1} to the log evidence, {least:.0} are needed");
                match taken_by {
                    Some(m) => format!("{words}: {} takes its torque", self.words_for(*m)),
                    None => words,
                }
            }
            Refusal::AddsTooLittle { gain, least } => format!(
                "beyond simpler effects it adds {gain:.1} to the log evidence, {least:.0} are needed"
            ),
            Refusal::NotPhysical { weight } => self.words_for_size(g, *weight),
            Refusal::NoBody { kept, least } => format!(
                "a physical body explains {:.0} % of what its best size does, {:.0} % are needed",
                100.0 * kept.max(0.0),
                100.0 * least
            ),
            Refusal::NoBetterPrediction { at, by, least } => {
                self.words_for_prediction(*at, *by, *least)
            }
            Refusal::MayBeDescribed { parameter, described, ci95: [low, high], unit } => format!(
                "its {} may be the described {} {unit}: the interval is {} to {}",
                parameter.replace('_', " "),
                number(*described),
                number(*low),
                number(*high)
            ),
            Refusal::MayBeNone { chi2, limit } => {
                format!("its size may be none: chi squared is {chi2:.1}, {limit:.1} are needed")
            }
            Refusal::Varies(variation) => self.words_for_variation(variation),
            Refusal::WorseThanTwin { twin, errors, most } => format!(
                "about the robot that has it, it does worse than {} by {errors:.1} standard errors, {most:.0} decide",
                self.words_for(*twin)
            ),
            Refusal::KeepsDescription { at, described, fitted } => format!(
                "what was fitted at {} predicts efforts that took no part with an error of {} instead of {} {}: it keeps its description",
                self.joint_name(*at),
                size(*fitted),
                size(*described),
                self.unit_at(*at)
            ),
        }
    }

    fn words_for(&self, g: usize) -> String {
        let hypothesis = self.selection.problem.design.groups[g].hypothesis;
        effect_at(self.selection.robot, hypothesis).words()
    }

    /// The reason against a size beyond what is possible. The first parameters stand for the first weights.
    fn words_for_size(&self, g: usize, weight: Option<(usize, f64)>) -> String {
        let parameters = self.selection.problem.design.groups[g].hypothesis.kind.entry().parameters;
        let parameter = |index: usize| parameters.get(index).or(parameters.last());
        match weight.and_then(|(index, weight)| Some((weight, parameter(index)?))) {
            Some((weight, parameter)) => format!(
                "its best size is not physically possible: {} {} beside the description",
                number(weight),
                parameter.unit
            ),
            None => "its best size is not physically possible".to_owned(),
        }
    }

    fn words_for_prediction(&self, at: Option<usize>, by: f64, least: f64) -> String {
        let Some(j) = at else {
            return format!(
                "it raises the squared error of held-out data, over all joints, by {}",
                number(-by)
            );
        };
        let (name, unit) = (self.joint_name(j), self.unit_at(j));
        let change = if by < 0.0 { "raises" } else { "lowers" };
        let by = number(by.abs());
        format!(
            "it {change} the held-out error at {name} by {by} {unit} RMS, a fall of {} is needed",
            number(least)
        )
    }

    /// The reason against an effect whose size would have to vary.
    fn words_for_variation(&self, Variation { rms, with, joint }: &Variation) -> String {
        let name = self.joint_name(*joint);
        let with = with
            .map_or_else(|| format!("at {name}"), |signal| format!("with the {signal} of {name}"));
        format!(
            "its size would have to vary by {:.0} % {with}, and that of a cause is one",
            100.0 * rms
        )
    }

    fn joint_name(&self, j: usize) -> &str {
        &self.selection.robot.links()[j].joint.name
    }

    /// The unit of what is explained at a joint.
    fn unit_at(&self, j: usize) -> &'static str {
        let rotates = self.selection.robot.links()[j].joint.kind.is_rotation();
        match (self.selection.problem.design.response, rotates) {
            (Response::Effort, true) => "N m",
            (Response::Effort, false) => "N",
            (Response::Twist, true) => "rad",
            (Response::Twist, false) => "m",
        }
    }
}

/// A number with four digits, or as a power of ten where it is very small or large.
fn number(value: f64) -> String {
    let digits = if value.abs() > 0.0 { 3 - value.abs().log10().floor() as i32 } else { 0 };
    match usize::try_from(digits) {
        Ok(decimals) if decimals <= 6 => format!("{value:.decimals$}"),
        _ => format!("{value:.1e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_about_one_does_not_read_as_one() {
        let words = [0.99734, 1.00217, -12.3456, 0.0, 1.2345e-6, 123_456.0].map(number);
        assert_eq!(words, ["0.9973", "1.002", "-12.35", "0", "1.2e-6", "1.2e5"]);
    }
}
