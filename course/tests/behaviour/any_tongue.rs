//! The paper's course in scripts without spaces, beside the same words with spaces in Latin letters.

use goodbot::feedback::Strategy;
use goodbot::{Agent, Capacities, HeapMemory, Options, home};
use goodbot_course::{CourseTrainer, Exercise, Homes, LESSONS, TESTS, generator, run_lesson};

/// The commands of the lessons and of the tests.
struct Tongue {
    lessons: [&'static str; 7],
    tests: [&'static str; 5],
}

const CHINESE: Tongue = Tongue {
    lessons: [
        "去绿色的房间",
        "去红色的房间",
        "去蓝色的房间",
        "去黄色的房间",
        "把蓝色的椅子搬到黄色的房间",
        "把紫色的袋子搬到蓝色的房间",
        "把黄色的袋子搬到红色的房间",
    ],
    tests: ["把紫色的椅子搬到绿色的房间", "把蓝色的袋子搬到黄色的房间", "去绿色的房间", "去红色的房间", "去蓝色的房间"],
};

const CHINESE_IN_LATIN: Tongue = Tongue {
    lessons: [
        "qu lvse de fangjian",
        "qu hongse de fangjian",
        "qu lanse de fangjian",
        "qu huangse de fangjian",
        "ba lanse de yizi ban dao huangse de fangjian",
        "ba zise de daizi ban dao lanse de fangjian",
        "ba huangse de daizi ban dao hongse de fangjian",
    ],
    tests: [
        "ba zise de yizi ban dao lvse de fangjian",
        "ba lanse de daizi ban dao huangse de fangjian",
        "qu lvse de fangjian",
        "qu hongse de fangjian",
        "qu lanse de fangjian",
    ],
};

const JAPANESE: Tongue = Tongue {
    lessons: [
        "緑の部屋に行って",
        "赤い部屋に行って",
        "青い部屋に行って",
        "黄色い部屋に行って",
        "青い椅子を黄色い部屋に運んで",
        "紫のかばんを青い部屋に運んで",
        "黄色いかばんを赤い部屋に運んで",
    ],
    tests: ["紫の椅子を緑の部屋に運んで", "青いかばんを黄色い部屋に運んで", "緑の部屋に行って", "赤い部屋に行って", "青い部屋に行って"],
};

/// The spelling of children.
const HIRAGANA: Tongue = Tongue {
    lessons: [
        "みどりのへやにいって",
        "あかいへやにいって",
        "あおいへやにいって",
        "きいろいへやにいって",
        "あおいいすをきいろいへやにはこんで",
        "むらさきのかばんをあおいへやにはこんで",
        "きいろいかばんをあかいへやにはこんで",
    ],
    tests: [
        "むらさきのいすをみどりのへやにはこんで",
        "あおいかばんをきいろいへやにはこんで",
        "みどりのへやにいって",
        "あかいへやにいって",
        "あおいへやにいって",
    ],
};

const JAPANESE_IN_LATIN: Tongue = Tongue {
    lessons: [
        "midori no heya ni itte",
        "akai heya ni itte",
        "aoi heya ni itte",
        "kiiroi heya ni itte",
        "aoi isu wo kiiroi heya ni hakonde",
        "murasaki no kaban wo aoi heya ni hakonde",
        "kiiroi kaban wo akai heya ni hakonde",
    ],
    tests: [
        "murasaki no isu wo midori no heya ni hakonde",
        "aoi kaban wo kiiroi heya ni hakonde",
        "midori no heya ni itte",
        "akai heya ni itte",
        "aoi heya ni itte",
    ],
};

const THAI: Tongue = Tongue {
    lessons: [
        "ไปที่ห้องสีเขียว",
        "ไปที่ห้องสีแดง",
        "ไปที่ห้องสีน้ำเงิน",
        "ไปที่ห้องสีเหลือง",
        "เอาเก้าอี้สีน้ำเงินไปที่ห้องสีเหลือง",
        "เอากระเป๋าสีม่วงไปที่ห้องสีน้ำเงิน",
        "เอากระเป๋าสีเหลืองไปที่ห้องสีแดง",
    ],
    tests: ["เอาเก้าอี้สีม่วงไปที่ห้องสีเขียว", "เอากระเป๋าสีน้ำเงินไปที่ห้องสีเหลือง", "ไปที่ห้องสีเขียว", "ไปที่ห้องสีแดง", "ไปที่ห้องสีน้ำเงิน"],
};

const THAI_IN_LATIN: Tongue = Tongue {
    lessons: [
        "pai thi hong si khiao",
        "pai thi hong si daeng",
        "pai thi hong si namngoen",
        "pai thi hong si lueang",
        "ao kaoi si namngoen pai thi hong si lueang",
        "ao krapao si muang pai thi hong si namngoen",
        "ao krapao si lueang pai thi hong si daeng",
    ],
    tests: [
        "ao kaoi si muang pai thi hong si khiao",
        "ao krapao si namngoen pai thi hong si lueang",
        "pai thi hong si khiao",
        "pai thi hong si daeng",
        "pai thi hong si namngoen",
    ],
};

/// The number of courses, half of them in the drawn homes and half in random ones, unless the environment sets another.
const COURSES: usize = 24;

/// One course, in the drawn homes or in random ones: the number of commands, from the second lesson on, that are understood before they are
/// taught, and the number of right tests.
fn course(tongue: &Tongue, seed: u64, capacities: &Capacities, random_homes: bool) -> (usize, usize) {
    let mut memory = HeapMemory::new(capacities);
    let mut random = generator(seed);
    let homes = if random_homes { Homes::random(&mut random, &mut memory.home) } else { Homes::FIXED };
    let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks().unwrap(), Options::DEFAULT).unwrap();
    agent.set_strategies(&[(Strategy::PUNISH_ONLY, 1.0)]).unwrap();
    let mut understood = 0;
    for (number, (lesson, command)) in LESSONS.iter().zip(tongue.lessons).enumerate() {
        let exercise = Exercise { command, ..*lesson };
        let (home, start) = homes.layout(exercise.home).build(&mut memory.home).unwrap();
        let trainer = CourseTrainer::PUNISH_ONLY;
        let report = run_lesson(&mut agent, &home, &start, &exercise, &trainer, &mut random, |_, _, _, _| {}).unwrap();
        understood += usize::from(number > 0 && report.understood);
    }
    let (home, start) = homes.test.build(&mut memory.home).unwrap();
    let is_right = |(test, command): (&Exercise, &'static str)| {
        let intended = Exercise { command, ..*test }.pose(&mut agent, &home, &start).unwrap().unwrap();
        let right = agent.most_likely_with(&mut random) == Some(intended);
        agent.forget();
        right
    };
    let right = TESTS.iter().zip(tongue.tests).map(is_right).filter(|&right| right).count();
    (understood, right)
}

/// The result of all courses, in percent: commands understood before they are taught, and right tests.
fn courses(tongue: &Tongue, capacities: &Capacities) -> [f32; 2] {
    let count = std::env::var("GOODBOT_COURSES").ok().and_then(|count| count.parse().ok()).unwrap_or(COURSES);
    let each = (0..count).map(|seed| course(tongue, seed as u64, capacities, seed % 2 == 1));
    let (understood, right) = each.fold((0, 0), |(understood, right), (more, others)| (understood + more, right + others));
    println!("{}: {right} tests, {understood} on first hearing", tongue.lessons[0]);
    let share = |part: usize, of: usize| 100.0 * part as f32 / (count * of) as f32;
    [share(understood, LESSONS.len() - 1), share(right, TESTS.len())]
}

fn is_within(points: f32, one: [f32; 2], other: [f32; 2]) -> bool {
    one.iter().zip(other).all(|(one, other)| other - one <= points)
}

#[test]
fn the_course_is_learned_without_spaces_as_with_them() {
    for (unspaced, spaced) in [(&CHINESE, &CHINESE_IN_LATIN), (&JAPANESE, &JAPANESE_IN_LATIN), (&THAI, &THAI_IN_LATIN)] {
        let [unspaced, spaced] = [unspaced, spaced].map(|tongue| courses(tongue, &Capacities::STANDARD));
        assert!(spaced[1] > 98.0 && is_within(2.0, unspaced, spaced), "{unspaced:?} {spaced:?}");
    }
}

#[test]
fn letters_of_syllables_alone_teach_as_much_but_for_a_first_hearing() {
    let [[first, right], [_, spaced]] = [&HIRAGANA, &JAPANESE_IN_LATIN].map(|tongue| courses(tongue, &Capacities::STANDARD));
    assert!(first > 85.0 && right > spaced - 2.0, "{first} {right} {spaced}");
}

#[test]
fn a_controller_learns_the_course_in_chinese() {
    let [first, right] = courses(&CHINESE, &Capacities::SMALL);
    assert!(first > 96.0 && right > 98.0, "{first} {right}");
}
