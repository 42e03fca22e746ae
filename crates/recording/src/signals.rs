use std::sync::Arc;

use rerun::external::arrow::array::Float64Array;
use rerun::{
    Component as _, ComponentDescriptor, EntityPath, RecordingStream, RecordingStreamResult,
    SerializedComponentBatch, SerializedComponentColumn,
};

use crate::entities::time_column;
use crate::scene::{SceneSignal, SignalQuantity};

/// The signals, and the rows of them that wait to be written.
///
/// Every joint has one entity with one column a quantity; a column holds one number a signal.
/// The times are thus written once a joint, not once a signal.
#[derive(Debug)]
pub(crate) struct Signals {
    joints: Vec<EntityPath>,
    quantities: Vec<SignalQuantity>,
    time_s: Vec<f64>,
    /// Per signal, rows of one number a joint.
    values: Vec<Vec<f64>>,
}

impl Signals {
    /// Signals to be written to these entities, one a joint.
    pub fn new(joints: Vec<EntityPath>, signals: &[SceneSignal<'_>]) -> Self {
        Self {
            joints,
            quantities: signals.iter().map(|s| s.quantity).collect(),
            time_s: vec![],
            values: vec![vec![]; signals.len()],
        }
    }

    /// Takes a block of rows, whose lengths are right.
    pub fn push(&mut self, time_s: &[f64], signals: &[&[f64]]) {
        self.time_s.extend(time_s);
        for (values, block) in self.values.iter_mut().zip(signals) {
            values.extend(*block);
        }
    }

    /// From the first to the last waiting row (s).
    pub fn span_s(&self) -> f64 {
        let ends = self.time_s.first().zip(self.time_s.last());
        ends.map_or(0.0, |(first, last)| last - first)
    }

    /// Writes what waits.
    pub fn flush(&mut self, stream: &RecordingStream) -> RecordingStreamResult<()> {
        for (joint, path) in self.joints.iter().enumerate() {
            let columns = SignalQuantity::ALL.iter().filter_map(|&q| self.column(joint, q));
            let columns = columns.collect::<Result<Vec<_>, _>>()?;
            if !self.time_s.is_empty() && !columns.is_empty() {
                stream.send_columns(path.clone(), [time_column(&self.time_s)], columns)?;
            }
        }
        self.time_s.clear();
        self.values.iter_mut().for_each(Vec::clear);
        Ok(())
    }

    /// One quantity of a joint: per row, one number a signal.
    fn column(
        &self,
        joint: usize,
        quantity: SignalQuantity,
    ) -> Option<rerun::SerializationResult<SerializedComponentColumn>> {
        let own = self.quantities.iter().zip(&self.values).filter(|(q, _)| **q == quantity);
        let own: Vec<&[f64]> = own.map(|(_, values)| values.as_slice()).collect();
        let (rows, joints) = (self.time_s.len(), self.joints.len());
        let value = |row: usize, signal: &&[f64]| quantity.scale() * signal[row * joints + joint];
        let numbers = (0..rows).flat_map(|row| own.iter().map(move |signal| value(row, signal)));
        let array = Float64Array::from_iter_values(numbers);
        let descriptor = ComponentDescriptor::partial(quantity.key())
            .with_component_type(rerun::components::Scalar::name());
        let batch = SerializedComponentBatch::new(Arc::new(array), descriptor);
        (!own.is_empty()).then(|| batch.partitioned(std::iter::repeat_n(own.len(), rows)))
    }
}
