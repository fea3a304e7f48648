//! Refusals, word for word.

#[test]
fn refusals() {
    let cases = trybuild::TestCases::new();
    for feature in [
        "array",
        "body",
        "definition",
        "force",
        "joint",
        "kernels",
        "law",
        "mechanism",
        "part",
        "state",
        "types",
        "urdf",
    ] {
        cases.compile_fail(format!("tests/ui/{feature}/*.rs"));
    }
}
