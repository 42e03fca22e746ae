use crate::common::error::FormatError;

/// Where a message was published.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Topic {
    pub name: String,
    /// Type of its messages.
    pub kind: String,
    /// How they are encoded.
    pub encoding: String,
}

/// What the messages of a bag are given to.
pub(crate) trait Listener {
    /// Hears of a topic, before its messages.
    fn topic(&mut self, topic: &Topic);

    /// Whether its messages are heard; others need not be read.
    fn wants(&self, topic: &Topic) -> bool;

    /// Hears a message.
    fn message(&mut self, topic: &Topic, message: &[u8]) -> Result<(), FormatError>;
}
