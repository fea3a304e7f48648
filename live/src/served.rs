//! A session as a page calls it: texts and numbers.

use std::fmt::Write as _;

use holonom::dynamics::Solvable;
use holonom::run::Steps;
use holonom::{BodyHandle, Mechanism, MechanismExt as _};
use holonom_live_border as border;

use crate::session::Session;

impl<M, P, K> border::Session for Session<M, P, K>
where
    M: Mechanism,
    P: Solvable<Number = f64, Mechanism = M, Forces: Clone>,
    K: Steps<P> + Copy,
{
    fn controls(&self) -> String {
        let mut text = format!("{{\"step\":{:?},\"sliders\":[", self.step());
        for (place, (slider, [low, high])) in self.sliders().enumerate() {
            let comma = if place > 0 { "," } else { "" };
            let _ = write!(
                text,
                "{comma}{{\"name\":{},\"unit\":{},\"group\":\"{}\",\"low\":{low:?},\"high\":{high:?}}}",
                quoted(&slider.name),
                quoted(&slider.unit),
                slider.moves.group()
            );
        }
        text.push_str("]}");
        text
    }

    fn scene(&self) -> Result<String, String> {
        self.drawn().data().map_err(|error| error.to_string())
    }

    fn set(&mut self, control: usize, value: f64) -> Result<(), String> {
        let moved = Self::set(self, control, value);
        moved.map_err(|refused| refused.to_string())
    }

    fn restart(&mut self) -> Result<(), String> {
        Self::restart(self).map_err(|refused| refused.to_string())
    }

    fn advance(&mut self, steps: usize) -> Result<(), String> {
        Self::advance(self, steps).map_err(|fault| fault.to_string())
    }

    /// The time (s), the estimate of the error, the values of the sliders, of each body position
    /// (m) and Euler parameters, the scalar first, and the readings.
    fn numbers(&self, numbers: &mut Vec<f64>) {
        numbers.extend([self.time(), self.error()]);
        numbers.extend(self.values());
        let bodies = self.bodies();
        for body in 0..M::REPORT.bodies.len() {
            let pose = M::pose::<f64>(&bodies, BodyHandle::new(body));
            let [x, y, z] = pose.position.into();
            let [i, j, k, w] = pose.orientation.coords.into();
            numbers.extend([x, y, z, w, i, j, k]);
        }
        numbers.extend(self.readings());
    }
}

/// A text in JSON.
fn quoted(text: &str) -> String {
    let mut quoted = String::from('"');
    for character in text.chars() {
        match character {
            '"' | '\\' => quoted.extend(['\\', character]),
            '\0'..='\x1f' => {
                let _ = write!(quoted, "\\u{:04x}", u32::from(character));
            }
            _ => quoted.push(character),
        }
    }
    quoted.push('"');
    quoted
}
