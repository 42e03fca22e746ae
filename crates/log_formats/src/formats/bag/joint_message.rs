/// What a message says of some joints at one time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct JointMessage {
    /// Time of the message (ns).
    pub stamp_ns: i64,
    /// Names of the joints.
    pub joints: Vec<String>,
    /// The channels that the message has, with one value per joint.
    pub channels: Vec<(&'static str, Vec<f64>)>,
}

impl JointMessage {
    /// A message, whose channels without values are left out.
    ///
    /// # Errors
    ///
    /// The channel that has another number of values than there are joints.
    pub(crate) fn new(
        stamp_ns: i64,
        joints: Vec<String>,
        channels: impl IntoIterator<Item = (&'static str, Vec<f64>)>,
    ) -> Result<Self, String> {
        let filled = channels.into_iter().filter(|(_, values)| !values.is_empty());
        let channels: Vec<_> = filled.collect();
        match channels.iter().find(|(_, values)| values.len() != joints.len()) {
            Some((what, values)) => {
                let (names, found) = (joints.len(), values.len());
                Err(format!("it has {names} names and {found} values of {what}"))
            }
            None => Ok(Self { stamp_ns, joints, channels }),
        }
    }
}
