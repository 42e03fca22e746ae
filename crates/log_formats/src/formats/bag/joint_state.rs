use crate::formats::bag::cdr::Cdr;

/// A message `sensor_msgs/msg/JointState`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct JointState {
    /// Time of the stamp in its header (ns).
    pub stamp_ns: i64,
    pub names: Vec<String>,
    /// One value per name, or no values.
    pub position: Vec<f64>,
    pub velocity: Vec<f64>,
    pub effort: Vec<f64>,
}

/// Name of the message type.
pub(crate) const TYPE: &str = "sensor_msgs/msg/JointState";

impl JointState {
    /// Decodes a message in CDR, or gives the reason why it cannot be read.
    pub(crate) fn decode(message: &[u8]) -> Result<Self, String> {
        let mut cdr = Cdr::new(message).ok_or("it is not encoded as plain CDR")?;
        let state = Self::values(&mut cdr).ok_or("it is cut off, or of another type")?;
        for (what, values) in state.channels() {
            if !values.is_empty() && values.len() != state.names.len() {
                let (names, found) = (state.names.len(), values.len());
                return Err(format!("it has {names} names and {found} values of {what}"));
            }
        }
        Ok(state)
    }

    fn values(cdr: &mut Cdr) -> Option<Self> {
        let (seconds, nanoseconds) = (cdr.i32()?, cdr.u32()?);
        cdr.text()?;
        Some(Self {
            stamp_ns: i64::from(seconds) * 1_000_000_000 + i64::from(nanoseconds),
            names: cdr.sequence(|cdr| cdr.text().map(str::to_owned))?,
            position: cdr.sequence(Cdr::f64)?,
            velocity: cdr.sequence(Cdr::f64)?,
            effort: cdr.sequence(Cdr::f64)?,
        })
    }

    /// The values of each channel.
    pub(crate) fn channels(&self) -> [(&'static str, &[f64]); 3] {
        [("position", &self.position), ("velocity", &self.velocity), ("effort", &self.effort)]
    }
}
