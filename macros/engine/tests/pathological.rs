//! Input that nobody writes by hand: too deep, too long, too large. It is refused in a sentence, or
//! handled in reasonable time; it never ends the compiler by an overflowing stack.

mod common;

use common::{HOIST, definition, delivery, delivery_of, tokens};
use holonom_engine::model::ElementKind;
use proc_macro2::TokenStream;
use quote::quote;

/// As large as the stack that threads of a program have, and a fourth of the compiler's.
const STACK: usize = 2 << 20;

fn with_small_stack(test: impl FnOnce() + Send + 'static) {
    let thread = std::thread::Builder::new().stack_size(STACK).spawn(test);
    let result = thread.expect("a thread").join();
    assert!(result.is_ok(), "the test in the thread fails");
}

fn joint(statements: &str) -> String {
    let text = format!(
        "pub joint Any(i, j; point: Point, axis: Axis, size: Length, law: Law(x)) {{ {statements} }}"
    );
    let tokens = tokens(&text);
    holonom_engine::joint(quote!([::holonom] #tokens)).to_string()
}

#[track_caller]
fn assert_refused(output: &str, words: &str) {
    let start: String = output.chars().take(400).collect();
    assert!(output.contains(words), "{start}");
    assert!(!output.contains("generator failed"), "{start}");
}

#[track_caller]
fn assert_read(statements: &str) {
    let output = joint(statements);
    let start: String = output.chars().take(400).collect();
    assert!(!output.contains("faulty"), "{start}");
    assert!(!output.contains("generator failed"), "{start}");
}

fn repeated(before: &str, times: usize, middle: &str, behind: &str) -> String {
    format!("{}{middle}{};", before.repeat(times), behind.repeat(times))
}

#[test]
fn deep_expressions() {
    with_small_stack(|| {
        for times in [400, 30_000] {
            for expression in [
                repeated("(", times, "dot(i.axis, j.axis)", ")"),
                repeated("sin(", times, "dot(i.axis, j.axis)", ")"),
                repeated("[", times, "i.axis", "]"),
                repeated("-", times, "dot(i.axis, j.axis)", ""),
                repeated("-!*&", times, "dot(i.axis, j.axis)", ""),
                repeated("", times, "dot(i.axis, j.axis)", " + size"),
                repeated("", times, "dot(i.axis, j.axis)", " * size"),
                repeated("size = ", times, "dot(i.axis, j.axis)", ""),
                repeated("return ", times, "i.axis", ""),
                repeated("|x, y| ", times, "i.axis", ""),
                repeated("A<B, ", times, "i.axis", ""),
                repeated("", times, "i.axis", ".normal()"),
                repeated("", times, "i", ".axis"),
                repeated("", times, "law", "(size)"),
                repeated("if size {", times, "size", "} else { size }"),
                repeated("", times, "i.axis as A", " as A"),
                repeated("{ size; ", times, "i.axis", "}"),
                repeated("#[a] -", times, "i.axis", ""),
            ] {
                assert_refused(&joint(&expression), "operators deep");
            }
        }
        assert_read(&repeated("(", 30, "dot(i.axis, j.axis)", ")"));
        assert_read(&repeated("sin(", 30, "dot(i.axis, j.axis)", ")"));
        assert_read(&repeated("-", 250, "dot(i.axis, j.axis)", ""));
        assert_read(&repeated("", 250, "dot(i.axis, j.axis)", " + size"));
        assert_read(&repeated("", 30, "dot(i.axis, j.axis)", " * size"));
        assert_refused(
            &joint(&repeated("", 250, "dot(i.axis, j.axis)", " * size")),
            "too large",
        );
    });
}

#[test]
fn deep_items() {
    with_small_stack(|| {
        for times in [600, 30_000] {
            let many = |text: &str| text.repeat(times);
            for item in [
                format!("struct A {{ #[body(mass = {}1)] b: Body }}", many("-")),
                format!(
                    "struct A {{ #[body(mass = {}1{})] b: Body }}",
                    many("("),
                    many(")")
                ),
                format!("struct A {{ #[body = {}1] b: Body }}", many("-")),
                format!("#[x = {}1] struct A {{ b: Body }}", many("-")),
                format!("struct A {{ b: {}Body{} }}", many("A<B, "), many(">")),
                format!("struct A {{ b: {}Body }}", many("&")),
                format!("struct A {{ b: {}Body }}", many("fn() -> ")),
                format!("struct A {{ b: {}Body{} }}", many("("), many(")")),
            ] {
                let item = tokens(&item);
                let derived = holonom_engine::derive(item.clone()).to_string();
                if derived.contains("compile_error") {
                    assert_refused(&derived, "operators deep");
                } else {
                    let assembled = holonom_engine::assemble(delivery(&item)).to_string();
                    assert_refused(&assembled, "operators deep");
                }
            }
            for definition in [
                format!("{} joint A(i) {{ i.origin; }}", many("#[x = -1]")),
                format!("#[x = {}1] joint A(i) {{ i.origin; }}", many("-")),
                format!("pub(in {}) joint A(i) {{ i.origin; }}", many("(")) + &many(")"),
                format!("joint A(i; a: Law({})) {{ i.origin; }}", many("a,")),
                format!("joint A(i; {}) {{ i.origin; }}", many("a: ")),
            ] {
                let definition: Result<TokenStream, _> = definition.parse();
                let Ok(definition) = definition else {
                    continue;
                };
                let output = holonom_engine::joint(quote!([::holonom] #definition)).to_string();
                assert!(!output.contains("generator failed"));
            }
        }
    });
}

#[test]
fn names_that_multiply() {
    with_small_stack(|| {
        let squares = |count: usize| {
            let squares = (0..count).map(|k| format!("let a{} = a{k} * a{k};", k + 1));
            let squares: String = squares.collect();
            format!("let a0 = dot(i.axis, j.axis); {squares} a{count};")
        };
        assert_read(&squares(6));
        assert_refused(&joint(&squares(60)), "too large");
        let sums = |count: usize| {
            let sums = (0..count).map(|k| format!("let a{} = a{k} + size;", k + 1));
            let sums: String = sums.collect();
            format!("let a0 = dot(i.axis, j.axis); {sums} a{count};")
        };
        assert_read(&sums(100));
        assert_refused(&joint(&sums(20_000)), "too large");
        let lengths = |count: usize| {
            let lengths =
                (0..count).map(|k| format!("let a{} = a{k} * length(a{k} * j.axis);", k + 1));
            let lengths: String = lengths.collect();
            format!("let a0 = dot(i.axis, j.axis); {lengths} a{count};")
        };
        assert_refused(&joint(&lengths(40)), "too large");
        assert_refused(&joint(&"dot(i.axis, j.axis);".repeat(20_000)), "too large");
    });
}

#[test]
fn extreme_numbers() {
    with_small_stack(|| {
        let digits = "9".repeat(100_000);
        for number in [
            "1e400",
            "1e-400",
            "1e99999999999999999999",
            "0x1p3",
            "1e41",
            &digits,
            "1f32",
            "1u8",
            "0b11",
        ] {
            let output = joint(&format!("dot(i.axis, j.axis) - {number};"));
            assert!(!output.contains("generator failed"), "{number:.20}");
        }
        assert_refused(
            &joint("dot(i.axis, j.axis) - 1e400;"),
            "a finite number is needed",
        );
        assert_refused(
            &joint(&format!("dot(i.axis, j.axis) - {digits};")),
            "digits",
        );
        assert_refused(
            &joint(&format!("dot(i.axis, j.axis) - {digits:.400};")),
            "a finite number is needed",
        );
        assert_refused(&joint("dot(i.axis, j.axis) - 1e-60;"), "has a size from");
    });
}

/// The hoist with another law of its driver, and another definition of its winch.
fn hoist(law: &str, row: &str) -> String {
    let written = "0.3 + size * sin(10.0 * time) + smooth_step(time / 2.0)";
    assert!(HOIST.contains(written), "the law stands in the data");
    let item = tokens(&HOIST.replace(written, law));
    let winch =
        format!("Winch(i, j; point: Point, axis: Axis, pitch: Length, motion: Law(x)) {{ {row} }}");
    let find = |name: &str| match name {
        "Winch" => Some((ElementKind::Joint, tokens(&winch))),
        _ => definition(name),
    };
    holonom_engine::assemble(delivery_of(&item, find)).to_string()
}

#[test]
fn laws_that_multiply() {
    with_small_stack(|| {
        let nested = |count: usize| repeated("motion(", count, "dot(i.axis, j.axis)", ")");
        let output = hoist("x * x + time", &nested(3));
        assert!(!output.contains("compile_error"), "three times is nothing");
        assert_refused(
            &hoist("x * x + time", &nested(30)),
            "joint `winch` is too large",
        );
        let long = format!("x{}", " + x".repeat(250));
        assert_refused(&hoist(&long, &nested(20)), "joint `winch` is too large");
        let law = format!("x{}", " + sin(time)".repeat(100_000));
        assert_refused(&hoist(&law, &nested(1)), "operators deep");
    });
}

/// A condition repeats the laws between which it chooses.
#[test]
fn conditions_that_multiply() {
    with_small_stack(|| {
        let rate = |groups: usize| {
            let condition = vec!["(time < 1.0 || time > 2.0)"; groups].join(" && ");
            let item = format!(
                "struct Any {{ #[state(rate = if {condition} {{ 1.0 }} else {{ 0.0 }})] value: f64, \
                 #[body(free, mass = 1.0)] stone: Particle }}"
            );
            holonom_engine::assemble(delivery(&tokens(&item))).to_string()
        };
        assert!(!rate(5).contains("too many alternatives"));
        assert_refused(&rate(30), "too many alternatives");
    });
}

/// What is just small enough is worked out.
#[test]
fn the_largest_definitions() {
    with_small_stack(|| {
        for row in [
            repeated("", 250, "dot(i.axis, j.axis)", " + pitch"),
            repeated("", 30, "dot(i.axis, j.axis)", " * dot(i.axis, j.point)"),
            repeated("sin(", 30, "dot(i.axis, j.axis)", ")"),
            repeated(
                "",
                130,
                "dot(i.axis, j.axis)",
                " + sin(dot(i.axis, j.point))",
            ),
            repeated("", 20, "dot(i.axis, j.axis)", " / dot(i.axis, j.point)"),
        ] {
            let output = hoist("x", &row);
            assert!(!output.contains("compile_error"), "{row:.80}");
        }
    });
}
