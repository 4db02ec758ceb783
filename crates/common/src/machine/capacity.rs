//! Memory and disk that the machine has left for a run.

use super::threads::Threads;
use std::fs;
use std::path::{Path, PathBuf};

/// Memory assumed where the system does not report it, bytes: a browser gives a page 2 to 4 GiB.
const UNKNOWN: u64 = if cfg!(target_family = "wasm") { 2 << 30 } else { 64 << 30 };

/// Address space that a thread reserves for its stack and its allocator, bytes.
pub const RESERVED: u64 = 72 << 20;

/// Bytes of a mebibyte.
const MEBIBYTE: f64 = 1024.0 * 1024.0;

/// Available memory and disk, bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Capacity {
    /// [Available memory](available_memory).
    pub memory: u64,
    /// Disk under the output folder; the largest number where the system does not report it.
    pub disk: u64,
}

impl Capacity {
    /// Memory and disk for a run that writes into `folder`, which need not exist.
    pub fn on_this_machine(folder: &Path) -> Self {
        let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
        Self { memory: available_memory(), disk: disk(&folder).unwrap_or(u64::MAX) }
    }
}

/// Free disk under the nearest of the parents of a folder that exists, bytes; `None` for virtual file systems, which report no size.
#[cfg(not(target_family = "wasm"))]
fn disk(folder: &Path) -> Option<u64> {
    let space = folder.ancestors().find_map(|folder| fs4::statvfs(folder).ok())?;
    (space.total_space() > 0).then(|| space.available_space())
}

/// Free disk space: `None`, there is no disk.
#[cfg(target_family = "wasm")]
fn disk(_folder: &Path) -> Option<u64> {
    None
}

/// Memory that this process can take without being killed or swapped out, bytes: the least of free memory, the limits of its
/// control groups and that of its address space; 64 GiB (2 in a browser) where none of them can be read.
pub fn available_memory() -> u64 {
    let limits = [free(), groups(), address_space()];
    limits.into_iter().flatten().min().unwrap_or(UNKNOWN)
}

/// `MemAvailable` of Linux, bytes.
fn free() -> Option<u64> {
    kibibytes(&fs::read_to_string("/proc/meminfo").ok()?, "MemAvailable:")
}

/// Free address space under `ulimit -v`, without the reserves of threads, bytes.
fn address_space() -> Option<u64> {
    // The main thread and the working ones.
    let threads = Threads::used() as u64 + 1;
    Some(addresses_left()?.saturating_sub(threads * RESERVED))
}

/// Address space that this process may still take under `ulimit -v`, bytes; `None` without a limit.
pub fn addresses_left() -> Option<u64> {
    let limits = fs::read_to_string("/proc/self/limits").ok()?;
    let line = limits.lines().find_map(|line| line.strip_prefix("Max address space"))?;
    let limit: u64 = line.split_whitespace().next()?.parse().ok()?;
    let used = kibibytes(&fs::read_to_string("/proc/self/status").ok()?, "VmSize:")?;
    Some(limit.saturating_sub(used))
}

/// Memory left in the control groups of this process and their parents (versions 1 and 2), bytes.
fn groups() -> Option<u64> {
    let cgroups = fs::read_to_string("/proc/self/cgroup").ok()?;
    let folders = cgroups.lines().filter_map(|line| {
        let [_, controllers, path] = line.splitn(3, ':').collect::<Vec<_>>()[..] else { return None };
        let root = match controllers {
            "" => "/sys/fs/cgroup",
            list if list.split(',').any(|name| name == "memory") => "/sys/fs/cgroup/memory",
            _ => return None,
        };
        Some((PathBuf::from(root), path.trim_start_matches('/').to_owned()))
    });
    let mut least = None;
    for (root, path) in folders {
        // In a container the path may be that of the host: then only the root exists.
        for folder in root.join(path).ancestors().take_while(|folder| folder.starts_with(&root)) {
            least = least.into_iter().chain(left_in(folder)).min();
        }
    }
    least
}

/// Memory left in one control group, bytes: its limit less the used memory, file caches not counted.
fn left_in(folder: &Path) -> Option<u64> {
    let number = |name: &str| fs::read_to_string(folder.join(name)).ok()?.trim().parse::<u64>().ok();
    let (limit, used) = number("memory.max")
        .zip(number("memory.current"))
        .or_else(|| number("memory.limit_in_bytes").zip(number("memory.usage_in_bytes")))?;
    let statistics = fs::read_to_string(folder.join("memory.stat")).unwrap_or_default();
    let cached = |name: &str| {
        let line = statistics.lines().find_map(|line| line.strip_prefix(name))?;
        line.trim().parse::<u64>().ok()
    };
    let cached = cached("total_inactive_file ").or_else(|| cached("inactive_file ")).unwrap_or(0);
    Some(limit.saturating_sub(used.saturating_sub(cached)))
}

/// The value of a line `name   N kB`, in bytes.
fn kibibytes(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    Some(line.split_whitespace().next()?.parse::<u64>().ok()? << 10)
}

/// A size in words: "132 MiB", "1.5 GiB".
pub fn bytes(size: u64) -> String {
    let mebibytes = size as f64 / MEBIBYTE;
    match mebibytes {
        small if small < 9.95 => format!("{small:.1} MiB"),
        some if some < 10_000.0 => format!("{some:.0} MiB"),
        many if many < 1e9 => format!("{:.0} GiB", many / 1024.0),
        huge => format!("{:.4e} GiB", huge / 1024.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_group_has_left_what_its_limit_leaves_beside_caches() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
        write("memory.max", "max\n");
        write("memory.current", "900\n");
        assert_eq!(left_in(folder.path()), None);
        write("memory.max", "1000\n");
        assert_eq!(left_in(folder.path()), Some(100));
        write("memory.stat", "anon 200\ninactive_file 700\n");
        assert_eq!(left_in(folder.path()), Some(800));
        write("memory.max", "100\n");
        assert_eq!(left_in(folder.path()), Some(0));
    }

    #[test]
    fn memory_of_the_first_version_of_groups_is_read_too() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
        write("memory.limit_in_bytes", "5000\n");
        write("memory.usage_in_bytes", "3000\n");
        write("memory.stat", "inactive_file 1\ntotal_inactive_file 500\n");
        assert_eq!(left_in(folder.path()), Some(2500));
    }

    #[test]
    fn the_disk_of_a_folder_that_is_not_there_yet_is_that_of_the_one_above() {
        let folder = tempfile::tempdir().unwrap();
        let (there, not_yet) = (Capacity::on_this_machine(folder.path()), folder.path().join("a/b/c"));
        let below = Capacity::on_this_machine(&not_yet);
        assert!(below.disk > 0 && below.disk < u64::MAX && !not_yet.exists());
        // Other processes write meanwhile.
        assert!((below.disk as f64 / there.disk as f64 - 1.0).abs() < 0.5);
    }

    #[test]
    fn lines_of_the_system_are_in_kibibytes() {
        assert_eq!(kibibytes("MemFree:  1 kB\nMemAvailable:   2048 kB\n", "MemAvailable:"), Some(2 << 20));
    }
}
