// SPDX-License-Identifier: GPL-3.0-or-later
//! Strokes outlined on several threads before the walk that writes the drawing. The walk takes what is here and outlines
//! the rest itself, so this decides nothing but speed: what fails here (a limit, a panic) the walk meets again, in its
//! own order. Left to it: strokes inside masks and patterns.

use std::cmp::Reverse;
use std::collections::HashMap;
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::{scope, Builder};

use kurbo::Affine;
use usvg::{Group, ImageKind, Node};

use crate::budget::{Budget, Failure};
use crate::emit::key;
use crate::geom::map_is_finite;
use crate::outline::{outline_of, Outline};
use crate::parallel::STACK;
use crate::recover::Recovery;

/// A path of the tree (by its address) and the space it is drawn in.
type Key = (usize, [u64; 6]);

struct Done {
    outline: Outline,
    /// Segments it was charged.
    cost: u64,
}

#[derive(Default)]
pub struct OutlinesAhead {
    done: HashMap<Key, Done>,
}

pub struct Context<'a> {
    pub recovery: &'a Recovery,
    /// Of stroke outlines, in canvas units.
    pub tolerance: f64,
    pub threads: usize,
}

struct Job<'t> {
    path: &'t usvg::Path,
    stroke: &'t usvg::Stroke,
    to_root: Affine,
}

fn key_of(path: &usvg::Path, to_root: &Affine) -> Key {
    (path as *const usvg::Path as usize, key(to_root))
}

impl OutlinesAhead {
    /// The outline of a path's stroke, charged as if it were made now.
    pub fn take(
        &mut self,
        path: &usvg::Path,
        to_root: &Affine,
        budget: &mut Budget,
    ) -> Result<Option<Outline>, Failure> {
        let Some(done) = self.done.remove(&key_of(path, to_root)) else { return Ok(None) };
        budget.charge(done.cost as usize)?;
        Ok(Some(done.outline))
    }
}

/// `frame` maps the content of the outermost group into the canvas.
pub fn outlines_ahead(tree: &usvg::Tree, frame: &Affine, context: &Context, budget: &Budget) -> OutlinesAhead {
    let mut list = List { jobs: Vec::new(), recovery: context.recovery, budget: budget.duplicate() };
    let listed = match tree.root().children() {
        [Node::Group(g)] => list.group(g, frame),
        children => list.children(children, &Affine::IDENTITY),
    };
    match listed {
        Ok(()) => {
            list.jobs.sort_by_key(|job| Reverse(job.path.data().len())); // the long ones first: all threads end together
            OutlinesAhead { done: run(&list.jobs, context, &list.budget) }
        }
        Err(_) => OutlinesAhead::default(),
    }
}

/// The strokes of the picture, found as the walk finds them (emit.rs).
struct List<'t> {
    jobs: Vec<Job<'t>>,
    recovery: &'t Recovery,
    budget: Budget,
}

impl<'t> List<'t> {
    fn children(&mut self, nodes: &'t [Node], to_root: &Affine) -> Result<(), Failure> {
        for node in nodes {
            self.budget.charge(1)?;
            match node {
                Node::Group(g) => self.group(g, &(*to_root * self.recovery.transform(g.transform())))?,
                Node::Text(t) => self.children(t.flattened().children(), to_root)?,
                Node::Image(i) => {
                    if let ImageKind::SVG(tree) = i.kind() {
                        self.children(tree.root().children(), to_root)?;
                    }
                }
                Node::Path(path) => {
                    if let Some(stroke) = path.stroke().filter(|_| path.is_visible()) {
                        self.jobs.push(Job { path, stroke, to_root: *to_root });
                    }
                }
            }
        }
        Ok(())
    }

    fn group(&mut self, g: &'t Group, own: &Affine) -> Result<(), Failure> {
        if !map_is_finite(own) || !g.filters().is_empty() {
            return Ok(()); // not drawn, or drawn by resvg
        }
        self.children(g.children(), own)
    }
}

fn run(jobs: &[Job<'_>], context: &Context, purse: &Budget) -> HashMap<Key, Done> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut budget = purse.share();
        let mut done = Vec::new();
        while let Some(job) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) {
            match catch_unwind(AssertUnwindSafe(|| outline_job(job, context, &mut budget))) {
                Ok(Ok(result)) => done.push((key_of(job.path, &job.to_root), result)),
                Ok(Err(_)) => next.store(jobs.len(), Ordering::Relaxed), // out of segments or time: all end here
                Err(_) => {}
            }
        }
        done
    };
    scope(|s| {
        let helper = || Builder::new().name("fetexc-svg-stroke".into()).stack_size(STACK).spawn_scoped(s, work);
        let helpers: Vec<_> = (1..context.threads.min(jobs.len())).map_while(|_| helper().ok()).collect();
        let own = work();
        let others = helpers.into_iter().flat_map(|h| h.join().unwrap_or_default());
        own.into_iter().chain(others).collect()
    })
}

fn outline_job(job: &Job, context: &Context, budget: &mut Budget) -> Result<Done, Failure> {
    let before = budget.spent();
    let (path, origin) = context.recovery.find(job.path.data(), job.path.id());
    let outline = outline_of(job.stroke, &path, origin.as_deref(), &job.to_root, context.tolerance, budget)?;
    Ok(Done { outline, cost: budget.spent() - before })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    const TOLERANCE: f64 = 1e-5;

    fn tree() -> usvg::Tree {
        let paths: String = (0..60).map(|i| format!("<path d='M{i} 0q9 1 3 7l{} 3z' stroke='red'/>", i % 5)).collect();
        let svg =
            format!("<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'><g opacity='.5'>{paths}</g></svg>");
        usvg::Tree::from_str(&svg, &usvg::Options::default()).unwrap()
    }

    fn strokes(nodes: &[Node]) -> Vec<&usvg::Path> {
        fn of(node: &Node) -> Vec<&usvg::Path> {
            match node {
                Node::Group(g) => strokes(g.children()),
                Node::Path(p) => vec![p.as_ref()],
                _ => Vec::new(),
            }
        }
        nodes.iter().flat_map(of).collect()
    }

    fn ahead(tree: &usvg::Tree, recovery: &Recovery, budget: &Budget) -> OutlinesAhead {
        let context = Context { recovery, tolerance: TOLERANCE, threads: 4 };
        outlines_ahead(tree, &Affine::IDENTITY, &context, budget)
    }

    #[test]
    fn holds_every_stroke_at_its_price() {
        let (tree, recovery) = (tree(), Recovery::default());
        let mut budget = Budget::new(1_000_000, Duration::from_secs(60));
        let mut made = ahead(&tree, &recovery, &budget);
        assert_eq!(budget.spent(), 0);
        let all = strokes(tree.root().children());
        assert_eq!((all.len(), made.done.len()), (60, 60));
        for p in all {
            let before = budget.spent();
            let taken = made.take(p, &Affine::IDENTITY, &mut budget).ok().flatten().unwrap();
            let price = budget.spent() - before;
            let (path, origin) = recovery.find(p.data(), p.id());
            let own =
                outline_of(p.stroke().unwrap(), &path, origin.as_deref(), &Affine::IDENTITY, TOLERANCE, &mut budget);
            assert_eq!(taken.contours, own.ok().unwrap().contours);
            assert_eq!(price, budget.spent() - before - price);
            assert!(price > 0);
        }
        assert!(made.done.is_empty());
    }

    #[test]
    fn stops_at_the_limit() {
        let (tree, recovery) = (tree(), Recovery::default());
        let budget = Budget::new(200, Duration::from_secs(60));
        let made = ahead(&tree, &recovery, &budget);
        let segments: usize = made.done.values().flat_map(|d| &d.outline.contours).map(Vec::len).sum();
        assert!(segments > 0 && segments <= 200);
        assert!(ahead(&tree, &recovery, &Budget::new(10, Duration::from_secs(60))).done.is_empty());
    }
}
