//! Ways to turn, mirror, shift and scale a drawing, and to cut its periods elsewhere.

use meniscus_core::math::Vec2;

/// Exchange of both axes, then mirroring along each, then a shift in boxes and a scale.
#[derive(Debug, Clone, Copy)]
pub struct Motion {
    pub name: &'static str,
    pub exchanges: bool,
    pub mirrors: [bool; 2],
    pub scale: f64,
    pub shift: [f64; 2],
    /// Where periods are cut, as a share of them.
    pub cut: f64,
}

pub const STILL: Motion =
    Motion { name: "still", exchanges: false, mirrors: [false; 2], scale: 1.0, shift: [0.0; 2], cut: 0.0 };

pub const MOTIONS: [Motion; 10] = [
    Motion { name: "transposed", exchanges: true, ..STILL },
    Motion { name: "mirrored in x", mirrors: [true, false], ..STILL },
    Motion { name: "mirrored in y", mirrors: [false, true], ..STILL },
    Motion { name: "turned by 90 degrees", exchanges: true, mirrors: [true, false], ..STILL },
    Motion { name: "turned by 180 degrees", mirrors: [true, true], ..STILL },
    Motion { name: "turned by 270 degrees", exchanges: true, mirrors: [false, true], ..STILL },
    Motion { name: "shifted", shift: [0.371, -1.83], ..STILL },
    Motion { name: "scaled", scale: 3.7e-5, ..STILL },
    Motion { name: "cut elsewhere", cut: 0.62, ..STILL },
    Motion {
        name: "turned, shifted and scaled",
        exchanges: true,
        mirrors: [true, false],
        scale: 177.0,
        shift: [-2.1, 0.3],
        cut: 0.0,
    },
];

impl Motion {
    pub fn point(&self, size: [f64; 2], [x, y]: [f64; 2]) -> [f64; 2] {
        let turned = if self.exchanges { [y, x] } else { [x, y] };
        let box_size = self.size(size);
        [0, 1].map(|i| {
            let here = if self.mirrors[i] { box_size[i] - turned[i] } else { turned[i] };
            self.scale * (here + self.shift[i] * box_size[i])
        })
    }

    /// The size of the box before it is scaled.
    pub fn size(&self, size: [f64; 2]) -> [f64; 2] {
        if self.exchanges { [size[1], size[0]] } else { size }
    }

    pub fn back(&self, size: [f64; 2], x: Vec2) -> Vec2 {
        let box_size = self.size(size);
        let here = [0, 1].map(|i| {
            let at = x[i] / self.scale - self.shift[i] * box_size[i];
            if self.mirrors[i] { box_size[i] - at } else { at }
        });
        if self.exchanges { Vec2::new(here[1], here[0]) } else { Vec2::new(here[0], here[1]) }
    }

    /// The number of a side (left, right, bottom, top).
    pub fn side(&self, side: usize) -> usize {
        let (axis, end) = (side / 2, side % 2);
        let axis = if self.exchanges { 1 - axis } else { axis };
        2 * axis + if self.mirrors[axis] { 1 - end } else { end }
    }

    pub fn is_mirror(&self) -> bool {
        self.exchanges ^ self.mirrors[0] ^ self.mirrors[1]
    }
}
