//! Threads of a model, begun in every order.
//!
//! Where two accesses depend on each other, loom 0.7 goes back and tries the other thread first;
//! but of each location it remembers one last access only. A writer that looks at an entry and
//! then exchanges it thereby hides that a reader had looked before, and the interleaving with the
//! writer first is never tried. Begun the other way round, the reader's look depends on the
//! exchange, which loom does remember. So all orders together leave none out, and the main thread
//! does nothing while the others run.

use loom::sync::Arc;
use loom::thread;

/// One thread of a model.
pub type Job<S, R> = std::sync::Arc<dyn Fn(&S) -> R + Send + Sync>;

/// A job.
pub fn job<S, R>(run: impl Fn(&S) -> R + Send + Sync + 'static) -> Job<S, R> {
    std::sync::Arc::new(run)
}

/// Runs a model with at most two preemptions, unless `LOOM_MAX_PREEMPTIONS` says otherwise: with
/// three, the table's models take ten times as long and come to the same outcomes.
fn model(run: impl Fn() + Send + Sync + 'static) {
    let mut builder = loom::model::Builder::new();
    builder.preemption_bound = builder.preemption_bound.or(Some(2));
    builder.check(run);
}

/// All orders of so many things.
fn orders(count: usize) -> Vec<Vec<usize>> {
    if count == 0 {
        return vec![Vec::new()];
    }
    let shorter = orders(count - 1);
    let inserted = shorter.iter().flat_map(|order| {
        (0..count).map(|at| {
            let mut longer = order.clone();
            longer.insert(at, count - 1);
            longer
        })
    });
    inserted.collect()
}

/// Runs jobs on what they share in every interleaving, and judges what each of them returned.
pub fn in_every_order<S, R>(
    shared: impl Fn() -> S + Send + Sync + 'static,
    jobs: Vec<Job<S, R>>,
    judge: impl Fn(&S, Vec<R>) + Send + Sync + 'static,
) where
    S: Send + Sync + 'static,
    R: Send + 'static,
{
    let everything = std::sync::Arc::new((shared, jobs, judge));
    for order in orders(everything.1.len()) {
        let everything = everything.clone();
        model(move || {
            let (shared, jobs, judge) = &*everything;
            let shared = Arc::new(shared());
            let mut running: Vec<_> = order
                .iter()
                .map(|&k| {
                    let (shared, job) = (shared.clone(), jobs[k].clone());
                    (k, thread::spawn(move || job(&shared)))
                })
                .collect();
            running.sort_by_key(|(k, _)| *k);
            let results = running
                .into_iter()
                .map(|(_, thread)| thread.join().expect("it does not panic"));
            judge(&shared, results.collect());
        });
    }
}
