//! Model files: any bytes.

use super::assert_sound;
use goodbot::capacity::Capacity;
use goodbot::home::paper_tasks;
use goodbot::memory::{AgentHeap, AgentMemory};
use goodbot::snapshot::Contents;
use goodbot::{Agent, Capacities, HeapMemory, Options};

/// Takes any bytes as a model file, and once more with corrected length and checksum, so that the code after these checks is reached. A
/// restored model can be trained, is sound, and is saved as a file that restores to the same.
pub fn model(input: &[u8]) {
    restore(input);
    let mut signed = input.to_vec();
    sign(&mut signed);
    restore(&signed);
}

/// The memory that a file asks for follows its length, whatever its head claims, and is enough to restore it.
fn assert_room(bytes: &[u8]) {
    let Ok(contents) = Contents::read(bytes) else { return };
    let (least, most) = (Capacities::SMALL, 1 << 16);
    let room = contents.room(least, most);
    // Tables of pairs grow with the product of two lists; they are bounded by `most` alone.
    let of_pairs = [Capacity::Translations, Capacity::Alignments, Capacity::LengthPairs];
    for table in Capacity::ALL.into_iter().filter(|table| !of_pairs.contains(table)) {
        assert!(room.get(table) <= 2 * (least.get(table) + bytes.len()), "{}: {}", table.name(), room.get(table));
    }
    assert!(of_pairs.iter().all(|&table| room.get(table) <= most.max(least.get(table))));
    if contents.needs().fits_in(&room).is_ok() {
        let mut agent = Agent::new(AgentHeap::new(&room), &[], Options::PAPER).expect("room for the options");
        agent.restore(bytes).expect("what fits can be restored without tasks");
        assert_eq!(
            agent.saved_for(contents.vocabulary).map(|file| Contents::read(&file).map(|it| it.vocabulary)),
            Ok(Ok(contents.vocabulary))
        );
    }
}

fn restore(bytes: &[u8]) {
    assert_room(bytes);
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().expect("the paper's tasks"), Options::PAPER).expect("two tasks fit");
    let before = saved(&agent);
    if agent.restore(bytes).is_err() {
        assert_eq!(saved(&agent), before, "a refused model changes nothing");
        return;
    }
    let contents = Contents::read(bytes).expect("what was restored can be read");
    assert_eq!(agent.language().bitext().sessions(), contents.sessions.len());
    agent.learn_fully();
    assert_sound(&agent);
    let first = saved(&agent);
    agent.restore(&first).expect("what was saved can be restored");
    agent.learn_fully();
    assert_eq!(saved(&agent), first);
    agent.join(bytes).expect("a model joined to itself adds nothing");
    assert_eq!(saved(&agent), first);
}

fn saved(agent: &Agent<impl AgentMemory>) -> Vec<u8> {
    let mut buffer = vec![0; agent.saved_bytes().expect("the model can be saved")];
    agent.save(&mut buffer).expect("the model can be saved");
    buffer
}

/// Corrects the length and the checksum of a model file, as an attacker would.
pub fn sign(bytes: &mut Vec<u8>) {
    let length = bytes.len().max(18);
    bytes.resize(length, 0);
    bytes[10..14].copy_from_slice(&(length as u32).to_le_bytes());
    let check = crc32(&bytes[..length - 4]);
    bytes[length - 4..].copy_from_slice(&check.to_le_bytes());
}

/// CRC-32 by its definition, not by the core's library.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 })
    })
}
