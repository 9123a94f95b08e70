//! A first lesson by a trainer who judges every step rightly, in random homes: a robot that expects real people believes them.

use goodbot::feedback::{Feedback, Judged, population};
use goodbot::home::paper_tasks;
use goodbot::random::below;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_course::exercise::HomeName;
use goodbot_course::{Homes, generator};

/// What came of one lesson.
#[derive(Debug, Default)]
struct Lesson {
    words: usize,
    /// Words after which the robot was less sure of what was meant.
    fallen: usize,
    /// How many words it took until the robot was sure.
    to_sure: Option<usize>,
    end: f32,
}

const SURE: f32 = 0.95;
const MOST_STEPS: usize = 60;

fn first_lesson(seed: u64) -> Lesson {
    let mut random = generator(seed);
    let mut memory = HeapMemory::new(&Capacities::STANDARD);
    let homes = Homes::random(&mut random, &mut memory.home);
    let name = HomeName::ALL[below(HomeName::ALL.len(), &mut random)];
    let (home, start) = homes.layout(name).build(&mut memory.home).unwrap();
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::DEFAULT.for_people().with_ends()).unwrap();
    agent.set_strategies(&population::STRATEGIES).unwrap();
    agent.hear(&home, &start, "do what is meant").unwrap();
    let intended = below(agent.tasks().len(), &mut random);
    let (mut lesson, mut state, mut rests) = (Lesson::default(), start, 0);
    for _ in 0..MOST_STEPS {
        agent.plan_fully(&home, &state).unwrap();
        let decision = agent.decide_by(&home, &state, &mut random).unwrap();
        state = agent.acted(&home, &state, decision.action).unwrap();
        let before = agent.belief().probability(intended);
        let [judged, ..] = agent.judged(intended);
        let word = if matches!(judged, Judged::Nearer | Judged::RestsAtGoal) { Feedback::Reward } else { Feedback::Punish };
        let _ = agent.feedback(word).unwrap();
        let after = agent.belief().probability(intended);
        lesson.words += 1;
        lesson.fallen += usize::from(after < before - 1e-6);
        if after >= SURE {
            lesson.to_sure = lesson.to_sure.or(Some(lesson.words));
        }
        lesson.end = after;
        rests = if judged == Judged::RestsAtGoal { rests + 1 } else { 0 };
        if rests == 3 {
            break;
        }
    }
    lesson
}

#[test]
fn a_right_word_of_a_faultless_trainer_makes_the_robot_surer() {
    let lessons: Vec<Lesson> = (0..50).map(first_lesson).collect();
    let words: usize = lessons.iter().map(|lesson| lesson.words).sum();
    let fallen: usize = lessons.iter().map(|lesson| lesson.fallen).sum();
    let mut to_sure: Vec<usize> = lessons.iter().map(|lesson| lesson.to_sure.unwrap_or(usize::MAX)).collect();
    to_sure.sort_unstable();
    let end: f32 = lessons.iter().map(|lesson| lesson.end).sum::<f32>() / 50.0;
    println!("{fallen} of {words} words, sure after {}, in the end {end:.3}", to_sure[25]);
    assert!(fallen * 100 <= words, "{fallen} of {words} right words made it less sure");
    assert!(to_sure[25] <= 12, "sure after {} words in the median", to_sure[25]);
    assert!(end >= 0.95, "{end}");
}
