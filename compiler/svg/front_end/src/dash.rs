// SPDX-License-Identifier: GPL-3.0-or-later
//! Dashing by arc length, in f64: on exact lengths for lines and circular arcs, by Gauss-Legendre quadrature for cubics.

use kurbo::{Point, Vec2};

use crate::budget::{Budget, Failure};
use crate::piece::Piece;

/// A connected part of a stroke.
pub enum Run {
    Pieces {
        pieces: Vec<Piece>,
        closed: bool,
    },
    /// A dash (or subpath) of length zero: caps only.
    Dot {
        at: Point,
        tangent: Vec2,
    },
}

/// More dashes than this in one subpath are not drawn one by one.
pub const MOST_DASHES: f64 = 100_000.0;

struct Cursor {
    index: usize,
    left: f64,
}

/// The interval at which the pattern starts, and what is left of it.
fn start_of(pattern: &[f64], offset: f64) -> Cursor {
    let total: f64 = pattern.iter().sum();
    let mut phase = offset.rem_euclid(total);
    for (index, gap) in pattern.iter().enumerate() {
        if phase > *gap || (phase == *gap && *gap != 0.0) {
            phase -= gap;
        } else {
            return Cursor { index, left: gap - phase };
        }
    }
    Cursor { index: 0, left: pattern[0] }
}

/// None when the pattern is too fine for the length of the subpath. `pattern` has an even number of entries, none
/// negative, with a positive sum.
pub fn dash(
    pieces: &[Piece],
    closed: bool,
    pattern: &[f64],
    offset: f64,
    accuracy: f64,
    budget: &mut Budget,
) -> Result<Option<Vec<Run>>, Failure> {
    let lengths: Vec<f64> = pieces.iter().map(|p| p.length(accuracy)).collect();
    let (whole, period) = (lengths.iter().sum::<f64>(), pattern.iter().sum::<f64>());
    if !(whole / period * pattern.len() as f64 <= MOST_DASHES) {
        return Ok(None);
    }
    let mut cursor = start_of(pattern, offset);
    let starts_on = cursor.index % 2 == 0;
    if starts_on && cursor.left >= whole {
        return Ok(Some(vec![Run::Pieces { pieces: pieces.to_vec(), closed }]));
    }
    let mut runs = Vec::new();
    let mut current: Vec<Piece> = Vec::new();
    for (piece, length) in pieces.iter().zip(&lengths) {
        let mut s = 0.0;
        while s < *length {
            budget.charge(1)?;
            let step = cursor.left.min(length - s);
            if cursor.index % 2 == 0 && step > 0.0 {
                current.push(piece.part(s, s + step, *length, accuracy));
            } else if cursor.index % 2 == 0 && cursor.left == 0.0 && current.is_empty() {
                let (at, tangent) = piece.at(s, *length, accuracy);
                runs.push(Run::Dot { at, tangent });
            }
            s += step;
            cursor.left -= step;
            if cursor.left <= 0.0 {
                flush(&mut current, &mut runs);
                cursor.index = (cursor.index + 1) % pattern.len();
                cursor.left = pattern[cursor.index];
            }
        }
    }
    join_ends(current, closed && starts_on, &mut runs);
    Ok(Some(runs))
}

fn flush(current: &mut Vec<Piece>, runs: &mut Vec<Run>) {
    if !current.is_empty() {
        runs.push(Run::Pieces { pieces: std::mem::take(current), closed: false });
    }
}

/// On a closed subpath a dash that runs through the start point is one dash with a join there.
fn join_ends(mut last: Vec<Piece>, wraps: bool, runs: &mut Vec<Run>) {
    if wraps && !last.is_empty() {
        if let Some(Run::Pieces { pieces, .. }) = runs.first_mut() {
            last.append(pieces);
            *pieces = last;
            return;
        }
    }
    flush(&mut last, runs);
}
