//! Derived facts tell rooms apart by position and size where their colours do not.

use goodbot::home::{self, Area, Cell, Home, HomeBuilder, HomeState, Moves};
use goodbot::memory::HomeHeap;
use goodbot::session::Evidence;
use goodbot::task::TaskSet;
use goodbot::{Agent, Capacities, HeapMemory, Options};

const COLORS: [&str; 3] = ["red", "green", "blue"];
const NAMES: [&str; 3] = ["first", "second", "third"];

/// Three rooms above a narrow hall, with these widths from left to right. The robot is in the hall. The lesson's number decides the
/// colours.
fn rooms(widths: [i32; 3], lesson: usize, derived: bool) -> (Home<HomeHeap>, HomeState) {
    let mut builder = HomeBuilder::new(HomeHeap::new(&Capacities::STANDARD));
    builder.room("hall", Area::new(0, 0, widths.iter().sum(), 2), "white").unwrap();
    let mut left = 0;
    for (position, width) in widths.into_iter().enumerate() {
        let color = COLORS[(position + lesson) % COLORS.len()];
        builder.room(NAMES[position], Area::new(left, 2, left + width, 10), color).unwrap();
        builder.door(["door0", "door1", "door2"][position], Area::new(left + 1, 2, left + 1, 2)).unwrap();
        left += width;
    }
    builder.agent("robot", Cell::new(left / 2, 1)).unwrap();
    let (home, start) = builder.build(Moves::Push).unwrap();
    (home.with_derived(derived), start)
}

/// Teaches "leftmost" and "large" in six homes, twice in two wordings. Returns the probability of the room `meant` after a command in
/// another home, on average over its three colourings: so whoever knows of colours alone has at most the third of chance.
fn understood(derived: bool, asked: &str, meant: &str) -> f32 {
    let mut agent = Agent::new(HeapMemory::new(&Capacities::STANDARD).agent, &home::paper_tasks().unwrap(), Options::DEFAULT).unwrap();
    let homes = [[4, 6, 4], [4, 4, 8], [8, 4, 4], [4, 8, 6], [6, 4, 8], [8, 6, 4]];
    for (lesson, (widths, start)) in
        std::iter::repeat_n(homes, 2).flatten().flat_map(|widths| [(widths, "go to"), (widths, "enter")]).enumerate()
    {
        let largest = (0..3).max_by_key(|&room| widths[room]).unwrap_or(0);
        let (word, goal) = if lesson % 4 < 2 { ("leftmost", NAMES[0]) } else { ("large", NAMES[largest]) };
        let (home, state) = rooms(widths, lesson, derived);
        agent.hear(&home, &state, &format!("{start} the {word} room")).unwrap();
        let is_goal = |task: &usize| home.objects().name(agent.tasks()[*task].bindings[1]) == goal;
        let meant = TaskSet::of((0..agent.tasks().len()).find(is_goal).unwrap());
        assert_eq!(agent.answered(meant, true, 0.01, 1), Ok(Evidence::Used));
        let _ = agent.finish(&home).unwrap();
        agent.learn_fully();
    }
    let mut probability = |coloring| {
        let (home, start) = rooms([4, 4, 6], coloring, derived);
        agent.hear(&home, &start, asked).unwrap();
        let is_meant = |task: &usize| home.objects().name(agent.tasks()[*task].bindings[1]) == meant;
        let of_meant: f32 = (0..agent.tasks().len()).filter(is_meant).map(|task| agent.belief().probability(task)).sum();
        agent.forget();
        of_meant
    };
    (0..COLORS.len()).map(&mut probability).sum::<f32>() / COLORS.len() as f32
}

#[test]
fn a_robot_learns_what_leftmost_and_large_mean_where_colours_tell_nothing() {
    for (command, room) in [("go to the large room", "third"), ("go to the leftmost room", "first")] {
        let (seeing, blind) = (understood(true, command, room), understood(false, command, room));
        assert!(seeing > blind + 0.1 && blind < 0.34, "{command}: {seeing}, without derived facts {blind}");
    }
}
