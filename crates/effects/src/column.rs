/// What one unit of a weight adds to the effort of one joint, sample by sample.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Index of the joint.
    pub joint: usize,
    /// Effort (N·m or N) per unit of the weight.
    pub values: Vec<f64>,
}

/// What one unit of a weight adds to the effort of every joint it reaches.
pub type Column = Vec<Part>;

/// A column that reaches one joint.
pub(crate) fn at_joint(joint: usize, values: impl Iterator<Item = f64>) -> Column {
    vec![Part { joint, values: values.collect() }]
}
