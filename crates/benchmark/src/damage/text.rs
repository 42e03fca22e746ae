use crate::damage::curves::{DAMAGE_SIZES, DamageCurves, DamageTrial};
use crate::damage::outcome::DamageOutcome;
use crate::statistics::text_table::TextTable;

impl DamageCurves {
    /// The table of all kinds and sizes: a letter a trial, in their order, and how often each outcome came.
    pub fn text(&self) -> String {
        let mut kinds: Vec<_> = self.points.iter().map(|point| point.kind).collect();
        kinds.dedup();
        let sizes = DAMAGE_SIZES.map(|size| format!("{} %", 100.0 * size));
        let rows = kinds.iter().map(|kind| {
            let cell = |size: f64| -> String {
                let here = self
                    .points
                    .iter()
                    .filter(|point| point.kind == *kind && point.size.total_cmp(&size).is_eq());
                here.map(|point| letter(point.outcome)).collect()
            };
            let name = kind.name().replace('_', " ");
            std::iter::once(name).chain(DAMAGE_SIZES.map(cell)).collect()
        });
        let table = TextTable {
            title: "Answers to spoilt logs: a letter a trial".to_owned(),
            header: std::iter::once(String::new()).chain(sizes).collect(),
            rows: rows.collect(),
        };
        let legend = DamageOutcome::ALL
            .map(|outcome| format!("{} {outcome} {}", letter(outcome), self.count(outcome)));
        let trial = |(number, trial): (usize, &DamageTrial)| {
            let names = match trial.names.as_slice() {
                [] => "nothing named".to_owned(),
                names => names.join(", "),
            };
            format!("{}  {} {}: {}, {names}\n", number + 1, trial.arm, trial.seed, trial.verdict)
        };
        let trials: String = self.trials.iter().enumerate().map(trial).collect();
        format!("{}\n{}\n\nBefore the damage\n{trials}", table.text(1), legend.join(", "))
    }
}

fn letter(outcome: DamageOutcome) -> char {
    match outcome {
        DamageOutcome::Right => '.',
        DamageOutcome::Told => 't',
        DamageOutcome::Open => 'o',
        DamageOutcome::Changed => 'c',
        DamageOutcome::Wrong => 'W',
    }
}
