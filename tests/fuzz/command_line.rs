//! The command line within the fuzzer's process, so that libFuzzer sees which branches are taken.

use goodbot_tests::hostile::Run;
use std::ffi::OsString;
use std::fs::File;
use std::io::{Read, Seek, Write};
use std::os::fd::OwnedFd;

/// Runs the command line with files in the place of the standard streams.
pub fn run(arguments: &[&str], input: &[u8]) -> Run {
    let typed: Vec<OsString> = ["goodbot"].iter().chain(arguments).map(OsString::from).collect();
    let [mut read, mut output, mut messages] = [(); 3].map(|()| tempfile::tempfile().expect("a file"));
    read.write_all(input).and_then(|()| read.rewind()).expect("a file takes the input");
    let [out, err]: [OwnedFd; 2] = [
        rustix::io::dup(std::io::stdout()).expect("an output"),
        rustix::io::dup(std::io::stderr()).expect("an output"),
    ];
    rustix::stdio::dup2_stdin(&read).expect("an input");
    rustix::stdio::dup2_stdout(&output).expect("an output");
    rustix::stdio::dup2_stderr(&messages).expect("an output");
    let code = i32::from(goodbot_cli::run(&typed));
    std::io::stdout().flush().expect("the output is written");
    rustix::stdio::dup2_stdout(&out).expect("the old output");
    rustix::stdio::dup2_stderr(&err).expect("the old output");
    let text = |file: &mut File| {
        let mut text = String::new();
        file.rewind().and_then(|()| file.read_to_string(&mut text)).expect("messages are UTF-8");
        text
    };
    Run { code, output: text(&mut output), messages: text(&mut messages) }
}
