//! SVG pictures: a white canvas, text, and the colours that all pictures share.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::error::Error;

/// Text.
pub const INK: RGBColor = RGBColor(34, 34, 34);
/// The background of bars and empty boxes.
pub const PALE: RGBColor = RGBColor(245, 245, 242);
/// The first kind of data.
pub const BLUE: RGBColor = RGBColor(94, 129, 172);
/// The second kind of data.
pub const GREEN: RGBColor = RGBColor(76, 140, 86);

/// The canvas.
pub type Canvas<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// The result of drawing.
pub type Drawn = Result<(), Box<dyn Error>>;

/// A picture of this width and height, in pixels.
///
/// # Errors
/// The drawing error.
pub fn draw(size: (u32, u32), content: impl FnOnce(&Canvas<'_>) -> Drawn) -> Result<String, Box<dyn Error>> {
    let mut svg = String::new();
    {
        let canvas = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        canvas.fill(&WHITE)?;
        content(&canvas)?;
        canvas.present()?;
    }
    Ok(svg)
}

/// Writes text, with its vertical middle at a point.
///
/// # Errors
/// The drawing error.
pub fn write(canvas: &Canvas<'_>, text: &str, at: (i32, i32), size: i32, side: HPos, ink: RGBColor) -> Drawn {
    let style = ("sans-serif", size).into_font().color(&ink).pos(Pos::new(side, VPos::Center));
    Ok(canvas.draw(&Text::new(text.to_owned(), at, style))?)
}
