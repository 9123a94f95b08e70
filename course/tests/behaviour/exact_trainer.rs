//! A first lesson by a trainer who judges every step rightly, in random homes: even a robot that expects real people believes this trainer.

use goodbot::feedback::{Feedback, Judged, Strategy, population};
use goodbot::home::paper_tasks;
use goodbot::random::below;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_course::exercise::HomeName;
use goodbot_course::{Homes, generator};

/// The result of one lesson.
#[derive(Debug, Default)]
struct Lesson {
    words: usize,
    /// Words after which the robot was less sure of the intended task.
    fallen: usize,
    /// The number of words until the robot was sure.
    to_sure: Option<usize>,
    end: f32,
}

const SURE: f32 = 0.95;
const MOST_STEPS: usize = 60;

fn first_lesson(seed: u64, expected: &[(Strategy, f32)]) -> Lesson {
    let mut random = generator(seed);
    let mut memory = HeapMemory::new(&Capacities::STANDARD);
    let homes = Homes::random(&mut random, &mut memory.home);
    let name = HomeName::ALL[below(HomeName::ALL.len(), &mut random)];
    let (home, start) = homes.layout(name).build(&mut memory.home).unwrap();
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::DEFAULT.for_people().with_ends()).unwrap();
    agent.set_strategies(expected).unwrap();
    agent.hear(&home, &start, "do what is meant").unwrap();
    let intended = below(agent.tasks().len(), &mut random);
    let (mut lesson, mut state, mut rests) = (Lesson::default(), start, 0);
    for _ in 0..MOST_STEPS {
        agent.plan_fully(&home, &state).unwrap();
        let decision = agent.decide_with(&home, &state, &mut random).unwrap();
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

/// The lessons of a robot that expects such trainers: words, words after which it was less sure, the median of the words until it was sure,
/// and its mean certainty in the end.
fn taught(expected: &[(Strategy, f32)]) -> (usize, usize, Option<usize>, f32) {
    let lessons: Vec<Lesson> = (0..50).map(|seed| first_lesson(seed, expected)).collect();
    let sum = |part: fn(&Lesson) -> usize| lessons.iter().map(part).sum::<usize>();
    let mut to_sure: Vec<usize> = lessons.iter().map(|lesson| lesson.to_sure.unwrap_or(usize::MAX)).collect();
    to_sure.sort_unstable();
    let end = lessons.iter().map(|lesson| lesson.end).sum::<f32>() / lessons.len() as f32;
    let median = to_sure.get(lessons.len() / 2).copied().filter(|&words| words < usize::MAX);
    let taught = (sum(|lesson| lesson.words), sum(|lesson| lesson.fallen), median, end);
    println!("{taught:?}");
    taught
}

#[test]
fn a_right_word_of_a_faultless_trainer_never_makes_the_robot_less_sure() {
    let (words, fallen, to_sure, end) = taught(&population::STRATEGIES);
    assert_eq!(fallen, 0, "of {words} words");
    assert!(end >= 0.9, "{end}");
    let exact: Vec<_> = population::exact().take(1).collect();
    let (_, _, known, _) = taught(&exact);
    let within_one_word = to_sure.zip(known).is_some_and(|(words, known)| words <= known + 1);
    assert!(within_one_word && known <= Some(10), "{to_sure:?} words, and {known:?} where the trainer is known to be exact");
}

#[test]
fn without_exact_trainers_among_those_it_expects_it_takes_right_words_for_noise() {
    let exact: Vec<Strategy> = population::exact().map(|(strategy, _)| strategy).collect();
    let people: Vec<_> = population::STRATEGIES.into_iter().filter(|(strategy, _)| !exact.contains(strategy)).collect();
    assert_eq!(people.len() + exact.len(), population::STRATEGIES.len());
    let (words, fallen, ..) = taught(&people);
    assert!(fallen * 20 > words, "{fallen} of {words}");
}
