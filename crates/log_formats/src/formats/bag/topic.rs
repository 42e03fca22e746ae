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

/// Receives the topics and messages of a bag.
pub(crate) trait MessageSink {
    /// Takes a topic, before its messages.
    fn add_topic(&mut self, topic: &Topic);

    /// Whether the messages of a topic are wanted; others need not be read.
    fn wants(&self, topic: &Topic) -> bool;

    /// Takes a message.
    fn add_message(&mut self, topic: &Topic, message: &[u8]) -> Result<(), FormatError>;
}
