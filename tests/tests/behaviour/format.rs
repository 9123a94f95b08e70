//! A model file, read by the documentation of `goodbot::snapshot` alone: no type of the library and no decoder, only bytes.

use goodbot::feedback::Strategy;
use goodbot::home::paper_tasks;
use goodbot::snapshot::{Part, RestoreError};
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_tests::school::{self, train};
use rand_pcg::Pcg32;

/// The bytes not read yet.
struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    fn bytes(&mut self, count: usize) -> &'a [u8] {
        let (front, rest) = self.0.split_at(count);
        self.0 = rest;
        front
    }

    /// Seven bits per byte, lowest first; the top bit is set on all bytes but the last.
    fn varint(&mut self) -> usize {
        let (mut value, mut shift) = (0, 0);
        loop {
            let byte = usize::from(self.bytes(1)[0]);
            value |= (byte & 0x7f) << shift;
            shift += 7;
            if byte < 0x80 {
                return value;
            }
        }
    }

    fn float(&mut self) -> f32 {
        f32::from_le_bytes(self.bytes(4).try_into().unwrap())
    }

    fn list<T>(&mut self, mut record: impl FnMut(&mut Self) -> T) -> Vec<T> {
        (0..self.varint()).map(|_| record(self)).collect()
    }

    fn text(&mut self) -> String {
        let count = self.varint();
        String::from_utf8(self.bytes(count).to_vec()).unwrap()
    }
}

fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 })
    })
}

#[test]
fn a_saved_model_is_what_the_document_says_byte_by_byte() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::DEFAULT).unwrap();
    for lesson in school::lessons().iter().cycle().take(40) {
        train(&mut agent, lesson, Strategy::BALANCED, &mut Pcg32::new(6, 6)).unwrap();
    }
    let mut file = vec![0; agent.saved_bytes().unwrap()];
    agent.save(&mut file).unwrap();

    assert_eq!(&file[..10], [0x67, 0x6f, 0x6f, 0x64, 0x62, 0x6f, 0x74, 0x00, 2, 0]);
    assert_eq!(u32::from_le_bytes(file[10..14].try_into().unwrap()) as usize, file.len());
    let (checked, check) = file.split_at(file.len() - 4);
    assert_eq!(check, crc32(checked).to_le_bytes());

    let mut payload = Reader(&checked[14..]);
    assert_eq!(payload.varint(), agent.vocabulary() as usize);
    let sizes: Vec<usize> = (0..13).map(|_| payload.varint()).collect();
    let small = Capacities::SMALL;
    assert_eq!(sizes[..4], [small.strategies, small.words, small.word_bytes, small.tokens]);
    assert_eq!(sizes[4..10], [small.token_bytes, small.commands, small.command_tokens, small.sessions, small.sentence_words, small.pairs]);
    assert_eq!(sizes[10..], [small.translations, small.alignments, small.length_pairs]);

    let count = payload.varint();
    let mut options = Reader(payload.bytes(count));
    let language = Options::DEFAULT.language;
    assert_eq!(
        (options.float(), options.float(), options.varint()),
        (language.smoothing, language.alignment_prior, language.rounds as usize)
    );
    assert_eq!(options.bytes(2), [0, 0], "no length factor, no belief weights");
    assert_eq!(options.float(), Options::DEFAULT.least_weight);
    assert_eq!(options.bytes(2), [4, 1], "four letters, facts beside their proposition");
    assert_eq!(options.bytes(2), [1, 0], "the role model, no weights by evidence alone");
    let trainer = (options.float(), options.float(), options.float());
    assert_eq!(trainer, (Options::DEFAULT.drift, Options::DEFAULT.ending.at_goal.moved, Options::DEFAULT.ending.elsewhere.moved));
    assert_eq!(options.bytes(1), [1], "actions that tell more");
    let ends: [f32; 8] = core::array::from_fn(|_| options.float());
    assert_eq!(ends, [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0], "the end says nothing, whatever came before");
    assert!(options.0.is_empty());

    let strategies = payload.list(|payload| [payload.float(), payload.float(), payload.float(), payload.float()]);
    assert_eq!(strategies.len(), agent.belief().strategies().len());
    let words = payload.list(Reader::text);
    let tokens = payload.list(Reader::text);
    let model = agent.language();
    assert!(model.words().iter().map(|(_, text)| text).eq(&words));
    assert!(model.tokens().iter().map(|(_, text)| text).eq(&tokens));
    let commands = payload.list(|payload| payload.list(Reader::varint));
    let sessions = payload.list(|payload| (payload.list(Reader::varint), payload.varint()));
    let pairs = payload.list(|payload| (payload.varint(), payload.float()));
    let heard_again = payload.list(|payload| payload.bytes(1)[0]);
    let trainers = payload.list(|payload| [payload.float(), payload.float(), payload.float(), payload.float()]);
    assert_eq!(trainers, [[1.0, 0.0, 0.0, 1.0]], "no lag, and the one strategy was expected");
    let rests = payload.list(|payload| [payload.float(), payload.float(), payload.float(), payload.float()]);
    assert_eq!(rests, [Strategy::BALANCED.rests()], "rests are spoken of as moves");
    assert!(payload.0.is_empty());

    assert_eq!((commands.len(), sessions.len()), (model.bitext().commands(), model.bitext().sessions()));
    assert_eq!(sessions.iter().map(|session| session.1).sum::<usize>(), pairs.len());
    for (position, (words, _)) in sessions.iter().enumerate() {
        assert!(model.bitext().sentence(position as u16).iter().map(|word| word.index()).eq(words.iter().copied()));
        assert_eq!(heard_again[position], u8::from(model.bitext().heard_again(position as u16)));
    }
    assert!(heard_again.contains(&1), "what gave way in forty sessions is remembered");
    for (pair, (command, weight)) in model.bitext().pairs().iter().zip(&pairs) {
        assert_eq!((usize::from(pair.command), pair.weight), (*command, *weight));
        assert!(model.bitext().command(pair.command).iter().map(|token| token.index()).eq(commands[*command].iter().copied()));
    }
}

/// A file with another end: without its last bytes but the check, with these instead, and with its length and check corrected.
fn ending_in(file: &[u8], cut: usize, end: &[u8]) -> Vec<u8> {
    let mut other = [&file[..file.len() - 4 - cut], end].concat();
    let length = other.len() as u32 + 4;
    other[10..14].copy_from_slice(&length.to_le_bytes());
    other.extend(crc32(&other).to_le_bytes());
    other
}

/// The model of one lesson, and the bytes of its last three lists: of what was heard again, of the trainers and of their rests.
fn of_one_lesson() -> (Vec<u8>, [usize; 3]) {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::DEFAULT).unwrap();
    train(&mut agent, &school::lessons()[0], Strategy::BALANCED, &mut Pcg32::new(6, 6)).unwrap();
    let mut file = vec![0; agent.saved_bytes().unwrap()];
    agent.save(&mut file).unwrap();
    (file, [1 + 1, 1 + 16, 1 + 16])
}

#[test]
fn a_file_that_ends_before_a_later_list_is_read_as_one_in_which_the_list_says_nothing() {
    let (file, lists) = of_one_lesson();
    for first in 0..lists.len() {
        let older = ending_in(&file, lists[first..].iter().sum(), &[]);
        let mut memory = HeapMemory::new(&Capacities::SMALL);
        let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::DEFAULT).unwrap();
        agent.restore(&older).unwrap();
        agent.learn_fully();
        let mut again = vec![0; agent.saved_bytes().unwrap()];
        agent.save(&mut again).unwrap();
        assert_eq!(again, file, "without the last {}", lists.len() - first);
    }
}

#[test]
fn a_list_of_another_length_than_the_list_that_it_belongs_to_is_refused_by_its_name() {
    let (file, lists) = of_one_lesson();
    for (list, part) in [Part::HeardAgain, Part::Trainers, Part::Rests].into_iter().enumerate() {
        let cut: usize = lists[list..].iter().sum();
        let end = &file[file.len() - 4 - cut..file.len() - 4];
        let (record, later) = end[1..].split_at(lists[list] - 1);
        let longer = ending_in(&file, cut, &[&[2], record, record, later].concat());
        let mut memory = HeapMemory::new(&Capacities::SMALL);
        let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::DEFAULT).unwrap();
        assert_eq!(agent.restore(&longer), Err(RestoreError::Inconsistent(part)));
    }
}
