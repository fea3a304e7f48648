//! Parts of a body in numbers, and their sum.

/// A part of a body, in numbers.
pub(super) struct Lump {
    pub(super) mass: f64,
    pub(super) centre: [f64; 3],
    /// About its centre, in global axes.
    pub(super) tensor: [[f64; 3]; 3],
    /// Euler parameters from its axes to global axes.
    pub(super) axes: [f64; 4],
}

impl Lump {
    pub(super) fn scale(&mut self, factor: f64) {
        self.mass *= factor;
        self.tensor = self.tensor.map(|row| row.map(|entry| factor * entry));
    }
}

/// The tensor of all about a point, by Steiner's theorem, in global axes.
pub(super) fn about(lumps: &[Lump], centre: [f64; 3]) -> [[f64; 3]; 3] {
    let mut tensor = [[0.0; 3]; 3];
    for lump in lumps {
        let s = [0, 1, 2].map(|k| lump.centre[k] - centre[k]);
        let square: f64 = s.iter().map(|s| s * s).sum();
        for (k, row) in tensor.iter_mut().enumerate() {
            for (l, entry) in row.iter_mut().enumerate() {
                let diagonal = if k == l { square } else { 0.0 };
                *entry += lump.tensor[k][l] + lump.mass * (diagonal - s[k] * s[l]);
            }
        }
    }
    tensor
}

/// A tensor in the axes of the columns of `a`; products of inertia that are round-off are zero.
pub(super) fn turned(tensor: [[f64; 3]; 3], a: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    const ROUND_OFF: f64 = 16.0 * f64::EPSILON;
    let entry = |k: usize, l: usize| -> f64 {
        let pairs = (0..3).flat_map(|m| (0..3).map(move |n| (m, n)));
        pairs.map(|(m, n)| a[m][k] * tensor[m][n] * a[n][l]).sum()
    };
    let mut turned = [0, 1, 2].map(|k| [0, 1, 2].map(|l| entry(k, l)));
    let largest = (0..3).fold(0.0_f64, |largest, k| largest.max(turned[k][k].abs()));
    for (k, l) in [(0, 1), (0, 2), (1, 2)] {
        let both = 0.5 * (turned[k][l] + turned[l][k]);
        let kept = if both.abs() > ROUND_OFF * largest {
            both
        } else {
            0.0
        };
        (turned[k][l], turned[l][k]) = (kept, kept);
    }
    turned
}

pub(super) fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

pub(super) fn unit(v: [f64; 3]) -> [f64; 3] {
    let norm = norm(v);
    v.map(|x| x / norm)
}

/// Where a shape or a body is: its centre of mass (m, global), and Euler parameters from its axes
/// to global axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) centre: [f64; 3],
    pub(super) axes: [f64; 4],
}

impl Frame {
    /// With Euler parameters of length 1.
    pub(super) fn unit(self) -> Self {
        let norm = self.axes.iter().map(|e| e * e).sum::<f64>().sqrt();
        let axes = self.axes.map(|e| e / norm);
        Self { axes, ..self }
    }
}
