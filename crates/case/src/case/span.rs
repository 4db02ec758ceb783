//! Places in the text of a case file or a `--set`.

/// A span of bytes in one of the sources (0: the case file, n: the n-th value that is set, then the `--set`s).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Span {
    pub(super) source: usize,
    pub(super) start: usize,
    pub(super) end: usize,
}

impl Span {
    /// The span of a value without a text.
    pub(super) const NOWHERE: Self = Self { source: 0, start: 0, end: 0 };

    /// The span `start..end` of a source.
    pub(super) fn new(source: usize, span: std::ops::Range<usize>) -> Self {
        Self { source, start: span.start, end: span.end }
    }
}
