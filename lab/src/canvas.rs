//! SVG pictures: a white canvas, text, and the colours that all pictures share.

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
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
/// A chart on it.
pub type Chart<'c, 'a> = ChartContext<'c, SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;
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

/// A chart with numbered axes: a caption above, what the axes are, and their ranges.
///
/// # Errors
/// The drawing error.
pub fn chart<'a, 'c>(canvas: &'c Canvas<'a>, caption: &str, [across, up]: [(&str, f64); 2]) -> Result<Chart<'c, 'a>, Box<dyn Error>> {
    let mut chart = ChartBuilder::on(canvas)
        .caption(caption, ("sans-serif", 18))
        .margin(16)
        .x_label_area_size(44)
        .y_label_area_size(56)
        .build_cartesian_2d(0.0..across.1, 0.0..up.1)?;
    chart.configure_mesh().x_desc(across.0).y_desc(up.0).draw()?;
    Ok(chart)
}
