//! What functions in C call beside those of `math.h`: the operations of a `Scalar`, to the last
//! bit.

use holonom::mechanism::{QUARTER_OF_DOUBLE, QUARTER_OF_SINGLE, TURN_OF_DOUBLE, TURN_OF_SINGLE};

use super::Text;
use super::body::number;

/// A function beside those of the program. The order is that in which they are written: a turn
/// needs others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) enum Support {
    Fused,
    SquareRoot,
    Magnitude,
    Least,
    Sine,
    Cosine,
    Exponential,
    Angle,
    Rounding,
    Resolution,
    Turn,
    Turns,
}

impl Support {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Fused => "fused",
            Self::SquareRoot => "sqrt",
            Self::Magnitude => "fabs",
            Self::Least => "least",
            Self::Sine => "sin",
            Self::Cosine => "cos",
            Self::Exponential => "exp",
            Self::Angle => "atan2",
            Self::Rounding => "round",
            Self::Resolution => "ulp",
            Self::Turn => "turn",
            Self::Turns => "turns",
        }
    }

    /// The others that it calls.
    pub(super) fn calls(self) -> &'static [Self] {
        match self {
            Self::Turn => &[Self::Fused, Self::Magnitude, Self::Sine, Self::Cosine],
            Self::Turns => &[
                Self::Fused,
                Self::Magnitude,
                Self::Sine,
                Self::Cosine,
                Self::Turn,
            ],
            _ => &[],
        }
    }

    /// The function.
    pub(super) fn written(self, text: &Text) -> String {
        let (n, u, real) = (&text.name, &text.upper, text.real());
        let of_math = |name: &str| {
            format!(
                "static {u}_FUNCTION {real} {n}_{name}({real} x)\n{{\n    return sizeof(x) == sizeof(float) ? ({real}){name}f((float)x) : ({real}){name}((double)x);\n}}\n"
            )
        };
        match self {
            Self::Fused => format!(
                "\
/* a b + c: rounded once where the processor does that, as in Rust. */
static {u}_FUNCTION {real} {n}_fused({real} a, {real} b, {real} c)
{{
#if defined(__FMA__) || defined(__aarch64__) || defined(__CUDA_ARCH__) || defined(__HIP_DEVICE_COMPILE__)
    return sizeof(a) == sizeof(float) ? ({real})fmaf((float)a, (float)b, (float)c)
                                      : ({real})fma((double)a, (double)b, (double)c);
#else
    return a * b + c;
#endif
}}
"
            ),
            Self::Least => format!(
                "\
/* The lesser of two numbers; NaN if either is. */
static {u}_FUNCTION {real} {n}_least({real} a, {real} b)
{{
    return a < b || a != a ? a : b;
}}
"
            ),
            Self::Angle => format!(
                "\
static {u}_FUNCTION {real} {n}_atan2({real} y, {real} x)
{{
    return sizeof(y) == sizeof(float) ? ({real})atan2f((float)y, (float)x)
                                      : ({real})atan2((double)y, (double)x);
}}
"
            ),
            Self::Resolution => format!(
                "\
/* The distance from |x| to the next larger number. */
static {u}_FUNCTION {real} {n}_ulp({real} x)
{{
    return sizeof(x) == sizeof(float)
               ? ({real})(nextafterf(fabsf((float)x), (float)HUGE_VAL) - fabsf((float)x))
               : ({real})(nextafter(fabs((double)x), HUGE_VAL) - fabs((double)x));
}}
"
            ),
            Self::Turn => turn(text),
            Self::Turns => turns(text),
            _ => of_math(self.name()),
        }
    }
}

/// Sine and versine of an angle, by the polynomials of `f64` or of `f32`.
fn turn(text: &Text) -> String {
    let (n, u, real) = (&text.name, &text.upper, text.real());
    let c = number;
    // As `math/versine.rs` of `holonom` has them.
    let polynomials = if text.is_single {
        let three = |[a, b, d]: [f64; 3]| {
            format!(
                "{n}_fused({}, fourth, {n}_fused({}, square, {}))",
                c(d),
                c(b),
                c(a)
            )
        };
        TURN_OF_SINGLE.map(three)
    } else {
        let pair = |even: f64, odd: f64| format!("{n}_fused({}, square, {})", c(odd), c(even));
        let six = |[a, b, d, e, f, g]: [f64; 6]| {
            format!(
                "{n}_fused({n}_fused({}, fourth, {}), fourth,\n        {})",
                pair(f, g),
                pair(d, e),
                pair(a, b)
            )
        };
        TURN_OF_DOUBLE.map(six)
    };
    let [of_sine, of_versine] = polynomials;
    let ([first, second, third], some, whole) = if text.is_single {
        let parts = QUARTER_OF_SINGLE.map(f64::from);
        (parts, 190.0, 1.5 / f64::from(f32::EPSILON))
    } else {
        let parts = QUARTER_OF_DOUBLE;
        (parts, 12_000.0, 1.5 / f64::EPSILON)
    };
    let [first, second, third] = [first, second, third].map(c);
    let (small, some, whole) = (c(0.9), c(some), c(whole));
    let (half, one, two) = (c(0.5), c(1.0), c(2.0));
    let per_quarter = c(std::f64::consts::FRAC_2_PI);
    format!(
        "\
/* Sine and versine, 1 - cos, of an angle (rad) below 0.9. */
static {u}_FUNCTION void {n}_small_turn({real} x, {real} *sine, {real} *versine)
{{
    const {real} square = x * x;
    const {real} fourth = square * square;
    *sine = {n}_fused(
        {of_sine}, square * x, x);
    *versine = {n}_fused(
        {of_versine}, fourth, {half} * square);
}}

/* The same of any angle. */
static {u}_FUNCTION void {n}_turn({real} angle, {real} *sine, {real} *versine)
{{
    const {real} sum = angle * {per_quarter} + {whole};
    const int is_small = {n}_fabs(angle) < {small};
    const {real} quarters = is_small ? {zero} : sum - {whole};
    const {real} rest = angle - quarters * {first};
    const {real} near = rest - quarters * {second};
    const {real} lost = (rest - near) - quarters * {second} - quarters * {third};
    const {real} x = is_small ? angle : near + lost;
    {real} s, v;
    int place;
    {n}_small_turn(x, &s, &v);
    if (!({n}_fabs(angle) < {some})) {{
        /* By functions of half the angle: what is lost of quarters is too much. */
        const {real} h = {n}_sin({half} * angle);
        *sine = (h + h) * {n}_cos({half} * angle);
        *versine = (h + h) * h;
        return;
    }}
    place = (int)quarters & 3;
    *sine = (place & 1) == 0 ? s : {one} - v;
    *sine = (place & 2) == 0 ? *sine : -*sine;
    *versine = (place & 1) == 0 ? ((place & 2) == 0 ? v : {two} - v)
                                : {one} + ((place & 2) == 0 ? s : -s);
}}
",
        zero = c(0.0),
    )
}

/// Turns by several angles: the same numbers, whether all are small or not.
fn turns(text: &Text) -> String {
    let (n, u, real) = (&text.name, &text.upper, text.real());
    let shortcut = if text.has_branches {
        format!(
            "    int is_small = 1;
    for (k = 0; k < count; k++) {{
        is_small &= {n}_fabs(angles[k]) < {small};
    }}
    if (is_small) {{
        for (k = 0; k < count; k++) {{
            {n}_small_turn(angles[k], &sines[k], &versines[k]);
        }}
        return;
    }}
",
            small = number(0.9)
        )
    } else {
        String::new()
    };
    format!(
        "\
/* Sines and versines of some angles (rad): the same numbers, whether all are small or not. */
static {u}_FUNCTION void {n}_turns(int count, const {real} *angles, {real} *sines, {real} *versines)
{{
    int k;
{shortcut}    for (k = 0; k < count; k++) {{
        {n}_turn(angles[k], &sines[k], &versines[k]);
    }}
}}
"
    )
}
