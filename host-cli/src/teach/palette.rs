//! Colours. No meaning is shown by a colour alone: a letter or a word repeats it.

use crossterm::style::available_color_count;
use ratatui::style::{Color, Modifier, Style};

/// The number of colours in the terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Palette {
    /// No colours: they are unwanted.
    None,
    /// The sixteen colours of every terminal.
    Sixteen,
    /// 256 colours.
    Many,
}

/// A colour's name, its shade on a floor and its shade on a thing among 256, and the nearest of the sixteen.
const SHADES: [(&str, u8, u8, Color); 9] = [
    ("red", 52, 203, Color::Red),
    ("green", 22, 114, Color::Green),
    ("blue", 18, 75, Color::Blue),
    ("yellow", 58, 227, Color::Yellow),
    ("purple", 54, 141, Color::Magenta),
    ("orange", 94, 215, Color::LightRed),
    ("teal", 23, 80, Color::Cyan),
    ("magenta", 89, 212, Color::LightMagenta),
    ("tan", 95, 180, Color::LightYellow),
];

impl Palette {
    /// The terminal's palette.
    pub fn of_terminal() -> Self {
        if available_color_count() > 16 { Self::Many } else { Self::Sixteen }
    }

    fn shades(name: &str) -> Option<(u8, u8, Color)> {
        SHADES.iter().find(|(known, ..)| *known == name).map(|&(_, floor, thing, nearest)| (floor, thing, nearest))
    }

    /// The floor of a room of this colour.
    pub fn floor(self, name: &str) -> Style {
        match (self, Self::shades(name)) {
            (Self::Many, Some((floor, thing, _))) => Style::new().bg(Color::Indexed(floor)).fg(Color::Indexed(thing)),
            (Self::Sixteen, Some((_, _, nearest))) => Style::new().fg(nearest),
            _ => Style::new(),
        }
    }

    /// A block of this colour.
    pub fn block(self, name: &str) -> Style {
        match (self, Self::shades(name)) {
            (Self::Many, Some((_, thing, _))) => Style::new().bg(Color::Indexed(thing)).fg(Color::Indexed(16)).add_modifier(Modifier::BOLD),
            (Self::Sixteen, Some((_, _, nearest))) => Style::new().bg(nearest).fg(Color::Black).add_modifier(Modifier::BOLD),
            _ => Style::new().add_modifier(Modifier::BOLD | Modifier::UNDERLINED),
        }
    }

    /// The robot.
    pub fn robot(self) -> Style {
        match self {
            Self::Many => Style::new().bg(Color::Indexed(231)).fg(Color::Indexed(16)).add_modifier(Modifier::BOLD),
            Self::Sixteen => Style::new().bg(Color::White).fg(Color::Black).add_modifier(Modifier::BOLD),
            Self::None => Style::new().add_modifier(Modifier::REVERSED | Modifier::BOLD),
        }
    }

    /// A wall.
    pub fn wall(self) -> Style {
        self.ink(Color::Indexed(244), Color::Gray)
    }

    /// Text of little importance.
    pub fn quiet(self) -> Style {
        match self {
            Self::Many => Style::new().fg(Color::Indexed(246)),
            Self::Sixteen => Style::new(),
            Self::None => Style::new().add_modifier(Modifier::DIM),
        }
    }

    /// Text to look at first.
    pub fn strong(self) -> Style {
        self.ink(Color::Indexed(222), Color::Yellow).add_modifier(Modifier::BOLD)
    }

    /// Support, and praise.
    pub fn good(self) -> Style {
        self.ink(Color::Indexed(114), Color::Green)
    }

    /// Counter-evidence, and blame.
    pub fn bad(self) -> Style {
        self.ink(Color::Indexed(210), Color::Red)
    }

    /// The title line.
    pub fn title(self) -> Style {
        match self {
            Self::Many => Style::new().bg(Color::Indexed(237)).fg(Color::Indexed(255)),
            Self::Sixteen | Self::None => Style::new().add_modifier(Modifier::REVERSED),
        }
    }

    fn ink(self, many: Color, sixteen: Color) -> Style {
        match self {
            Self::Many => Style::new().fg(many),
            Self::Sixteen => Style::new().fg(sixteen),
            Self::None => Style::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_colours_no_style_has_one() {
        let plain = Palette::None;
        for style in
            [plain.floor("red"), plain.block("red"), plain.robot(), plain.wall(), plain.quiet(), plain.strong(), plain.good(), plain.bad()]
        {
            assert_eq!((style.fg, style.bg), (None, None));
        }
    }
}
