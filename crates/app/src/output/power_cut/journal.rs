//! A journal of the changes in a folder, from which tests compute the states that a power cut may leave.
//!
//! Content that is not synced is lost: the file is empty, or of its length and full of zeros. Each change of a name is atomic;
//! changes whose folder is not synced are present or absent independently, those of one name in order. [`Journal::images`]
//! returns all states that are possible, after every change.

use super::image::{self, Image};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{Read, Seek};
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

/// A change of the disk.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Change<'a> {
    Created(&'a Path),
    CreatedFolder(&'a Path),
    /// Old path, new path.
    Moved(&'a Path, &'a Path),
    /// The file, and its second name.
    Linked(&'a Path, &'a Path),
    Removed(&'a Path),
    Synced(&'a File),
    SyncedFolder(&'a Path),
}

/// A name in a folder, by the folder's number.
type Name = (usize, String);

/// The journal of one folder.
#[derive(Debug)]
pub(crate) struct Journal {
    root: PathBuf,
    things: Vec<Thing>,
    /// Names as the running system has them.
    seen: BTreeMap<Name, usize>,
    /// Names that are on the disk.
    durable: BTreeMap<Name, usize>,
    /// Changes of names that are not, each with all names it changes.
    pending: Vec<Vec<(Name, Option<usize>)>>,
    pub(crate) images: Vec<Image>,
    known: BTreeSet<Image>,
    /// Number of the changes noted so far.
    noted: u64,
    /// Whether syncing does nothing.
    pub(crate) ignores_syncs: bool,
    /// The state that a kill would leave after each change; `None` where it is not recorded.
    pub(crate) kills: Option<Vec<Image>>,
    /// Whether files can have two names.
    pub(crate) has_links: bool,
}

#[derive(Debug)]
enum Thing {
    Folder,
    /// Number on the disk; the file opened a second time, so that its number is not given to another; synced content, if any, and
    /// content added since.
    File {
        inode: u64,
        opened: File,
        durable: Option<Vec<u8>>,
        added: Vec<u8>,
    },
}

/// State of content that is not synced.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Lost {
    Nothing,
    Zeros,
    Part,
}

static JOURNALS: Mutex<Vec<Arc<Mutex<Journal>>>> = Mutex::new(Vec::new());

/// Adds a change to the journal of the folder in which it is, if there is one.
pub(super) fn note(change: Change<'_>) {
    use Change::{Created, CreatedFolder, Linked, Moved, Removed, Synced, SyncedFolder};
    let journals = JOURNALS.lock().unwrap().clone();
    for journal in journals {
        let mut journal = journal.lock().unwrap();
        let is_within = match change {
            Synced(file) => journal.file(file).is_some(),
            Created(path)
            | CreatedFolder(path)
            | Moved(path, _)
            | Linked(path, _)
            | Removed(path)
            | SyncedFolder(path) => path.starts_with(&journal.root),
        };
        if is_within {
            journal.note(change);
        }
    }
}

/// Whether the journal of a path simulates a file system without hard links.
pub(super) fn refuses_links(path: &Path) -> bool {
    let journals = JOURNALS.lock().unwrap().clone();
    journals
        .iter()
        .map(|journal| journal.lock().unwrap())
        .any(|journal| path.starts_with(&journal.root) && !journal.has_links)
}

impl Journal {
    /// Begins the journal of an empty folder that is on the disk; it ends when the returned handle is dropped.
    pub(crate) fn begin(root: &Path) -> Arc<Mutex<Self>> {
        let journal = Arc::new(Mutex::new(Self {
            root: root.to_owned(),
            things: vec![Thing::Folder],
            seen: BTreeMap::new(),
            durable: BTreeMap::new(),
            pending: Vec::new(),
            images: Vec::new(),
            known: BTreeSet::new(),
            noted: 0,
            ignores_syncs: false,
            kills: None,
            has_links: true,
        }));
        JOURNALS.lock().unwrap().push(Arc::clone(&journal));
        journal
    }

    /// Ends a journal: further changes are not noted.
    pub(crate) fn end(journal: &Arc<Mutex<Self>>) {
        JOURNALS.lock().unwrap().retain(|other| !Arc::ptr_eq(other, journal));
    }

    /// Makes the present state durable and drops the states before it.
    pub(crate) fn settle(&mut self) {
        self.durable = self.seen.clone();
        self.pending.clear();
        self.images.clear();
        self.known.clear();
    }

    fn note(&mut self, change: Change<'_>) {
        self.noted += 1;
        match change {
            Change::Synced(_) | Change::SyncedFolder(_) if self.ignores_syncs => {}
            Change::Created(path) => {
                let opened = File::open(path).unwrap();
                let inode = opened.metadata().unwrap().ino();
                self.create(path, Thing::File { inode, opened, durable: None, added: Vec::new() });
            }
            Change::CreatedFolder(path) => self.create(path, Thing::Folder),
            Change::Moved(from, to) => {
                let thing = self.seen[&self.name(from)];
                self.change(vec![(self.name(from), None), (self.name(to), Some(thing))]);
            }
            Change::Linked(from, to) => {
                let thing = self.seen[&self.name(from)];
                self.change(vec![(self.name(to), Some(thing))]);
            }
            Change::Removed(path) => self.change(vec![(self.name(path), None)]),
            Change::Synced(file) => self.sync(file),
            Change::SyncedFolder(path) => {
                let folder = self.folder(path);
                self.sync_folder(folder);
            }
        }
        self.remember();
        if let Some(kills) = &mut self.kills {
            kills.push(image::read(&self.root));
        }
    }

    fn create(&mut self, path: &Path, thing: Thing) {
        let name = self.name(path);
        self.things.push(thing);
        self.change(vec![(name, Some(self.things.len() - 1))]);
    }

    fn change(&mut self, names: Vec<(Name, Option<usize>)>) {
        apply(&mut self.seen, &names);
        self.pending.push(names);
    }

    /// Makes the content of a file durable; before that it may be lost.
    fn sync(&mut self, file: &File) {
        let thing = self.file(file).expect("it has a name");
        let mut content = Vec::new();
        if let Thing::File { opened, durable, added, .. } = &mut self.things[thing] {
            opened.rewind().and_then(|()| opened.read_to_end(&mut content)).unwrap();
            *added = content[durable.as_ref().map_or(0, Vec::len)..].to_vec();
        }
        self.remember();
        if let Thing::File { durable, added, .. } = &mut self.things[thing] {
            (*durable, *added) = (Some(content), Vec::new());
        }
    }

    /// The number of an open file that has a name here.
    fn file(&self, file: &File) -> Option<usize> {
        let number = file.metadata().unwrap().ino();
        let is_it = |thing: &usize| matches!(self.things[*thing], Thing::File { inode, .. } if inode == number);
        self.seen.values().copied().find(is_it)
    }

    /// The number of a folder.
    fn folder(&self, path: &Path) -> usize {
        let parts = path.strip_prefix(&self.root).expect("below the root").components();
        parts.fold(0, |folder, part| self.seen[&(folder, part.as_os_str().to_str().unwrap().to_owned())])
    }

    fn name(&self, path: &Path) -> Name {
        (self.folder(path.parent().unwrap()), path.file_name().unwrap().to_str().unwrap().to_owned())
    }

    /// Makes the changes in a folder durable, and earlier changes of their names.
    fn sync_folder(&mut self, folder: usize) {
        let mut names: BTreeSet<Name> = BTreeSet::new();
        let mut needed = vec![false; self.pending.len()];
        for (index, change) in self.pending.iter().enumerate().rev() {
            if change.iter().any(|(name, _)| name.0 == folder || names.contains(name)) {
                needed[index] = true;
                names.extend(change.iter().map(|(name, _)| name.clone()));
            }
        }
        let mut needed = needed.into_iter();
        let durable = &mut self.durable;
        self.pending.retain(|change| {
            let needed = needed.next().unwrap();
            if needed {
                apply(durable, change);
            }
            !needed
        });
    }

    fn remember(&mut self) {
        let mut seed = 2_463_534_242 + self.noted;
        let mut coin = || {
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            seed & 1 == 1
        };
        let mut images = vec![
            self.image(&mut || false, Lost::Nothing),
            self.image(&mut || true, Lost::Nothing),
            self.image(&mut || true, Lost::Zeros),
            self.image(&mut || true, Lost::Part),
        ];
        images.extend((0..3).map(|_| self.image(&mut coin, Lost::Zeros)));
        for image in images {
            if self.known.insert(image.clone()) {
                self.images.push(image);
            }
        }
    }

    /// A possible state of the folder; `comes` decides of each pending change whether it is on the disk.
    fn image(&self, comes: &mut dyn FnMut() -> bool, lost: Lost) -> Image {
        let (mut names, mut held) = (self.durable.clone(), BTreeSet::new());
        for change in &self.pending {
            if change.iter().any(|(name, _)| held.contains(name)) || !comes() {
                held.extend(change.iter().map(|(name, _)| name.clone()));
            } else {
                apply(&mut names, change);
            }
        }
        let mut image = Image::new();
        let mut folders = vec![(0, PathBuf::new())];
        while let Some((folder, path)) = folders.pop() {
            for ((_, name), &thing) in names.range((folder, String::new())..(folder + 1, String::new())) {
                let path = path.join(name);
                match &self.things[thing] {
                    Thing::Folder => {
                        folders.push((thing, path.clone()));
                        image.insert(path, None);
                    }
                    Thing::File { durable, added, .. } => {
                        image.insert(path, Some(left(durable.as_deref(), added, lost)));
                    }
                }
            }
        }
        image
    }
}

/// Content after a power cut.
fn left(durable: Option<&[u8]>, added: &[u8], lost: Lost) -> Vec<u8> {
    let mut content = durable.unwrap_or_default().to_vec();
    match (durable, lost) {
        (_, Lost::Nothing) => {}
        (None, Lost::Zeros | Lost::Part) => content.resize(13, 0),
        (Some(_), Lost::Zeros) => content.resize(content.len() + added.len(), 0),
        (Some(_), Lost::Part) => content.extend(&added[..added.len() / 2]),
    }
    content
}

fn apply(names: &mut BTreeMap<Name, usize>, change: &[(Name, Option<usize>)]) {
    for (name, thing) in change {
        match thing {
            Some(thing) => names.insert(name.clone(), *thing),
            None => names.remove(name),
        };
    }
}
