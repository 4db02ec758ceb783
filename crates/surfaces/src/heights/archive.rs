//! The zip of an X3P file: its members, each at most once, with their checksums.

use super::binary::{broken, twice};
use super::fault::{Fault, fits};
use miniz_oxide::inflate::decompress_to_vec_with_limit;
use std::io::{Cursor, Read};
use zip::{CompressionMethod, ZipArchive};

/// Name of the member that describes the others.
pub const MAIN: &str = "main.xml";
/// Largest factor by which deflate compresses.
const RATIO: u64 = 1040;
/// Most bytes of a member that holds a checksum.
const LONGEST: u64 = 1 << 16;

/// The members of a zip.
pub struct Archive<'a> {
    zip: ZipArchive<Cursor<&'a [u8]>>,
    /// Folder of `main.xml`, with its slash: empty but in zips of a folder.
    folder: String,
}

impl<'a> Archive<'a> {
    /// Opens a zip; refused where a member is in it twice, and without one `main.xml`.
    pub fn open(content: &'a [u8]) -> Result<Self, Fault> {
        let zip = ZipArchive::new(Cursor::new(content)).map_err(|_| broken("it is no whole zip"))?;
        if zip.has_duplicate_names() {
            return Err(twice("a member of its zip"));
        }
        let names = zip.file_names().filter_map(Result::ok);
        // Computers of Apple add folders `__MACOSX` and files `._main.xml`.
        let folders: Vec<String> = names
            .filter_map(|name| name.replace('\\', "/").strip_suffix(MAIN).map(str::to_owned))
            .filter(|folder| folder.is_empty() || folder.ends_with('/') && !folder.contains("__MACOSX/"))
            .collect();
        match &folders[..] {
            [folder] => Ok(Self { zip, folder: folder.clone() }),
            [] => Err(Fault::new("is a zip without a main.xml, and no X3P file", "this file")
                .help("unpack what is in it before")),
            [_, ..] => Err(Fault::new(
                format!("is a zip with {} files main.xml, and does not say which is meant", folders.len()),
                "which main.xml?",
            )
            .help("give each surface a file .x3p of its own")),
        }
    }

    fn index(&self, name: &str) -> Option<usize> {
        let name = format!("{}{}", self.folder, name.trim_start_matches("./").trim_start_matches('/'));
        self.zip.index_for_name(&name).or_else(|| self.zip.index_for_name(&name.replace('/', "\\")))
    }

    /// The content of a member of at most `most` bytes.
    pub fn member(&mut self, name: &str, most: u64) -> Result<Vec<u8>, Fault> {
        let index = self.index(name).ok_or_else(|| broken("a file that its main.xml names is missing"))?;
        let mut entry = self.zip.by_index_raw(index).map_err(|_| broken("a file of its zip cannot be found"))?;
        let (size, packed, method) = (entry.size(), entry.compressed_size(), entry.compression());
        let checksum = entry.crc32();
        // The sizes may both be false: what is unpacked is limited, and what is packed by the length of the zip.
        if size > most || size > packed.saturating_mul(RATIO) {
            return Err(broken(format_args!(
                "a file of its zip says that it has {size} bytes, at most {most} belong there"
            )));
        }
        if method == CompressionMethod::STORE && packed != size {
            return Err(broken("a file of its zip is stored with another size than it states"));
        }
        fits(size.saturating_add(packed))?;
        let mut bytes = Vec::new();
        entry.by_ref().take(packed).read_to_end(&mut bytes).map_err(|_| broken("a file of its zip is cut off"))?;
        let content = match method {
            CompressionMethod::STORE => bytes,
            CompressionMethod::DEFLATE => decompress_to_vec_with_limit(&bytes, size as usize)
                .map_err(|_| broken("a file of its zip does not unpack to the size that it states"))?,
            _ => {
                let fault = Fault::new("is packed by another method than X3P files are", "this file");
                return Err(fault.help("export it again").or_elsewhere());
            }
        };
        match crc32fast::hash(&content) == checksum {
            true => Ok(content),
            false => Err(broken("a file of its zip has another checksum than the zip states")),
        }
    }

    /// The content of a member of `length` bytes, of which `main.xml` states the checksum `stated`, if any.
    pub fn exactly(&mut self, name: &str, length: usize, stated: Option<&str>) -> Result<Vec<u8>, Fault> {
        let content = self.member(name, length as u64)?;
        if content.len() != length {
            let what = format!("a file of its zip has {} bytes, by its main.xml it has {length}", content.len());
            return Err(broken(what));
        }
        verified(&content, stated).map(|()| content)
    }

    /// Compares `main.xml` with its checksum in the member `name`, where the zip has it: lines `checksum *name`, of `main.xml` without a name.
    pub fn verify(&mut self, main: &[u8], name: &str) -> Result<(), Fault> {
        if self.index(name).is_none() {
            return Ok(());
        }
        let stated = self.member(name, LONGEST)?;
        let stated = String::from_utf8_lossy(&stated);
        let is_of_main = |line: &&str| line.split_whitespace().nth(1).is_none_or(|name| name.ends_with(MAIN));
        verified(main, stated.lines().find(is_of_main))
    }
}

/// Refuses a content that has not the stated MD5 checksum, the first word of a text. A text that begins with none states none.
fn verified(content: &[u8], stated: Option<&str>) -> Result<(), Fault> {
    let word = stated.and_then(|text| text.trim_start_matches('\u{feff}').split_whitespace().next());
    let stated = word.filter(|word| word.len() == 32 && word.bytes().all(|byte| byte.is_ascii_hexdigit()));
    if stated.is_none_or(|stated| stated.eq_ignore_ascii_case(&format!("{:x}", md5::compute(content)))) {
        return Ok(());
    }
    let what = "has a part with another checksum (MD5) than it states: it was changed after it was written, or written wrongly";
    Err(Fault::new(what, "another checksum").help("export it again from the program that wrote it").or_elsewhere())
}
