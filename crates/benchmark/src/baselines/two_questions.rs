use logs::{PrepareSettings, Run};
use robot::Robot;

use crate::baselines::baseline::{Baseline, Nominal, Weighted};
use crate::baselines::candidate::{Candidate, candidates};
use crate::baselines::competition::{Change, Competition, Standing};
use crate::baselines::dataset::{Dataset, Target};
use crate::baselines::fit::fit;
use crate::baselines::prepare_runs::{prepare_runs, slowest_rate_hz};
use crate::baselines::scales::Scales;
use crate::baselines::shape::Shape;
use crate::error::BenchmarkError;

/// Highest cut-off (Hz), and the highest as a share of the rate of the log.
const CUTOFF_HZ: f64 = 13.0;
const CUTOFF_SHARE: f64 = 0.2;

/// Evidence that a name needs to enter (nats).
const THRESHOLD: f64 = 5.0;

/// Evidence below which a name is removed again (nats).
const NEEDED: f64 = 1.0;

/// Number of candidates, strongest first, that get the second question.
const ASKED: usize = 16;

/// Share of the best prediction at which a simpler name is preferred.
const NEARLY: f64 = 0.9;

/// Most names, and most times that one enters.
const MOST_NAMES: usize = 30;
const MOST_STEPS: usize = 60;

/// Names causes by two questions alone.
///
/// ```text
/// 1. does the log prefer the effort with the name?   evidence of effective samples > 5 nats
/// 2. do the names predict what took no part better?  by 0.5 % of the torque, 2 % of the error
/// ```
///
/// Both are answered by least squares on tangents about the nominal robot, joint by joint. Of the names that predict
/// nearly as well as the best, the one with the fewest columns enters. A name that is no longer needed is removed.
/// The result is sorted by the evidence that is lost without each name, the largest first.
///
/// Held-out samples are whole runs, or quarters of runs where there are fewer than three. The band ends at 13 Hz or a
/// fifth of the slowest log's rate. Joints share no weights, bodies need not be physical, and play, presliding and
/// limits have no name.
///
/// Cost: with `N` samples at 2.5 cut-offs, `m` columns at a joint and `n` joints, about
/// `250 N m n` operations for columns in the band, `2 N m² n` for their sums of products, and
/// `2 N p` for every candidate beside `p` chosen columns, once whenever those change: 0.5, 0.6 and
/// 0.5 Gflop for four runs of 20 s of seven joints.
///
/// # Errors
///
/// [`ExperimentError::Log`](experiment::ExperimentError::Log) for runs that cannot be prepared.
pub fn two_questions(
    robot: &Robot,
    control_rate_hz: Option<f64>,
    runs: &[Run],
) -> Result<Baseline, BenchmarkError> {
    let cutoff_hz = CUTOFF_HZ.min(CUTOFF_SHARE * slowest_rate_hz(runs));
    let settings = PrepareSettings { cutoff_hz: Some(cutoff_hz) };
    let logs = prepare_runs(robot, control_rate_hz, runs, &settings)?;
    let scales = Scales::of(robot, &logs);
    let candidates = candidates(robot, &scales);
    let shapes = shapes(robot.joint_count(), &candidates);
    let dataset = Dataset::of((robot, &scales), &logs, shapes, Target::Gap)?;
    let mut search = Search::new(&dataset, &candidates);
    search.run();
    let names = search.strongest_first().into_iter().map(|c| candidates[c].at.clone()).collect();
    let weights = (0..robot.joint_count()).map(|j| weights(&dataset, j, &search)).collect();
    Ok(Baseline::new(names, weights, (Nominal::Kept, scales)))
}

/// Every shape of some candidates once, by joint.
fn shapes(joints: usize, candidates: &[Candidate]) -> Vec<Vec<Shape>> {
    let mut shapes = vec![Vec::new(); joints];
    for (j, part) in candidates.iter().flat_map(|c| &c.parts) {
        shapes[*j].extend_from_slice(part);
    }
    for shapes in &mut shapes {
        shapes.sort_unstable();
        shapes.dedup();
    }
    shapes
}

/// The weights of the chosen columns at a joint, fitted to all samples.
fn weights(dataset: &Dataset, j: usize, search: &Search) -> Vec<Weighted> {
    let (joint, columns) = (&dataset.joints[j], &search.standings[j].columns);
    let fitted = fit(&joint.total, columns, joint.target()).weights;
    let with_weight = |(&column, weight): (&usize, f64)| Weighted {
        shape: joint.shapes[column],
        weight: weight / joint.scales[column],
    };
    columns.iter().zip(fitted).map(with_weight).collect()
}

/// The names so far and their residuals.
struct Search<'a> {
    competition: Competition<'a>,
    candidates: &'a [Candidate],
    chosen: Vec<usize>,
    standings: Vec<Standing>,
    /// Answers to both questions by candidate and part, while they are valid.
    asked: Vec<Vec<Option<Change>>>,
    predicted: Vec<Vec<Option<Change>>>,
}

impl<'a> Search<'a> {
    fn new(dataset: &'a Dataset, candidates: &'a [Candidate]) -> Self {
        let competition = Competition::new(dataset);
        let standings = (0..dataset.joints.len()).map(|j| competition.standing(j, Vec::new()));
        let unknown: Vec<Vec<Option<Change>>> =
            candidates.iter().map(|c| vec![None; c.parts.len()]).collect();
        Self {
            standings: standings.collect(),
            competition,
            candidates,
            chosen: Vec::new(),
            asked: unknown.clone(),
            predicted: unknown,
        }
    }

    fn run(&mut self) {
        for _ in 0..MOST_STEPS {
            if self.chosen.len() >= MOST_NAMES {
                break;
            }
            let Some(next) = self.next() else { break };
            self.chosen.push(next);
            self.update(next);
            let older = self.chosen[..self.chosen.len() - 1].to_vec();
            for name in older {
                if self.loss(name) < NEEDED {
                    self.chosen.retain(|other| *other != name);
                    self.update(name);
                }
            }
        }
    }

    /// The name that enters next.
    fn next(&mut self) -> Option<usize> {
        let open: Vec<usize> =
            (0..self.candidates.len()).filter(|c| !self.chosen.contains(c)).collect();
        let mut liked: Vec<(f64, usize)> = open
            .into_iter()
            .filter_map(|c| Some((self.evidence(c)?, c)))
            .filter(|(evidence, _)| *evidence > THRESHOLD)
            .collect();
        liked.sort_by(|a, b| b.0.total_cmp(&a.0));
        liked.truncate(ASKED);
        let gains: Vec<(f64, usize, usize)> = liked
            .into_iter()
            .filter_map(|(_, c)| {
                let size = self.candidates[c].parts.iter().map(|part| part.1.len()).max()?;
                Some((self.gain(c)?, size, c))
            })
            .collect();
        let best = gains.iter().fold(0.0, |most: f64, (gain, ..)| most.max(*gain));
        let near = gains.iter().filter(|(gain, ..)| *gain >= NEARLY * best);
        let plainer = |a: &&(f64, usize, usize), b: &&(f64, usize, usize)| {
            a.1.cmp(&b.1).then(b.0.total_cmp(&a.0))
        };
        near.min_by(plainer).map(|(.., c)| *c)
    }

    /// Evidence for a candidate, summed over its joints; `None` where it is physically impossible.
    fn evidence(&mut self, c: usize) -> Option<f64> {
        let candidate = &self.candidates[c];
        let mut evidence = -candidate.price;
        for (part, known) in self.asked[c].iter_mut().enumerate() {
            let standing = &self.standings[candidate.parts[part].0];
            let ask = || self.competition.ask(candidate, part, standing);
            let change = *known.get_or_insert_with(ask);
            evidence += change.possible.then_some(change.evidence)?;
        }
        Some(evidence)
    }

    /// Held-out gain of a candidate, summed over its joints; `None` where it does not gain.
    fn gain(&mut self, c: usize) -> Option<f64> {
        let candidate = &self.candidates[c];
        let mut gain = 0.0;
        for (part, known) in self.predicted[c].iter_mut().enumerate() {
            let standing = &self.standings[candidate.parts[part].0];
            let ask = || self.competition.predict(candidate, part, standing);
            let change = *known.get_or_insert_with(ask);
            gain += (!change.is_worse).then_some(change.gain)?;
        }
        (gain > 0.0).then_some(gain)
    }

    /// The columns of all names except `without`, at joint `j`.
    fn columns(&self, j: usize, without: Option<usize>) -> Vec<usize> {
        let names = self.chosen.iter().filter(|name| Some(**name) != without);
        let parts = names.flat_map(|name| &self.candidates[*name].parts);
        let here = parts.filter(|(at, _)| *at == j);
        here.fold(Vec::new(), |all, part| Competition::union(&all, &self.competition.places(part)))
    }

    /// Fits the joints of a name again and discards the answers there.
    fn update(&mut self, name: usize) {
        for (j, _) in &self.candidates[name].parts {
            self.standings[*j] = self.competition.standing(*j, self.columns(*j, None));
            for (c, candidate) in self.candidates.iter().enumerate() {
                for (part, _) in candidate.parts.iter().enumerate().filter(|(_, p)| p.0 == *j) {
                    self.asked[c][part] = None;
                    self.predicted[c][part] = None;
                }
            }
        }
    }

    /// Evidence that is lost without a name (nats).
    fn loss(&self, name: usize) -> f64 {
        let of = |(j, _): &(usize, Vec<Shape>)| {
            self.competition.loss(*j, &self.standings[*j], &self.columns(*j, Some(name)))
        };
        self.candidates[name].parts.iter().map(of).sum()
    }

    fn strongest_first(&self) -> Vec<usize> {
        let mut names: Vec<(f64, usize)> =
            self.chosen.iter().map(|name| (self.loss(*name), *name)).collect();
        names.sort_by(|a, b| b.0.total_cmp(&a.0));
        names.into_iter().map(|(_, name)| name).collect()
    }
}
