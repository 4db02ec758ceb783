//! Independent items, several solved at once.
//!
//! Each worker has one thread of its own, so that none waits for another, and memory is that of one solution for each worker.
//! Results are the same for any number of workers and threads, bit for bit.

use rayon::ThreadPoolBuilder;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// Calls `work` with every item, `workers` at once, and `done` with each result on the calling thread, in the order in which work
/// ends. A single worker uses all threads.
///
/// # Errors
/// The first one of `done`; no more work begins then, and results of work that has begun are dropped.
pub(super) fn each<T: Sync, R: Send, E>(
    items: &[T],
    workers: usize,
    work: impl Fn(&T) -> R + Sync,
    mut done: impl FnMut(R) -> Result<(), E>,
) -> Result<(), E> {
    if workers <= 1 {
        return items.iter().try_for_each(|item| done(work(item)));
    }
    let (next, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
    let (send, receive) = mpsc::channel();
    thread::scope(|scope| {
        let mut started = false;
        for _ in 0..workers.min(items.len()) {
            let (send, next, stop, work) = (send.clone(), &next, &stop, &work);
            let worker = move || {
                let pool = ThreadPoolBuilder::new().num_threads(1).build();
                while let Some(item) = items.get(next.fetch_add(1, Ordering::Relaxed)) {
                    // Where no more threads can be started, the common ones work.
                    let result = pool.as_ref().map_or_else(|_| work(item), |pool| pool.install(|| work(item)));
                    if stop.load(Ordering::Relaxed) || send.send(result).is_err() {
                        break;
                    }
                }
            };
            started |= thread::Builder::new().spawn_scoped(scope, worker).is_ok();
        }
        drop(send);
        if !started {
            return items.iter().try_for_each(|item| done(work(item)));
        }
        let ended = receive.iter().try_for_each(&mut done);
        stop.store(true, Ordering::Relaxed);
        drop(receive);
        ended
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_item_is_done_once_however_many_workers_there_are() {
        let items: Vec<usize> = (0..50).collect();
        for workers in [0, 1, 2, 7, 100] {
            let mut seen = Vec::new();
            each(
                &items,
                workers,
                |&k| k * k,
                |square| {
                    seen.push(square);
                    Ok::<_, ()>(())
                },
            )
            .unwrap();
            assert_eq!(seen.len(), 50);
            assert_eq!(seen.into_iter().collect::<BTreeSet<_>>(), items.iter().map(|k| k * k).collect());
        }
    }

    #[test]
    fn workers_have_one_thread_and_one_alone_has_all() {
        let threads = |workers| {
            let mut seen = BTreeSet::new();
            each(
                &[0; 8],
                workers,
                |_| rayon::current_num_threads(),
                |n| {
                    seen.insert(n);
                    Ok::<_, ()>(())
                },
            )
            .unwrap();
            seen
        };
        assert_eq!(threads(3), BTreeSet::from([1]));
        assert_eq!(threads(1), BTreeSet::from([rayon::current_num_threads()]));
    }

    #[test]
    fn a_fault_ends_it_soon() {
        let begun = AtomicUsize::new(0);
        for workers in [1, 2] {
            begun.store(0, Ordering::SeqCst);
            let work = |_: &usize| {
                begun.fetch_add(1, Ordering::SeqCst);
                thread::sleep(std::time::Duration::from_millis(1));
            };
            let ended = each(&vec![0; 10_000], workers, work, |()| Err("the disk is full"));
            assert_eq!(ended, Err("the disk is full"));
            assert!(begun.load(Ordering::SeqCst) < 1000);
        }
    }
}
