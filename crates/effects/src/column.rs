/// Change of the effort of one joint per unit of a weight, sample by sample.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Index of the joint.
    pub joint: usize,
    /// Effort (N·m or N) per unit of the weight.
    pub values: Vec<f64>,
}

/// Change of the effort of every joint that a weight reaches, per unit of the weight.
pub type Column = Vec<Part>;

/// A column that reaches one joint.
pub(crate) fn at_joint(joint: usize, values: impl Iterator<Item = f64>) -> Column {
    vec![Part { joint, values: values.collect() }]
}
