use nalgebra::DMatrix;

use crate::columns::common::{Common, CommonPart};
use crate::columns::design::Design;
use crate::columns::run_design::{JointDesign, RunDesign};

impl Design {
    /// Adds the columns that are common to the logs of the design and to others, of every hypothesis. The other logs say
    /// nothing of hypotheses that they do not have.
    pub fn add_common(&mut self, mut common: Common) {
        for group in &self.groups {
            let is_known = common.groups.iter().any(|(h, _)| *h == group.hypothesis);
            if !is_known {
                let prior: Vec<f64> = group.columns.iter().map(|&k| self.prior[k]).collect();
                common.add_unknown(group.hypothesis, &prior);
            }
        }
        let mut own: Vec<Option<usize>> = vec![None; common.prior.len()];
        for (hypothesis, weights) in &common.groups {
            let Some(g) = self.find(*hypothesis) else { continue };
            let columns = self.groups[g].columns.iter().copied();
            weights.iter().zip(columns).for_each(|(&weight, column)| own[weight] = Some(column));
        }
        let place = |j: usize| {
            let of = |(weight, own): (usize, &Option<usize>)| {
                Some((weight, self.local[j].iter().position(|c| Some(*c) == *own)?))
            };
            own.iter().enumerate().filter_map(of).collect()
        };
        let places: Vec<Vec<(usize, usize)>> = (0..self.joints()).map(place).collect();
        let columns = self.columns_at(&places);
        self.append(common, &places, columns);
    }

    /// The columns of a design of the same runs that are common to others, in this design about another robot.
    pub fn copy_common(&mut self, from: &Self) {
        let Some(part) = &from.common else { return };
        let place = |local: &Vec<usize>| {
            let all = local.iter().enumerate().map(|(place, column)| (*column, place));
            let common = all.filter(|(column, _)| part.columns.contains(column));
            common.map(|(column, place)| (column - part.columns.start, place)).collect()
        };
        let places: Vec<Vec<(usize, usize)>> = from.local.iter().map(place).collect();
        self.append(part.of_others.clone(), &places, from.columns_at(&places));
    }

    /// Weights of all columns without those of the common part.
    pub fn own_weights(&self, weights: &[f64]) -> Vec<f64> {
        let mut own = weights.to_vec();
        let common = self.common.as_ref().map_or(0..0, |part| part.columns.clone());
        own.iter_mut().enumerate().filter(|(k, _)| common.contains(k)).for_each(|(_, w)| *w = 0.0);
        own
    }

    /// The columns at some places of every joint, `[run][joint]`; see [`Design::append`].
    fn columns_at(&self, places: &[Vec<(usize, usize)>]) -> Vec<Vec<DMatrix<f64>>> {
        let of_joint = |(joint, places): (&JointDesign, &Vec<(usize, usize)>)| {
            joint.x.select_columns(places.iter().map(|(_, place)| place))
        };
        let of_run =
            |run: &RunDesign| run.joints.iter().zip(places).map(of_joint).collect::<Vec<_>>();
        self.runs.iter().map(of_run).collect()
    }

    /// Appends the common part: for every joint the weights that reach it, with their places elsewhere, and their
    /// `columns`, `[run][joint]`.
    fn append(
        &mut self,
        of_others: Common,
        places: &[Vec<(usize, usize)>],
        columns: Vec<Vec<DMatrix<f64>>>,
    ) {
        let first = self.width;
        for (local, places) in self.local.iter_mut().zip(places) {
            local.extend(places.iter().map(|(weight, _)| first + weight));
        }
        for (run, columns) in self.runs.iter_mut().zip(columns) {
            for (joint, columns) in run.joints.iter_mut().zip(columns) {
                let known = joint.x.ncols();
                let x = std::mem::replace(&mut joint.x, DMatrix::zeros(0, 0));
                joint.x = x.resize_horizontally(known + columns.ncols(), 0.0);
                joint.x.columns_mut(known, columns.ncols()).copy_from(&columns);
            }
        }
        self.width += of_others.prior.len();
        self.prior.extend(&of_others.prior);
        self.bounds.resize(self.width, (f64::NEG_INFINITY, f64::INFINITY));
        self.common = Some(CommonPart { columns: first..self.width, of_others });
    }
}
