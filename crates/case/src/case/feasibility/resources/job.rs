//! A computation on a case, and the memory and disk that it takes.

use percoat_common::machine::Capacity;

/// A computation on a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Job {
    /// `percoat solve`, with its pictures and fields or without.
    Solve {
        /// Whether pictures are drawn.
        pictures: bool,
        /// Whether fields are kept.
        fields: bool,
    },
    /// Solving into memory: every step keeps its fields and the data for its stresses.
    Keep,
    /// `percoat limit`, with its pictures or without.
    Limit {
        /// Whether pictures are drawn.
        pictures: bool,
    },
    /// `percoat life`, with its pictures or without.
    Life {
        /// Whether pictures are drawn.
        pictures: bool,
    },
    /// `percoat compare`, with its picture or without.
    Compare {
        /// Whether the picture is drawn.
        pictures: bool,
    },
    /// `percoat identify`, with its picture or without.
    Identify {
        /// Whether the picture is drawn.
        pictures: bool,
    },
}

/// Memory and disk that a job takes at most.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Needs {
    /// Peak of memory, bytes.
    pub memory: u64,
    /// Files of the finished result, bytes.
    pub disk: u64,
    /// Files while it runs, bytes at most: the entries of the steps and the archive that is made of them.
    pub disk_while_running: u64,
}

impl Needs {
    /// Whether memory and disk suffice.
    pub fn fit(&self, room: Capacity) -> bool {
        self.memory <= room.memory && self.disk_while_running <= room.disk
    }
}
