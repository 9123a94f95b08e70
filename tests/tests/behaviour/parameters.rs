//! Parameters without sessions: a robot that restores them understands like the robot that learned them, to the bit.

use crate::arm::Arm;
use crate::bit_flips::sign;
use crate::{commands, lessons};
use goodbot::capacity::Capacity;
use goodbot::feedback::Strategy;
use goodbot::home::{paper_tasks, with_routes};
use goodbot::language::Settings;
use goodbot::memory::{AgentHeap, AgentMemory, HomeMemory};
use goodbot::snapshot::{PARAMETERS_MAGIC, Part, RestoreError, SaveError};
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_tests::school::{self, Lesson, posterior_bits, tests_passed, train};
use rand_pcg::Pcg32;

/// Without `telling`, which an agent without the feature `asking`, as on a controller, ignores.
const OPTIONS: Options = Options { telling: false, ..Options::DEFAULT };

fn agent(capacities: &Capacities, tasks: &[LiftedTask], options: Options) -> Agent<AgentHeap> {
    Agent::new(HeapMemory::new(capacities).agent, tasks, options).unwrap()
}

fn new() -> Agent<AgentHeap> {
    agent(&Capacities::SMALL, &paper_tasks().unwrap(), OPTIONS)
}

/// After the paper's course.
fn taught(mut agent: Agent<AgentHeap>) -> Agent<AgentHeap> {
    for lesson in school::lessons() {
        train(&mut agent, &lesson, Strategy::BALANCED, &mut Pcg32::new(4, 4)).unwrap();
    }
    agent
}

fn parameters(agent: &Agent<impl AgentMemory>) -> Vec<u8> {
    let Err(SaveError::Buffer { needed, given: 0 }) = agent.save_parameters(&mut []) else { panic!("a file of no bytes was written") };
    let mut file = vec![0; needed];
    assert_eq!(agent.save_parameters(&mut file), Ok(needed));
    file
}

#[test]
fn a_robot_with_the_parameters_alone_understands_words_as_the_one_that_learned_them() {
    for tasks in [&paper_tasks().unwrap()[..], &with_routes(&paper_tasks().unwrap()).unwrap()] {
        for word_letters in [0, 4] {
            let options = Options { language: Settings { word_letters, ..Settings::DEFAULT }, ..OPTIONS };
            let mut learned = taught(agent(&Capacities::STANDARD, tasks, options));
            let mut obeying = agent(&Capacities::STANDARD, tasks, OPTIONS);
            obeying.restore_parameters(&parameters(&learned)).unwrap();
            for test in school::tests().into_iter().chain(school::lessons()) {
                // Only the one that learned them can recall commands of its lessons word for word.
                let test = Lesson { command: format!("please {}", test.command), ..test };
                assert_eq!(posterior_bits(&mut obeying, &test), posterior_bits(&mut learned, &test));
            }
            assert!(parameters(&obeying) == parameters(&learned));
            assert_eq!(obeying.language().bitext().sessions(), 0);
        }
    }
}

#[test]
fn a_robot_forgets_what_it_knew_for_the_parameters() {
    let mut obeying = taught(new());
    obeying.restore_parameters(&parameters(&new())).unwrap();
    assert_eq!((obeying.language().words().len(), obeying.language().bitext().sessions()), (0, 0));
    obeying.restore_parameters(&parameters(&taught(new()))).unwrap();
    assert_eq!(tests_passed(&mut obeying), tests_passed(&mut taught(new())));
    // The first lesson replaces the restored parameters, because no sessions support them.
    let (again, whole) = (taught(obeying), taught(new()));
    assert_eq!(again.language().bitext().sessions(), whole.language().bitext().sessions());
    assert_eq!(again.language().words().len(), whole.language().words().len());
}

#[test]
fn every_flipped_bit_and_every_cut_of_a_file_of_parameters_is_refused() {
    let (mut file, mut robot) = (parameters(&taught(new())), new());
    for bit in 0..file.len() * 8 {
        file[bit / 8] ^= 1 << (bit % 8);
        assert!(robot.restore_parameters(&file).is_err(), "bit {bit}");
        file[bit / 8] ^= 1 << (bit % 8);
    }
    for length in 0..file.len() {
        assert!(robot.restore_parameters(&file[..length]).is_err(), "{length} bytes");
    }
    assert!(parameters(&robot) == parameters(&new()));
}

#[test]
fn every_wrong_byte_under_a_right_check_is_refused_or_harmless() {
    let file = parameters(&taught(new()));
    let (mut robot, mut refused) = (new(), 0);
    for position in PARAMETERS_MAGIC.len()..file.len() - 4 {
        for wrong in [0, 1, 0x7f, 0xff] {
            let mut file = file.clone();
            file[position] = wrong;
            sign(&mut file);
            if robot.restore_parameters(&file).is_ok() {
                let _ = tests_passed(&mut robot);
            } else {
                refused += 1;
            }
        }
    }
    assert!(refused > 100, "{refused}");
    let mut longer = file;
    longer.extend([0; 4]);
    sign(&mut longer);
    assert_eq!(robot.restore_parameters(&longer), Err(RestoreError::Inconsistent(Part::Parameters)));
}

#[test]
fn parameters_that_do_not_belong_here_are_refused_by_what_is_wrong() {
    let (learned, mut model) = (taught(new()), vec![0; 1 << 16]);
    let file = parameters(&learned);
    let length = learned.save(&mut model).unwrap();
    assert_eq!(new().restore_parameters(&model[..length]), Err(RestoreError::NoParameters));
    let mut other = agent(&Capacities::SMALL, &Arm::tasks().unwrap(), OPTIONS);
    assert_eq!(other.restore_parameters(&file), Err(RestoreError::OtherDomain));
    for full in [Capacity::Words, Capacity::WordBytes, Capacity::Tokens, Capacity::TokenBytes, Capacity::Translations, Capacity::Alignments]
    {
        let mut capacities = Capacities::SMALL;
        capacities.set(full, 8);
        let refused = agent(&capacities, &paper_tasks().unwrap(), OPTIONS).restore_parameters(&file);
        assert!(
            matches!(refused, Err(RestoreError::Capacity(error)) if error.capacity == full && error.limit == 8),
            "{full:?}: {refused:?}"
        );
    }
    let of_model_2 = taught(agent(&Capacities::SMALL, &paper_tasks().unwrap(), Options::PAPER));
    assert_eq!(of_model_2.save_parameters(&mut []), Err(SaveError::NoRoles));
}

#[test]
fn the_parameters_of_the_arm_on_a_board_are_what_its_lessons_come_to() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let arm = Arm::new(memory.home.lend().objects).unwrap();
    let mut agent = Agent::new(&mut memory.agent, &Arm::tasks().unwrap(), OPTIONS).unwrap();
    lessons::teach(&mut agent, &arm).unwrap();
    let (learned, kept) = (parameters(&agent), include_bytes!("../../../firmware/src/arm.parameters"));
    if learned != kept {
        let written = concat!(env!("CARGO_TARGET_TMPDIR"), "/arm.parameters");
        std::fs::write(written, &learned).unwrap();
        panic!("the lessons come to other parameters: copy {written} to firmware/src");
    }
    assert!(commands::understanding(&mut agent, &arm).unwrap().1);
}
