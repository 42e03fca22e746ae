use robot::Robot;

use crate::columns::design::Design;
use crate::regression::blocks::Block;

/// A held-out part of the logs, and the robot with the findings of the rest.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldOutPart {
    /// The held-out stretches.
    pub test: Vec<Span>,
    /// The stretches in which causes and sizes were found: the rest, without the neighbours of the test.
    pub train: Vec<Span>,
    /// The robot with the findings of `train`.
    pub extended: Robot,
}

/// A stretch of a prepared run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Index of the run.
    pub run: usize,
    /// Times of the first sample and of the end (s).
    pub time_s: [f64; 2],
}

/// The stretches that some blocks cover, given in increasing order; neighbours form one stretch.
pub(crate) fn spans(design: &Design, blocks: &[Block], of: &[usize]) -> Vec<Span> {
    let mut spans: Vec<Span> = Vec::new();
    let mut last: Option<&Block> = None;
    for block in of.iter().map(|&b| &blocks[b]) {
        let time = &design.runs[block.run].time;
        let end_s = time[block.samples.end - 1] + 1.0 / design.rate_hz;
        let goes_on =
            last.is_some_and(|l| l.run == block.run && l.samples.end == block.samples.start);
        match spans.last_mut() {
            Some(span) if goes_on => span.time_s[1] = end_s,
            _ => spans.push(Span { run: block.run, time_s: [time[block.samples.start], end_s] }),
        }
        last = Some(block);
    }
    spans
}
