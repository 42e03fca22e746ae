use std::collections::BTreeSet;
use std::num::NonZeroUsize;
use std::path::Path;

use report::quote_argument;

use crate::commands::submit::sbatch_option::SbatchOption;
use crate::submit_error::SubmitError;

/// The variable that tells an entrant its part, such as `2/100`.
pub const PART: &str = "CAUSE_BENCH_PART";

/// An array job: a task for every part of which something is left.
pub struct ArrayJob<'a> {
    /// What its tasks do.
    pub task: TaskKind<'a>,
    /// The folder that the job and what its tasks say lie in, from the root.
    pub folder: &'a Path,
    /// The parts, counted from 1.
    pub numbers: BTreeSet<usize>,
    /// Of how many.
    pub parts: NonZeroUsize,
    /// Processors of a task.
    pub jobs: NonZeroUsize,
    /// What `sbatch` is told besides.
    pub options: &'a [SbatchOption],
}

/// What a task does.
pub enum TaskKind<'a> {
    /// This program makes trials of the campaign in the folder.
    Work { program: &'a Path },
    /// An entrant of CauseBench answers trials of a set.
    Entrant { command: &'a [String] },
}

impl ArrayJob<'_> {
    /// The script that `sbatch` takes.
    ///
    /// # Errors
    ///
    /// [`SubmitError::Path`] for a path that cannot stand in it.
    pub fn script(&self) -> Result<String, SubmitError> {
        let folder = nameable(self.folder)?;
        // Slurm reads a percent sign as the start of a number to put in.
        let output = format!("--output={}/slurm/%A_%a.log", folder.replace('%', "%%"));
        let options = [
            "--job-name=plumbline".to_owned(),
            format!("--array={}", ranges(&self.numbers)),
            "--ntasks=1".to_owned(),
            format!("--cpus-per-task={}", self.jobs),
            "--requeue".to_owned(),
            "--open-mode=append".to_owned(),
            output,
        ];
        let options = options.into_iter().chain(self.options.iter().map(ToString::to_string));
        let options: String = options.map(|o| format!("#SBATCH {}\n", in_a_comment(&o))).collect();
        let part = format!("\"$SLURM_ARRAY_TASK_ID/{}\"", self.parts);
        let (what, lines) = match self.task {
            TaskKind::Work { program } => {
                let [program, folder] = [nameable(program)?, folder].map(quote_argument);
                let work = format!("exec {program} work {folder} --part {part}");
                ("The blind trials", format!("{work} --jobs {} --quiet", self.jobs))
            }
            TaskKind::Entrant { command } => {
                let words: Vec<String> = command.iter().map(|word| quote_argument(word)).collect();
                let export = format!("export {PART}={part}");
                ("The answers of an entrant", format!("{export}\nexec {}", words.join(" ")))
            }
        };
        Ok(format!(
            "#!/bin/sh\n\
             # {what} that are left, a part a task. What is made when a node fails is not\n\
             # made again.\n\
             {options}\n\
             {lines}\n"
        ))
    }
}

/// A path that both a shell and the lines for `sbatch` can name.
fn nameable(path: &Path) -> Result<&str, SubmitError> {
    let named = path.to_str().filter(|text| !text.contains(|c: char| c.is_control() || c == '\\'));
    named.ok_or_else(|| SubmitError::Path { path: path.to_owned() })
}

/// An option in a line for `sbatch`, which takes quotes and backslashes as a shell does but
/// nothing else.
fn in_a_comment(option: &str) -> String {
    if !option.contains(|c: char| c.is_whitespace() || "\"'\\#".contains(c)) {
        return option.to_owned();
    }
    format!("\"{}\"", option.replace('\\', r"\\").replace('"', "\\\""))
}

/// Numbers as Slurm takes them: `1-3,7`.
fn ranges(numbers: &BTreeSet<usize>) -> String {
    let mut ranges: Vec<(usize, usize)> = Vec::new();
    for &number in numbers {
        match ranges.last_mut() {
            Some((_, last)) if *last + 1 == number => *last = number,
            _ => ranges.push((number, number)),
        }
    }
    let text = |(first, last): &(usize, usize)| {
        if first == last { first.to_string() } else { format!("{first}-{last}") }
    };
    ranges.iter().map(text).collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbouring_numbers_become_a_range() {
        let text = |numbers: &[usize]| ranges(&numbers.iter().copied().collect());
        assert_eq!(text(&[7, 1, 2, 3]), "1-3,7");
        assert_eq!(text(&[1, 3, 5, 6]), "1,3,5-6");
        assert_eq!(text(&[4]), "4");
    }
}
