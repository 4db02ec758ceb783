//! Length and checksum of files: FNV-1a over words of eight bytes, the upper half of each product folded down. It detects
//! changes by accident, at the speed of the disk.

use std::io::{self, Read, Write};

/// Length and checksum of bytes that are added piece by piece.
#[derive(Debug, Clone)]
pub(super) struct Checksum {
    length: u64,
    hash: u64,
    /// The bytes behind the last whole word.
    rest: [u8; WORD],
}

const WORD: usize = 8;

impl Default for Checksum {
    fn default() -> Self {
        Self { length: 0, hash: 0xcbf2_9ce4_8422_2325, rest: [0; WORD] }
    }
}

impl Checksum {
    /// Adds the next bytes.
    pub(super) fn add(&mut self, mut bytes: &[u8]) {
        let filled = (self.length % WORD as u64) as usize;
        self.length += bytes.len() as u64;
        if filled > 0 {
            let (first, others) = bytes.split_at(bytes.len().min(WORD - filled));
            self.rest[filled..filled + first.len()].copy_from_slice(first);
            if filled + first.len() < WORD {
                return;
            }
            (self.hash, bytes) = (hashed(self.hash, self.rest), others);
        }
        let (words, rest) = bytes.as_chunks::<WORD>();
        self.hash = words.iter().fold(self.hash, |hash, word| hashed(hash, *word));
        self.rest[..rest.len()].copy_from_slice(rest);
    }

    /// A writer that passes bytes on to `writer` and adds them to the checksum.
    pub(super) fn through<W: Write>(&mut self, writer: W) -> Added<'_, W> {
        Added { sum: self, writer }
    }

    /// Length and checksum of all bytes; the last word is padded with zeros.
    pub(super) fn finish(mut self) -> (u64, u64) {
        let filled = (self.length % WORD as u64) as usize;
        if filled > 0 {
            self.rest[filled..].fill(0);
            self.hash = hashed(self.hash, self.rest);
        }
        (self.length, self.hash)
    }
}

fn hashed(hash: u64, word: [u8; WORD]) -> u64 {
    let hash = (hash ^ u64::from_le_bytes(word)).wrapping_mul(0x100_0000_01b3);
    hash ^ hash >> 32
}

/// A writer whose bytes are added to a checksum.
#[derive(Debug)]
pub(super) struct Added<'a, W> {
    sum: &'a mut Checksum,
    writer: W,
}

impl<W: Write> Write for Added<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.writer.write(bytes)?;
        self.sum.add(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

/// Length in bytes and checksum of all that a reader returns.
///
/// # Errors
/// When the file cannot be read.
pub fn checksum(file: &mut impl Read) -> io::Result<(u64, u64)> {
    let mut sum = Checksum::default();
    let mut buffer = [0; 1 << 16];
    loop {
        match file.read(&mut buffer)? {
            0 => return Ok(sum.finish()),
            count => sum.add(&buffer[..count]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bit_of_a_file_and_its_length_count() {
        let content: Vec<u8> = (0..100_000u32).flat_map(|n| n.wrapping_mul(2_654_435_761).to_le_bytes()).collect();
        let of = |content: &[u8]| checksum(&mut &content[..]).unwrap();
        let whole = of(&content);
        assert_eq!(whole.0, content.len() as u64);
        for bit in [0, 63, 64 * 7 + 63, 8 * content.len() - 1] {
            let mut other = content.clone();
            other[bit / 8] ^= 1 << (bit % 8);
            assert_ne!(of(&other), whole, "bit {bit}");
            // The sign of a second number does not undo the first.
            other[(bit / 8) ^ 8] ^= 1 << (bit % 8);
            assert_ne!(of(&other), whole, "bits {bit}");
        }
        assert_ne!(of(b"a"), of(b"a\0"));
    }

    #[test]
    fn what_is_added_while_it_is_written_in_any_pieces_has_the_checksum_of_the_file() {
        let content: Vec<u8> = (0..1003u32).map(|n| (n * n % 251) as u8).collect();
        for step in [1, 2, 3, 5, 7, 8, 9, 64, 1000, 2000] {
            let (mut sum, mut written) = (Checksum::default(), Vec::new());
            content.chunks(step).for_each(|piece| sum.through(&mut written).write_all(piece).unwrap());
            assert_eq!(written, content);
            assert_eq!(sum.finish(), checksum(&mut &content[..]).unwrap(), "pieces of {step}");
        }
        assert_eq!(Checksum::default().finish(), checksum(&mut &b""[..]).unwrap());
    }
}
