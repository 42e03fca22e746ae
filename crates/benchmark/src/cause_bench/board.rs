use crate::cause_bench::bench_set::BenchSet;
use crate::cause_bench::score_row::ScoreRow;
use crate::cause_bench::scores::BenchScores;

/// The page without its tables.
const PAGE: &str = include_str!("../../templates/cause_bench.md");

/// The entrant whose losses the page tells.
const OWN: &str = "plumbline";

/// The scores of several entrants side by side, set by set.
#[derive(Debug, Clone, PartialEq)]
pub struct BenchBoard {
    sets: Vec<SetBoard>,
}

/// The scores of entrants at one set.
#[derive(Debug, Clone, PartialEq)]
struct SetBoard {
    set: BenchSet,
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
        names || !matches!(self.name, "name: F1" | "causes named" | "width" | "abstain")
    }
}

impl BenchBoard {
    /// Of these scores, in their order behind those of Plumbline.
    pub fn new(mut entrants: Vec<BenchScores>) -> Self {
        entrants.sort_by_key(|one| one.entrant != OWN);
        let of = |set: BenchSet| {
            let here: Vec<BenchScores> =
                entrants.iter().filter(|one| one.set == set).cloned().collect();
            (!here.is_empty()).then_some(SetBoard { set, entrants: here })
        };
        Self { sets: BenchSet::ALL.into_iter().filter_map(of).collect() }
    }

    /// The page of the book, with the tables of these scores.
    pub fn page(&self) -> String {
        let tasks: Vec<String> = self.sets.iter().map(SetBoard::section).collect();
        let widest = self.sets.iter().filter(|one| one.names()).max_by_key(|one| one.count());
        let unnamed = self.sets.iter().filter(|one| !one.names());
        let sides: Vec<String> =
            widest.into_iter().chain(unnamed).map(SetBoard::by_sides).collect();
        let sections =
            [("tasks", tasks.join("\n")), ("cost", self.cost()), ("sides", sides.join("\n"))];
        sections.iter().fold(PAGE.to_owned(), |page, (name, table)| {
            page.replace(&format!("<!-- {name} -->\n"), table)
        })
    }

    /// What entrants are, and their processor time, a column a set.
    fn cost(&self) -> String {
        let mut names: Vec<&str> = Vec::new();
        for one in self.sets.iter().flat_map(|set| &set.entrants) {
            if !names.contains(&one.entrant.as_str()) {
                names.push(&one.entrant);
            }
        }
        let row = |name: &&str| {
            let of = |set: &SetBoard| set.entrants.iter().find(|one| one.entrant == *name).cloned();
            let mut programs: Vec<String> = Vec::new();
            for words in self.sets.iter().filter_map(of).filter_map(|one| one.program) {
                if !programs.contains(&words) {
                    programs.push(words);
                }
            }
            let program = if programs.is_empty() { "-".to_owned() } else { programs.join("; ") };
            let time = |set: &SetBoard| {
                let row = of(set).and_then(|one| one.rows.first().cloned());
                row.map_or_else(|| "-".to_owned(), |row| row.cost_s.words())
            };
            let times: Vec<String> = self.sets.iter().map(time).collect();
            format!("| {} | {} | {} |\n", in_cell(name), in_cell(&program), times.join(" | "))
        };
        let rows: String = names.iter().map(row).collect();
        let sets: Vec<String> =
            self.sets.iter().map(|one| format!("`{}` (s)", one.set.name())).collect();
        let line = "---|".repeat(sets.len());
        format!("| entrant | program | {} |\n|---|---|{line}\n{rows}", sets.join(" | "))
    }
}

impl SetBoard {
    /// Number of trials.
    fn count(&self) -> usize {
        self.entrants.first().and_then(|one| one.rows.first()).map_or(0, |row| row.count)
    }

    /// Whether an entrant names anything that counts.
    fn names(&self) -> bool {
        self.entrants.iter().filter_map(|one| one.rows.first()).any(|row| row.true_names.items > 0)
    }

    /// The set, its tasks, and where an entrant is better than Plumbline.
    fn section(&self) -> String {
        let (set, count) = (self.set.name(), self.count());
        let whole = self.set.population().map_or(count, |population| population.trials);
        let trials =
            if count < whole { format!("the first {count} of {whole}") } else { count.to_string() };
        let [tasks, behind] = [self.tasks(), self.behind()];
        format!(
            "Set `{set}`, {trials} trials:\n\n{tasks}\nWhere an entrant is better than Plumbline:\n\n{behind}"
        )
    }

    /// Names, where any count, and efforts by property of the trials.
    fn by_sides(&self) -> String {
        let names = self.by_side(|row| (row.true_names.items > 0).then(|| row.name.words()));
        let efforts = self.by_side(|row| row.predict.value.map(|_| row.predict.words()));
        let set = self.set.name();
        let efforts = format!("nMSE of predicted efforts, set `{set}`:\n\n{efforts}");
        if self.names() {
            format!("F1 of names, set `{set}`:\n\n{names}\n{efforts}")
        } else {
            efforts
        }
    }

    /// A row a task that anyone has a number of, a column an entrant, the best in bold.
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
        let has = |task: &&Task| self.entrants.iter().any(|one| task.of(one).is_some());
        self.header("task") + &TASKS.iter().filter(has).map(row).collect::<String>()
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
                format!("{} {words}", in_cell(&one.entrant))
            };
            let all: Vec<String> = self.entrants.iter().filter(better).map(told).collect();
            let own = own.rows.first().map(task.words)?;
            (!all.is_empty())
                .then(|| format!("- {}: {}; Plumbline {own}\n", task.name, all.join(", ")))
        };
        let lines: String = TASKS.iter().filter_map(line).collect();
        if lines.is_empty() { "- in none of the tasks\n".to_owned() } else { lines }
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
        Self { set: self.set, entrants }.header("trials") + &rows
    }

    fn header(&self, first: &str) -> String {
        let names: Vec<String> = self.entrants.iter().map(|one| in_cell(&one.entrant)).collect();
        format!("| {first} | {} |\n|---|{}\n", names.join(" | "), "---|".repeat(names.len()))
    }
}

/// Words of an entrant in a cell.
fn in_cell(words: &str) -> String {
    words.replace('_', " ").replace('|', "/")
}
