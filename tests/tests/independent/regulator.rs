//! The regulator of the example, against SciPy: `regulator.py`.

use nalgebra::{Matrix4, RowVector4, Vector4};

#[path = "../../../runtime/examples/lqr.rs"]
#[allow(dead_code, unreachable_pub, reason = "it is a program of its own")]
mod lqr;

#[test]
fn the_gain_is_that_of_scipy() -> Result<(), holonom::Fault> {
    let ((a, b), k) = (lqr::model()?, lqr::regulator()?);
    let wanted = Matrix4::new(
        1.0,
        7.007159223841821e-7,
        0.001,
        2.335717559053314e-10, //
        0.0,
        1.0000140143184477,
        0.0,
        0.0010000046714351183, //
        0.0,
        0.0014014351181112154,
        1.0,
        7.007159223841821e-7, //
        0.0,
        0.028028702362224316,
        0.0,
        1.0000140143184477,
    );
    assert!((a - wanted).amax() < 1e-15, "{a}");
    let wanted = Vector4::new(
        4.761906152212183e-7,
        1.1904789710910337e-6,
        0.0009523815085041807,
        0.0023809635034169486,
    );
    assert!((b - wanted).amax() < 1e-17, "{b}");
    let wanted = RowVector4::new(
        -9.902763359691615,
        69.87718378965562,
        -11.274560968287092,
        12.670892889129544,
    );
    assert!((k - wanted).amax() < 1e-7, "{k}");
    Ok(())
}
