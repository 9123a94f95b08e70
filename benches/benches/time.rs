//! The time of each benchmark: `cargo bench -p goodbot-benches`.

use std::time::Duration;

use criterion::{BenchmarkGroup, Criterion, measurement::WallTime};
use goodbot_benches::works;

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group: BenchmarkGroup<'_, WallTime> = criterion.benchmark_group("goodbot");
    group.sample_size(10).warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_millis(600));
    for work in works::all() {
        group.bench_function(&work.name, |bencher| {
            let mut run = (work.prepare)();
            bencher.iter(&mut run);
        });
    }
    group.finish();
    criterion.final_summary();
}
