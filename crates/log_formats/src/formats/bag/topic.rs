use crate::common::error::FormatError;

/// A topic of a bag.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Topic {
    pub name: String,
    /// Type of the messages.
    pub kind: String,
    /// Encoding of the messages.
    pub encoding: String,
}

/// Receives the topics and messages of a bag.
pub(crate) trait MessageSink {
    /// Receives a topic, before its messages.
    fn add_topic(&mut self, topic: &Topic);

    /// Whether the messages of a topic are wanted. Other messages may be skipped.
    fn wants(&self, topic: &Topic) -> bool;

    /// Receives a message.
    fn add_message(&mut self, topic: &Topic, message: &[u8]) -> Result<(), FormatError>;
}
