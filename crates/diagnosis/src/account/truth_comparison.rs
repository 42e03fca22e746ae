use robot::Robot;

use crate::account::place_account::{LookedFor, PlaceAccount, SearchFate, Taker};
use crate::account::place_test::PlaceTest;
use crate::error::DiagnosisError;
use crate::how_found::how_found;
use crate::outcome::effect_at::effect_at;
use crate::regression::problem::{HypothesisSet, Problem};
use crate::result::EffectAt;
use crate::search::accept::Accepted;
use crate::search::constancy::Variation;
use crate::search::inputs::Inputs;
use crate::search::refusal::Refusal;
use crate::search::select::Selection;
use crate::signals::along::REGRESSION_RATE;

/// The result of a search, and what became of the places of which it was asked.
pub(crate) struct TruthComparison {
    /// What the search found.
    pub found: Vec<EffectAt>,
    /// What was kept of it.
    pub kept: Vec<EffectAt>,
    pub places: Vec<PlaceAccount>,
    /// The robot with what was kept.
    pub extended: Robot,
}

/// A search over all blocks beside the truth.
struct TruthSearch<'a> {
    inputs: &'a Inputs<'a>,
    /// Weighted by the noise that the found names leave.
    found: Selection<'a>,
    model: &'a HypothesisSet,
    accepted: &'a Accepted,
    /// Every true name that the design has.
    all_true: HypothesisSet,
    /// Those that one model can have.
    truth: HypothesisSet,
    /// Weighted by the noise that the true names or the found ones leave, whichever is less at a joint.
    of_truth: Selection<'a>,
    /// Weighted by the noise that is known from its sources.
    of_known: Option<Selection<'a>>,
}

impl Inputs<'_> {
    /// Searches as a diagnosis does, and says of every place in `places` what became of it. `truth` are all true
    /// names, `noise` the known RMS of the noise in the band at each joint (N·m or N), zero where it is unknown.
    pub fn compare_with_truth(
        &self,
        truth: &[EffectAt],
        places: &[EffectAt],
        noise: &[f64],
    ) -> Result<TruthComparison, DiagnosisError> {
        self.with_dataset(|dataset| {
            let all: Vec<usize> = (0..dataset.blocks.len()).collect();
            let found = self.search(dataset, &all)?;
            let accepted = self.accept_best_twins(dataset, &found)?;
            let searched = dataset.selection(&found.problem);
            let names = self.true_names(&searched, truth);
            let of_truth = self.weighted_by(&found.problem, &names);
            let of_known = self.weighted_by_known(&of_truth, noise);
            let comparison = TruthSearch {
                inputs: self,
                found: searched,
                model: &found.model,
                accepted: &accepted,
                all_true: truth.iter().filter_map(|at| self.find(at)).collect(),
                truth: names,
                of_truth: dataset.selection(&of_truth),
                of_known: of_known.as_ref().map(|problem| dataset.selection(problem)),
            };
            Ok(TruthComparison {
                found: self.names(&found.model),
                kept: self.names(&accepted.model),
                places: places.iter().map(|at| comparison.place(at)).collect(),
                extended: self.without_trial_shapes(accepted.fitted.robot.clone()),
            })
        })?
    }

    /// The hypothesis of an effect at a place, if the design has it.
    fn find(&self, at: &EffectAt) -> Option<usize> {
        self.design.groups.iter().position(|g| effect_at(self.robot, g.hypothesis) == *at)
    }

    fn names(&self, model: &HypothesisSet) -> Vec<EffectAt> {
        let name = |g: &usize| effect_at(self.robot, self.design.groups[*g].hypothesis);
        model.iter().map(name).collect()
    }

    /// The true names that the design has, as one model can have them.
    fn true_names(&self, selection: &Selection, truth: &[EffectAt]) -> HypothesisSet {
        let groups = truth.iter().filter_map(|at| self.find(at));
        groups.fold(HypothesisSet::new(), |model, g| {
            if selection.is_excluded(&model, g) { model } else { selection.with(&model, g) }
        })
    }

    /// A problem weighted by the noise that a model leaves, or by its own weights where they are larger. The noise is
    /// measured twice, as its fit hangs on the weights.
    fn weighted_by<'b>(&self, problem: &Problem<'b>, model: &HypothesisSet) -> Problem<'b> {
        let weights = |p: &Problem| p.noise(model).weights(&self.design.moved);
        let own = weights(&problem.with_weights(weights(problem)));
        let larger = own.iter().zip(&problem.weight).map(|(a, b)| a.max(*b));
        problem.with_weights(larger.collect())
    }

    /// A problem weighted by known noise, which is white in the band: `n` samples count as `2 n / 2.5`, as there are
    /// [`REGRESSION_RATE`] samples in a period of the cut-off. A joint whose noise is unknown keeps its weight. `None`
    /// where no noise is known.
    fn weighted_by_known<'b>(&self, problem: &Problem<'b>, noise: &[f64]) -> Option<Problem<'b>> {
        let weight = |(known, weight): (&f64, &f64)| {
            let is_known = *weight > 0.0 && *known > 0.0;
            if is_known { 2.0 / (REGRESSION_RATE * known * known) } else { *weight }
        };
        let by_stratum = noise.iter().flat_map(|known| [known; 2]);
        let weights: Vec<f64> = by_stratum.zip(&problem.weight).map(weight).collect();
        let is_known = noise.iter().any(|known| *known > 0.0);
        is_known.then(|| problem.with_weights(weights))
    }
}

impl TruthSearch<'_> {
    fn place(&self, at: &EffectAt) -> PlaceAccount {
        let Some(g) = self.inputs.find(at) else { return self.without_hypothesis(at) };
        let of = |selection: &Selection, model: &HypothesisSet| {
            let mut others = model.clone();
            others.remove(&g);
            PlaceTest::new(selection, &others, g)
        };
        PlaceAccount {
            at: at.clone(),
            looked_for: LookedFor::ByColumns,
            fate: self.fate(g),
            beside_truth: of(&self.of_truth, &self.truth),
            with_known_noise: self.of_known.as_ref().and_then(|known| of(known, &self.truth)),
            beside_found: of(&self.found, self.model),
            takers: self.takers(g),
        }
    }

    fn without_hypothesis(&self, at: &EffectAt) -> PlaceAccount {
        let inputs = self.inputs;
        let joint = |name: &String| inputs.robot.links().iter().position(|l| l.joint.name == *name);
        let spoilt = at.joint.as_ref().and_then(joint).and_then(|j| inputs.inadequate[j].clone());
        let looked_for = match effects::model(at.effect) {
            Err(_) if spoilt.is_none() && how_found(at.effect).is_ok() => LookedFor::AsLine,
            Err(reason) => LookedFor::Nowhere(spoilt.unwrap_or_else(|| reason.to_owned())),
            Ok(_) => LookedFor::Nowhere(
                spoilt.unwrap_or_else(|| "it has no column in these logs".to_owned()),
            ),
        };
        let mut lines = inputs.log.tones.iter().map(|tone| tone.hypothesis());
        let is_line = lines.any(|line| effect_at(inputs.robot, line) == *at);
        PlaceAccount {
            at: at.clone(),
            looked_for,
            fate: if is_line { SearchFate::Kept } else { SearchFate::NotFound },
            beside_truth: None,
            with_known_noise: None,
            beside_found: None,
            takers: Vec::new(),
        }
    }

    fn fate(&self, g: usize) -> SearchFate {
        if self.accepted.model.contains(&g) {
            SearchFate::Kept
        } else if let Some(Refusal::Varies(Variation { with, .. })) =
            self.accepted.ledger.refusal(g)
        {
            SearchFate::SizeVaries(with.unwrap_or("joint").to_owned())
        } else if self.model.contains(&g) {
            SearchFate::Dropped
        } else {
            SearchFate::NotFound
        }
    }

    /// Found names that keep `g` out: they exclude it, or they are not true and `g` has enough evidence without them.
    fn takers(&self, g: usize) -> Vec<Taker> {
        let selection = &self.found;
        let groups = &self.inputs.design.groups;
        if self.model.contains(&g) {
            return Vec::new();
        }
        let taker = |&other: &usize| {
            let mut less = self.model.clone();
            less.remove(&other);
            let excludes = groups[other].hypothesis.excludes(groups[g].hypothesis);
            let is_entrant = !self.all_true.contains(&other)
                && !selection.is_excluded(&less, g)
                && PlaceTest::new(selection, &less, g).is_some_and(|test| test.is_evident());
            (excludes || is_entrant).then(|| Taker {
                at: effect_at(self.inputs.robot, groups[other].hypothesis),
                excludes,
                is_exchanged: selection.neighbours(other).contains(&g),
            })
        };
        self.model.iter().filter_map(taker).collect()
    }
}
