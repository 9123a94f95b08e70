//! Every bit of a saved model flipped, one at a time: it is refused, and the robot keeps what it knew.

use goodbot::feedback::Strategy;
use goodbot::home::paper_tasks;
use goodbot::memory::{AgentHeap, AgentMemory};
use goodbot::snapshot::RestoreError;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_tests::school::{self, train};
use rand_pcg::Pcg32;

fn agent(memory: &mut HeapMemory) -> Agent<&mut AgentHeap> {
    Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::PAPER).unwrap()
}

fn saved(agent: &Agent<impl AgentMemory>) -> Vec<u8> {
    let mut buffer = vec![0; agent.saved_bytes().unwrap()];
    agent.save(&mut buffer).unwrap();
    buffer
}

/// The model after the paper's whole course.
fn course() -> Vec<u8> {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = agent(&mut memory);
    for lesson in school::lessons() {
        train(&mut agent, &lesson, Strategy::BALANCED, &mut Pcg32::new(4, 4)).unwrap();
    }
    saved(&agent)
}

/// Corrects the checksum at the end, as somebody who damages a model on purpose would.
pub(crate) fn sign(bytes: &mut [u8]) {
    let (checked, check) = bytes.split_last_chunk_mut::<4>().unwrap();
    *check = crc32(checked).to_le_bytes();
}

/// CRC-32 by its definition, without the library that the core uses.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 })
    })
}

#[test]
fn every_flipped_bit_of_a_model_is_refused() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut robot = agent(&mut memory);
    let (mut bytes, before) = (course(), saved(&robot));
    for bit in 0..bytes.len() * 8 {
        bytes[bit / 8] ^= 1 << (bit % 8);
        assert!(robot.restore(&bytes).is_err(), "bit {bit}");
        bytes[bit / 8] ^= 1 << (bit % 8);
    }
    assert_eq!(saved(&robot), before);
    println!("bit flips refused: {} of {}", bytes.len() * 8, bytes.len() * 8);
    robot.restore(&bytes).unwrap();
}

#[test]
fn every_flipped_bit_under_a_corrected_check_is_refused_or_harmless() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut robot = agent(&mut memory);
    let bytes = course();
    let (mut refused, mut harmless) = (0, 0);
    for bit in 0..(bytes.len() - 4) * 8 {
        let mut flipped = bytes.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        sign(&mut flipped);
        if robot.restore(&flipped).is_err() {
            refused += 1;
            continue;
        }
        harmless += 1;
        robot.learn_fully();
        let tables = robot.language().tables();
        for (token, _) in robot.language().tokens().iter() {
            for (word, _) in robot.language().words().iter() {
                assert!((0.0..=1.0).contains(&tables.translation(word, Some(token))), "bit {bit}");
            }
        }
        for test in school::tests() {
            let posterior = school::posterior_bits(&mut robot, &test);
            assert!(posterior.iter().all(|&bits| (0.0..=1.0).contains(&f32::from_bits(bits))), "bit {bit}");
        }
        for strategy in 0..robot.belief().strategies().len() {
            assert!((0.0..=1.0).contains(&robot.belief().strategy_probability(strategy)), "bit {bit}");
        }
    }
    println!("bit flips under a corrected check: {refused} refused, {harmless} restored without harm");
    assert!(refused > 0 && harmless > 0);
}

#[test]
fn every_cut_of_a_model_is_refused_and_so_is_what_follows_it() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut robot = agent(&mut memory);
    let mut bytes = course();
    for length in 0..bytes.len() {
        assert!(robot.restore(&bytes[..length]).is_err());
    }
    let stated = bytes.len() as u32;
    bytes.push(0);
    assert_eq!(robot.restore(&bytes), Err(RestoreError::Length { stated, given: bytes.len() }));
}

#[test]
fn a_robot_passes_over_the_kinds_of_task_that_a_host_wrote_behind_a_model() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut robot = agent(&mut memory);
    let model = course();
    let (mut kept, stated) = (model.clone(), model.len() as u32);
    kept.extend(b"gbkinds\0 and whatever a host says");
    robot.restore(&kept).unwrap();
    assert_eq!(robot.saved().unwrap(), model);
    for cut in 1..8 {
        let bytes = &kept[..model.len() + cut];
        assert_eq!(robot.restore(bytes), Err(RestoreError::Length { stated, given: bytes.len() }), "cut in the record's first bytes");
    }
}
