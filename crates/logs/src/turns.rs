use std::f64::consts::TAU;

/// Farthest that a link lies from its motor (rad): far more than a transmission gives.
const APART: f64 = 0.5;

/// The position of the link of a rotation (rad) on the turn of its motor's `position`: an encoder
/// that knows one turn alone starts anew after it.
///
/// ```text
/// link + 2 pi round((position - link) / 2 pi)
/// ```
///
/// One that does not keep to the motor then either is no encoder of this link, and stays as it is.
pub(crate) fn on_the_turn_of(position: &[f64], link: Vec<f64>) -> Vec<f64> {
    let turned = |(q, link): (&f64, &f64)| {
        let turns = ((q - link) / TAU).round();
        if turns.abs() > 0.0 { link + TAU * turns } else { *link }
    };
    let found: Vec<f64> = position.iter().zip(&link).map(turned).collect();
    let keeps = found.iter().zip(position).all(|(link, q)| (link - q).abs() < APART);
    if keeps { found } else { link }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn swing() -> Vec<f64> {
        (0..1000).map(|k| 5.0 * (0.01 * f64::from(k)).sin()).collect()
    }

    #[test]
    fn an_encoder_of_one_turn_is_taken_to_that_of_its_motor() {
        let link: Vec<f64> = swing().iter().map(|q| q - 0.01).collect();
        let wrapped = link.iter().map(|q| q.rem_euclid(TAU)).collect();
        let found = on_the_turn_of(&swing(), wrapped);
        assert!(found.iter().zip(&link).all(|(a, b)| (a - b).abs() < 1e-12));
        assert_eq!(on_the_turn_of(&swing(), link.clone()), link);
    }

    #[test]
    fn what_does_not_keep_to_the_motor_stays_as_it_is() {
        let reversed: Vec<f64> = swing().iter().map(|q| -q).collect();
        assert_eq!(on_the_turn_of(&swing(), reversed.clone()), reversed);
    }
}
