use goodbot::HeapMemory;
use goodbot::oomdp::{Action, Domain};
use goodbot_benches::homes::*;
use goodbot_benches::timing::*;
use goodbot_tests::random_homes::Size;
use pathfinding::directed::dijkstra::dijkstra;
fn main() {
    for side in [3, 4, 5, 6] {
        let mut memory = HeapMemory::new(&LARGE);
        let mut scene = Scene::new(Size { columns: 3, rows: 1, side, blocks: 2 }, Tasks::Paper, &mut memory);
        let own = median((0..9).map(|_| time(&mut || scene.plan())).collect());
        let s = scene.planner.search();
        let d: Vec<_> = (0..scene.tasks.len()).map(|t| s.distance(t)).collect();
        println!("side {side} states {} expanded {} own {own:?} dist {d:?}", scene.home.state_count(), s.expanded());
        let mut total = 0u64;
        let peer = time(&mut || {
            for t in 0..scene.tasks.len() {
                let home = &scene.home;
                let goals = &scene.goals;
                let r = dijkstra(
                    &home.number(&scene.start),
                    |&n| {
                        total += 1;
                        let st = home.numbered(n);
                        (0..4).filter_map(|a| home.step(&st, Action(a))).map(|x| (home.number(&x), 1u32)).collect::<Vec<_>>()
                    },
                    |&n| goals.satisfied(home, &home.numbered(n)).contains(t),
                );
                std::hint::black_box(r);
            }
        });
        println!(
            "   peer {peer:?} expanded {total} ratio {:.1}; {:.0} ns own/exp {:.0} ns peer/exp",
            peer.as_secs_f64() / own.as_secs_f64(),
            own.as_secs_f64() * 1e9 / s.expanded() as f64,
            peer.as_secs_f64() * 1e9 / total as f64
        );
        let mut words = vec![0; LARGE.sweep_words];
        let t = time(&mut || {
            sweep(&scene, &mut words);
        });
        let sw = sweep(&scene, &mut words);
        println!("   sweep {t:?} settled {}", sw.settled());
    }
}
