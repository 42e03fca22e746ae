use crate::cause_bench::score_row::ScoreRow;
use crate::cause_bench::scores::BenchScores;
use crate::statistics::middle::Middle;

/// The page without its tables.
const PAGE: &str = include_str!("../../templates/cause_bench.md");

/// The entrant whose losses the page tells.
const OWN: &str = "plumbline";

/// The scores of several entrants side by side.
#[derive(Debug, Clone, PartialEq)]
pub struct BenchBoard {
    entrants: Vec<BenchScores>,
}

/// A number of the first table.
struct Task {
    name: &'static str,
    words: fn(&ScoreRow) -> String,
    value: fn(&ScoreRow) -> Option<f64>,
    best: Best,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Best {
    Largest,
    Smallest,
    /// It says nothing of how good an entrant is.
    None,
}

const TASKS: [Task; 10] = [
    task("name: F1", |r| r.name.words(), |r| r.name.value, Best::Largest),
    task("names true", |r| r.true_names.words(), |r| r.true_names.value, Best::Largest),
    task("causes named", |r| r.named.words(), |r| r.named.value, Best::Largest),
    task("size: inside", |r| r.size.words(), |r| r.size.value, Best::Largest),
    task("width", |r| r.sharpness.words(), |r| r.sharpness.value, Best::None),
    task("predict: nMSE", |r| r.predict.words(), |r| r.predict.value, Best::Smallest),
    task("replay: 50 ms", |r| r.replay[0].words(), |r| r.replay[0].value, Best::Smallest),
    task("replay: 200 ms", |r| r.replay[1].words(), |r| r.replay[1].value, Best::Smallest),
    task("replay: 1 s", |r| r.replay[2].words(), |r| r.replay[2].value, Best::Smallest),
    task("abstain", |r| r.abstain.words(), |r| r.abstain.value, Best::Largest),
];

const fn task(
    name: &'static str,
    words: fn(&ScoreRow) -> String,
    value: fn(&ScoreRow) -> Option<f64>,
    best: Best,
) -> Task {
    Task { name, words, value, best }
}

impl Best {
    /// Whether a number is better than another.
    fn prefers(self, number: f64, other: f64) -> bool {
        match self {
            Self::Largest => number > other,
            Self::Smallest => number < other,
            Self::None => false,
        }
    }
}

impl Task {
    /// The number of an entrant over all trials. Who names nothing has no F1.
    fn of(&self, entrant: &BenchScores) -> Option<f64> {
        let row = entrant.rows.first()?;
        (self.value)(row).filter(|_| self.takes_part(row))
    }

    fn takes_part(&self, row: &ScoreRow) -> bool {
        let names = row.true_names.items > 0;
        names || !matches!(self.name, "name: F1" | "causes named" | "abstain")
    }
}

impl BenchBoard {
    /// Of these scores, in their order behind those of Plumbline.
    pub fn new(mut entrants: Vec<BenchScores>) -> Self {
        entrants.sort_by_key(|one| one.entrant != OWN);
        Self { entrants }
    }

    /// The page of the book, with the tables of these scores.
    pub fn page(&self) -> String {
        let sections = [
            ("set", self.set()),
            ("tasks", self.tasks()),
            ("behind", self.behind()),
            ("cost", self.cost()),
            ("names", self.by_side(|row| (row.true_names.items > 0).then(|| row.name.words()))),
            ("efforts", self.by_side(|row| row.predict.value.map(|_| row.predict.words()))),
        ];
        sections.iter().fold(PAGE.to_owned(), |page, (name, table)| {
            page.replace(&format!("<!-- {name} -->\n"), table)
        })
    }

    /// The sets of the scores, each with the number of its trials.
    fn set(&self) -> String {
        let words = |one: &BenchScores| {
            let count = one.rows.first().map_or(0, |row| row.count);
            format!("Set `{}`, {count} trials.\n", one.set.name())
        };
        let mut sets: Vec<String> = self.entrants.iter().map(words).collect();
        sets.dedup();
        sets.concat()
    }

    /// The first table: a row a task, a column an entrant, the best in bold.
    fn tasks(&self) -> String {
        let row = |task: &Task| {
            let best = self.entrants.iter().filter_map(|one| task.of(one)).fold(None, |best, x| {
                Some(best.filter(|best| !task.best.prefers(x, *best)).unwrap_or(x))
            });
            let cell = |entrant: &BenchScores| {
                let Some(row) = entrant.rows.first() else { return "-".to_owned() };
                let words = if task.takes_part(row) { (task.words)(row) } else { "-".to_owned() };
                let is_best = task.best != Best::None
                    && task
                        .of(entrant)
                        .zip(best)
                        .is_some_and(|(x, best)| x.total_cmp(&best).is_eq());
                if is_best { format!("**{words}**") } else { words }
            };
            let cells: Vec<String> = self.entrants.iter().map(cell).collect();
            format!("| {} | {} |\n", task.name, cells.join(" | "))
        };
        self.header("task") + &TASKS.iter().map(row).collect::<String>()
    }

    /// Where an entrant is better than Plumbline, a line a task.
    fn behind(&self) -> String {
        let Some(own) = self.entrants.iter().find(|one| one.entrant == OWN) else {
            return String::new();
        };
        let line = |task: &Task| {
            let own_number = task.of(own)?;
            let better =
                |one: &&BenchScores| task.of(one).is_some_and(|x| task.best.prefers(x, own_number));
            let told = |one: &BenchScores| {
                let words = one.rows.first().map(task.words).unwrap_or_default();
                format!("{} {words}", cell_name(&one.entrant))
            };
            let all: Vec<String> = self.entrants.iter().filter(better).map(told).collect();
            let own = own.rows.first().map(task.words)?;
            (!all.is_empty())
                .then(|| format!("- {}: {}; Plumbline {own}\n", task.name, all.join(", ")))
        };
        let lines: String = TASKS.iter().filter_map(line).collect();
        if lines.is_empty() { "- in none of the tasks\n".to_owned() } else { lines }
    }

    fn cost(&self) -> String {
        let row = |one: &BenchScores| {
            let cost = one.rows.first().map_or_else(Middle::default, |row| row.cost_s);
            format!("| {} | {} | {} |\n", cell_name(&one.entrant), cost.words(), cost.of)
        };
        let rows: String = self.entrants.iter().map(row).collect();
        format!(
            "| entrant | processor time (s) | trials answered with a time |\n|---|---|---|\n{rows}"
        )
    }

    /// A table of one number by property of the trials, of the entrants that have it.
    fn by_side(&self, number: fn(&ScoreRow) -> Option<String>) -> String {
        let has = |one: &&BenchScores| one.rows.first().and_then(number).is_some();
        let entrants: Vec<BenchScores> = self.entrants.iter().filter(has).cloned().collect();
        let sides = entrants.first().map(|one| one.rows.clone()).unwrap_or_default();
        let row = |side: &ScoreRow| {
            let cell = |one: &BenchScores| {
                let row = one.rows.iter().find(|row| row.trials == side.trials);
                row.and_then(number).unwrap_or_else(|| "-".to_owned())
            };
            let cells: Vec<String> = entrants.iter().map(cell).collect();
            format!("| {} ({}) | {} |\n", side.trials, side.count, cells.join(" | "))
        };
        let rows: String = sides.iter().map(row).collect();
        Self { entrants }.header("trials") + &rows
    }

    fn header(&self, first: &str) -> String {
        let names: Vec<String> = self.entrants.iter().map(|one| cell_name(&one.entrant)).collect();
        format!("| {first} | {} |\n|---|{}\n", names.join(" | "), "---|".repeat(names.len()))
    }
}

/// The name of an entrant in a cell.
fn cell_name(name: &str) -> String {
    name.replace('_', " ").replace('|', "/")
}
