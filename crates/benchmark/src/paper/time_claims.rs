use experiment::{Claim, ClaimCase, Scope};

/// The time of one prediction for a number of training points.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelTime {
    /// Name of the model.
    pub model: String,
    /// Number of training points.
    pub points: usize,
    /// Time of one prediction for all joints (us).
    pub microseconds: f64,
}

/// Share by which a time may exceed another and count as equal.
const ALIKE: f64 = 0.25;

/// The models of figure 1, the kernel as equation 10 evaluates it.
const RBD: &str = "rbd";
const GP: &str = "gp";
const GP_RBD: &str = "gp-rbd";

/// The claims of Nguyen-Tuong & Peters 2010 about figure 1, judged by the times. `kernel` is the name of the
/// rigid-body kernel as equation 10 evaluates it.
pub fn time_claims(times: &[ModelTime], kernel: &str) -> Vec<Claim> {
    let below = |model: &str, others: &[&str], factor: f64| -> Vec<ClaimCase> {
        others.iter().flat_map(|other| beside(times, model, other, factor)).collect()
    };
    let slowest = [RBD, GP, GP_RBD].map(|other| below(other, &[kernel], 1.0)).concat();
    vec![
        Claim::new(
            "rigid bodies alone predict fastest",
            Scope::Every,
            below(RBD, &[GP, GP_RBD, kernel], 1.0),
        ),
        Claim::new(
            "a Gaussian process about rigid bodies predicts as fast as one without: at most a quarter slower",
            Scope::Every,
            below(GP_RBD, &[GP], 1.0 + ALIKE),
        ),
        Claim::new(
            "the rigid-body kernel, evaluated as equation 10 has it, predicts slowest",
            Scope::Every,
            slowest,
        ),
    ]
}

/// Cases that compare the times of a model with those of another, wherever both are known.
fn beside(times: &[ModelTime], model: &str, other: &str, factor: f64) -> Vec<ClaimCase> {
    let of = |name: &str, points: usize| {
        let time = times.iter().find(|time| time.model == name && time.points == points);
        time.map(|time| time.microseconds)
    };
    let own = times.iter().filter(|time| time.model == model);
    let cases = own.filter_map(|time| {
        let limit = of(other, time.points)?;
        let place = format!("{} points", time.points);
        let subject = (model, Some(time.microseconds));
        Some(ClaimCase::beside(subject, (other, Some(limit)), &place, (factor, 0.0)))
    });
    cases.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use experiment::ClaimVerdict;

    fn times(at_1000: [f64; 4]) -> Vec<ModelTime> {
        let of = |points, times: [f64; 4]| {
            let models = ["rbd", "gp", "gp-rbd", "kernel"].into_iter().zip(times);
            models.map(move |(model, microseconds)| ModelTime {
                model: model.into(),
                points,
                microseconds,
            })
        };
        of(100, [0.5, 2.0, 2.4, 10.0]).chain(of(1000, at_1000)).collect()
    }

    #[test]
    fn every_claim_is_held_or_not_by_the_time_that_it_is_about() {
        let outcomes = |at_1000: [f64; 4]| -> Vec<bool> {
            let claims = time_claims(&times(at_1000), "kernel");
            claims.iter().map(|claim| claim.verdict == ClaimVerdict::Holds).collect()
        };
        assert_eq!(outcomes([0.5, 20.0, 20.6, 100.0]), [true, true, true]);
        assert_eq!(outcomes([21.0, 20.0, 20.6, 100.0]), [false, true, true]);
        assert_eq!(outcomes([0.5, 20.0, 25.1, 100.0]), [true, false, true]);
        assert_eq!(outcomes([0.5, 26.0, 20.6, 100.0]), [true, true, true], "faster is no fault");
        assert_eq!(outcomes([0.5, 20.0, 20.6, 20.3]), [true, true, false]);
    }

    #[test]
    fn times_that_were_not_measured_are_not_judged() {
        let claims = time_claims(&times([0.5, 20.0, 20.6, 100.0]), "another name");
        assert_eq!(claims[0].cases.len(), 4);
        assert_eq!(claims[2].verdict, ClaimVerdict::NotJudged);
    }
}
