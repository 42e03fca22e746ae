use logs::LogError;
use rayon::prelude::*;

use crate::regression::fitted_model::fit_model;
use crate::regression::problem::HypothesisSet;
use crate::search::causes::Causes;
use crate::search::change::Change;
use crate::search::inputs::Inputs;
use crate::search::ledger::Ledger;
use crate::search::model_state::{ModelState, SizeQuestion};
use crate::search::refusal::Refusal;
use crate::search::select::Selection;

impl Inputs<'_> {
    /// The ledger of an answer: every hypothesis outside it, with what refuses its entry.
    ///
    /// Entries are asked about the model of the answer with what has torque but no name: effects that left because their
    /// sizes would have to vary, and those of joints that keep their description.
    pub fn ledger_of(&self, selection: &Selection, causes: &Causes) -> Result<Ledger, LogError> {
        let Causes { problem, model, kept_nominal, .. } = causes;
        let mut ledger = causes.ledger.clone();
        ledger.keep_twins_of(model);
        let here: HypothesisSet = model.iter().copied().chain(ledger.varying()).collect();
        let everywhere = here.union(&kept_nominal.dropped).copied().collect();
        let state =
            |model| ModelState::new(problem, model).map(|state| state.keeping(kept_nominal));
        let (Some(here), Some(everywhere)) = (state(here), state(everywhere)) else {
            return Ok(ledger);
        };
        let outside: Vec<usize> = (0..problem.design.groups.len())
            .filter(|g| !model.contains(g) && ledger.refusal(*g).is_none())
            .collect();
        let refusal = |&g: &usize| {
            let keeps = kept_nominal.refusal(problem.design, g).is_some();
            let state = if keeps { &here } else { &everywhere };
            Ok((g, self.refusal_of_entry(selection, state, g)?))
        };
        let refusals = outside.par_iter().map(refusal).collect::<Result<Vec<_>, LogError>>()?;
        for (g, refusal) in refusals {
            if let Some(refusal) = refusal {
                ledger.refuse(g, refusal);
            }
        }
        Ok(ledger)
    }

    /// What refuses the entry of `g`: a rule about the first fit, or one about the robot with `g`. `None` where it is
    /// admitted.
    fn refusal_of_entry<'a>(
        &self,
        selection: &Selection<'a>,
        state: &ModelState<'a>,
        g: usize,
    ) -> Result<Option<Refusal>, LogError> {
        let model = match selection.admit(state, &Change::enter(&[g])) {
            Err(refusal) => return Ok(Some(refusal)),
            Ok(admitted) => admitted.state.model,
        };
        let fitted = fit_model(self.robot, &self.log, selection.problem, &model)?;
        let larger = self.state(selection, &model, &fitted, SizeQuestion::Both);
        let leaving = |change: Change| selection.admit(larger.as_ref()?, &change).ok()?.because;
        Ok(leaving(selection.simplification(g)).or_else(|| leaving(Change::leave(g))))
    }
}
