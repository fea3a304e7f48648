//! Pages as the viewer reads them.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use holonom::nalgebra::{Quaternion, UnitQuaternion, Vector3};
use serde_json::Value;

/// The data of a page, and the poses in it.
pub(crate) struct Page {
    pub(crate) data: Value,
    poses: Vec<f64>,
}

impl Page {
    pub(crate) fn new(page: &str) -> Self {
        let (_, behind) = page
            .split_once("<script type=\"application/json\" id=\"film\">")
            .expect("a place for data");
        let (data, _) = behind.split_once("</script>").expect("it ends");
        let data: Value = serde_json::from_str(data).expect("JSON");
        let bytes = STANDARD.decode(data["poses"].as_str().expect("text"));
        let bytes = bytes.expect("base 64");
        let numbers = bytes.chunks_exact(4);
        let numbers = numbers.map(|bytes| f32::from_le_bytes(bytes.try_into().expect("four")));
        Self {
            poses: numbers.map(f64::from).collect(),
            data,
        }
    }

    pub(crate) fn frames(&self) -> usize {
        self.data["times"].as_array().expect("times").len()
    }

    pub(crate) fn list(&self, name: &str) -> &[Value] {
        self.data[name].as_array().expect(name)
    }

    /// A vector of a wheel or marker, as far as directions go and as a point, in global axes.
    pub(crate) fn global(
        &self,
        frame: usize,
        of: &Value,
        key: &str,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let at = vector(&of[key]);
        let Some(body) = of["body"].as_u64() else {
            return (at, at);
        };
        let bodies = self.list("bodies").len();
        let pose = &self.poses[(frame * bodies + body as usize) * 7..];
        let turn = Quaternion::new(pose[3], pose[4], pose[5], pose[6]);
        let along = UnitQuaternion::new_normalize(turn) * at;
        (along, Vector3::new(pose[0], pose[1], pose[2]) + along)
    }
}

pub(crate) fn vector(value: &Value) -> Vector3<f64> {
    let number = |k: usize| value[k].as_f64().expect("a number");
    Vector3::new(number(0), number(1), number(2))
}
