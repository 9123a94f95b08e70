//! The terminal: taken over, and always given back as it was.

#[cfg(all(test, unix))]
#[path = "../../tests/behaviour/window/mod.rs"]
mod window;

use super::keys::{Focus, Intent, intent};
use super::palette::Palette;
use super::screen;
use super::visit::Visit;
use crossterm::cursor::{Hide, Show};
use crossterm::event::{self, DisableBracketedPaste, EnableBracketedPaste, Event};
use crossterm::execute;
use crossterm::terminal::{EnterAlternateScreen, LeaveAlternateScreen, disable_raw_mode, enable_raw_mode};
use ratatui::Terminal;
use ratatui::backend::CrosstermBackend;
use ratatui::layout::Rect;
#[cfg(unix)]
use signal_hook::consts::{SIGCONT, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGTSTP};
use std::io::{self, Stdout, stdout};
use std::mem::ManuallyDrop;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// The longest wait before signals are handled.
const SIGNALS_WAIT: Duration = Duration::from_millis(100);

/// A terminal that was taken over. Dropping this gives it back.
struct Stage {
    /// Never dropped: that would show the cursor again, and would panic if the window was closed.
    terminal: ManuallyDrop<Terminal<CrosstermBackend<Stdout>>>,
}

impl Stage {
    #[expect(clippy::disallowed_methods, reason = "the screen is drawn on the terminal itself")]
    fn enter() -> io::Result<Self> {
        take_over()?;
        Ok(Self { terminal: ManuallyDrop::new(Terminal::new(CrosstermBackend::new(stdout()))?) })
    }

    /// Redraws everything the next time. Clearing would ask the terminal for its cursor's position, and not every terminal answers.
    fn redraw(&mut self) -> io::Result<()> {
        let size = self.terminal.size()?;
        self.terminal.resize(Rect::new(0, 0, size.width, size.height))
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        give_back();
    }
}

#[expect(clippy::disallowed_methods, reason = "these sequences are the program's own")]
fn take_over() -> io::Result<()> {
    enable_raw_mode()?;
    execute!(stdout(), EnterAlternateScreen, Hide, EnableBracketedPaste)
}

/// Errors are ignored: the terminal may be closed.
#[expect(clippy::disallowed_methods, reason = "these sequences are the program's own")]
fn give_back() {
    let _ = execute!(stdout(), DisableBracketedPaste, LeaveAlternateScreen, Show);
    let _ = disable_raw_mode();
}

/// Gives the terminal back before a panic's message. If panics abort, nothing else does.
fn give_back_in_a_panic() {
    let told = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        give_back();
        told(panic);
    }));
}

/// The requests of other programs and of the system, by signals. Only Unix has them.
#[derive(Default)]
struct Signals {
    leave: Arc<AtomicBool>,
    stop: Arc<AtomicBool>,
    go_on: Arc<AtomicBool>,
}

impl Signals {
    fn listen() -> io::Result<Self> {
        let signals = Self::default();
        #[cfg(unix)]
        for (signal, asked) in [
            (SIGHUP, &signals.leave),
            (SIGINT, &signals.leave),
            (SIGQUIT, &signals.leave),
            (SIGTERM, &signals.leave),
            (SIGTSTP, &signals.stop),
            (SIGCONT, &signals.go_on),
        ] {
            signal_hook::flag::register(signal, Arc::clone(asked))?;
        }
        Ok(signals)
    }

    /// Stops this program until it is continued.
    fn suspend(&self) -> io::Result<()> {
        #[cfg(unix)]
        signal_hook::low_level::emulate_default_handler(SIGTSTP)?;
        self.go_on.store(false, Ordering::Relaxed);
        Ok(())
    }
}

/// Keys and changes of size, from a thread of their own: if the window was closed, reading may never return.
fn listen() -> Receiver<io::Result<Event>> {
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        loop {
            let event = event::read();
            let ended = event.is_err();
            if sender.send(event).is_err() || ended {
                break;
            }
        }
    });
    receiver
}

/// Shows a visit until it is over.
///
/// # Errors
/// An error if the terminal cannot be read or drawn on, as when its window is closed.
pub fn show(visit: &mut Visit, palette: Palette) -> io::Result<()> {
    give_back_in_a_panic();
    let signals = Signals::listen()?;
    let mut stage = Stage::enter()?;
    let events = listen();
    let begun = Instant::now();
    while !visit.left {
        visit.tick(begun.elapsed());
        stage.terminal.draw(|frame| screen::draw(frame, visit, palette))?;
        if signals.leave.load(Ordering::Relaxed) {
            visit.take(Intent::Leave, begun.elapsed());
            continue;
        }
        if signals.stop.swap(false, Ordering::Relaxed) {
            suspend(&mut stage, &signals)?;
        }
        if signals.go_on.swap(false, Ordering::Relaxed) {
            take_over()?;
            stage.redraw()?;
        }
        let now = begun.elapsed();
        let wait = visit.next().map_or(SIGNALS_WAIT, |next| next.saturating_sub(now).min(SIGNALS_WAIT));
        let event = match events.recv_timeout(wait) {
            Ok(event) => event?,
            Err(RecvTimeoutError::Timeout) => continue,
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        };
        match event {
            Event::Key(key) => match intent(key, visit.focus(), visit.prompt.is_empty()) {
                Some(Intent::Suspend) => suspend(&mut stage, &signals)?,
                Some(Intent::Redraw) => stage.redraw()?,
                Some(intent) => visit.take(intent, begun.elapsed()),
                None => {}
            },
            Event::Paste(text) if visit.focus() == Focus::Command => visit.paste(&text),
            _ => {}
        }
    }
    Ok(())
}

fn suspend(stage: &mut Stage, signals: &Signals) -> io::Result<()> {
    give_back();
    signals.suspend()?;
    take_over()?;
    stage.redraw()
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use portable_pty::CommandBuilder;
    use window::Window;

    /// Set if this test runs in a window of its own, to panic there.
    const IN_A_WINDOW: &str = "GOODBOT_TEST_IN_A_WINDOW";

    #[test]
    fn a_panic_gives_the_terminal_back() {
        if std::env::var_os(IN_A_WINDOW).is_some() {
            give_back_in_a_panic();
            // As if panics aborted.
            std::mem::forget(Stage::enter().unwrap());
            panic!("a fault of this test");
        }
        let mut itself = CommandBuilder::new(std::env::current_exe().unwrap());
        itself.args(["--exact", "teach::terminal::tests::a_panic_gives_the_terminal_back", "--nocapture"]);
        itself.env(IN_A_WINDOW, "1");
        itself.env("RUST_BACKTRACE", "0");
        let mut window = Window::open(itself, 80, 24);
        assert!(!window.end().success());
        let wrote = |text: &str| String::from_utf8_lossy(&window.bytes()).contains(text);
        window.wait("the panic's message", |_| wrote("a fault of this test"));
        assert!(wrote("[?1049h"));
        assert!(window.is_as_found());
    }
}
