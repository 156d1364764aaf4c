// SPDX-License-Identifier: GPL-3.0-or-later
//! Independent pieces of work on several threads.

use std::panic::{catch_unwind, AssertUnwindSafe};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::{scope, Builder};

/// For work that doesn't follow the nesting of the drawing; kurbo's recursion ends after some twenty levels.
pub const STACK: usize = 8 << 20;

/// `work` on every item, on up to `threads` threads, this one included; results in the order of the items. None as soon
/// as one of them gives None or panics: the caller does it over in order, to meet what a single thread meets.
/// `beside` is what this thread does before it joins in.
pub fn try_map<I: Sync, T: Send, R>(
    items: &[I],
    threads: usize,
    work: impl Fn(&I) -> Option<T> + Sync,
    beside: impl FnOnce() -> R,
) -> (Option<Vec<T>>, R) {
    let next = AtomicUsize::new(0);
    let run = || {
        let mut done = Vec::new();
        loop {
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(at) else { return Some(done) };
            match catch_unwind(AssertUnwindSafe(|| work(item))) {
                Ok(Some(result)) => done.push((at, result)),
                _ => {
                    next.store(items.len(), Ordering::Relaxed);
                    return None;
                }
            }
        }
    };
    let (done, result) = scope(|s| {
        let helper = || Builder::new().name("fetexc-svg-helper".into()).stack_size(STACK).spawn_scoped(s, run);
        let helpers: Vec<_> = (1..threads.min(items.len())).map_while(|_| helper().ok()).collect();
        let result = beside();
        let own = run();
        let others: Vec<_> = helpers.into_iter().map(|h| h.join().ok().flatten()).collect();
        let all: Option<Vec<_>> = std::iter::once(own).chain(others).collect();
        (all.map(|parts| parts.into_iter().flatten().collect::<Vec<_>>()), result)
    });
    let in_order = done.map(|mut done| {
        done.sort_unstable_by_key(|(at, _)| *at);
        done.into_iter().map(|(_, result)| result).collect()
    });
    (in_order, result)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_the_order() {
        let items: Vec<usize> = (0..1000).collect();
        for threads in [1, 2, 16, 2000] {
            let (doubled, beside) = try_map(&items, threads, |i| Some(2 * i), || "beside");
            let doubled = doubled.unwrap();
            assert!(doubled.iter().enumerate().all(|(i, d)| *d == 2 * i) && doubled.len() == 1000);
            assert_eq!(beside, "beside");
        }
        assert_eq!(try_map(&[0; 0], 4, |i: &i32| Some(*i), || 3), (Some(Vec::new()), 3));
    }

    #[test]
    fn one_failure_fails_all() {
        let items: Vec<usize> = (0..1000).collect();
        for threads in [1, 3] {
            assert_eq!(try_map(&items, threads, |i| (*i != 700).then_some(*i), || 1), (None, 1));
            let panics = |i: &usize| Some(1000 / (*i as i64 - 700));
            assert_eq!(try_map(&items, threads, panics, || 1), (None, 1));
        }
    }
}
