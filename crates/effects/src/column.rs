/// Change of the effort of one joint per unit of a weight, sample by sample.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnPart {
    /// Index of the joint.
    pub joint: usize,
    /// Effort (N·m or N) per unit of the weight.
    pub values: Vec<f64>,
}

/// Change of the effort of every joint that a weight reaches, per unit of the weight.
pub type EffectColumn = Vec<ColumnPart>;

/// A column that reaches one joint.
pub(crate) fn at_joint(joint: usize, values: impl Iterator<Item = f64>) -> EffectColumn {
    vec![ColumnPart { joint, values: values.collect() }]
}
