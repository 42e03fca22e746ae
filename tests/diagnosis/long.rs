//! Of logs that are longer than they need to be an even choice takes part: it names what the whole does.

use checks::synthetic::Noise;
use logs::thin_out;

use crate::world::{World, against_nominal, finding, named, sign};

#[test]
fn an_even_choice_of_a_long_log_names_what_the_whole_does_and_says_so() {
    let world = World::nominal()
        .torque(3, |[_, qd, _]| 0.5 * sign(qd) + 0.6 * qd)
        .reading(2, |effort| effort + 0.3);
    let runs = world.runs(1, 360.0, &Noise::of_a_wam(), 6100);
    let whole = against_nominal(&runs).diagnosis;
    let part = against_nominal(&thin_out(runs, 210_000)).diagnosis;

    assert!(whole.findings.len() >= 3, "{:?}", named(&whole));
    assert_eq!(part.findings.len(), whole.findings.len(), "{:?}", named(&part));
    for known in &whole.findings {
        let words = known.at.words();
        let found = finding(&part, &words).unwrap_or_else(|| panic!("{words} is not named"));
        for (found, known) in found.parameters.iter().zip(&known.parameters) {
            let [low, high] = found.ci95;
            assert!((low..=high).contains(&known.value), "{words}: {found:?}, {known:?}");
            let widths = [found, known].map(|e| e.noise95[1] - e.noise95[0]);
            assert!(widths[0] > widths[1], "{words}: a third of a log says as much as all of it");
        }
    }

    let run = &part.data.runs[0];
    assert_eq!(run.samples, 30_000);
    assert!((run.duration_s - 120.0).abs() < 0.5 && (run.rate_hz - 250.0).abs() < 0.5, "{run:?}");
    let said = "of 6.0 min of logs 2.0 min take part";
    assert_eq!(part.warnings.iter().filter(|w| w.contains(said)).count(), 1, "{:?}", part.warnings);
    assert!(part.warnings.iter().all(|w| !w.contains("gap")), "{:?}", part.warnings);
}
