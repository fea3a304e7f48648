//! Integers and conditions that the macro can see: what names an element of an array, and what
//! tells elements apart.

use syn::{BinOp, Expr, ExprLit, Lit, UnOp};

use super::ungroup;

/// The value of an integer expression, by the arithmetic of integers: `7 / 2` is 3.
///
/// # Errors
/// A sentence at what is no integer, or at what leaves their range.
pub fn integer(expr: &Expr) -> syn::Result<i64> {
    let refuse = |message: &str| Err(syn::Error::new_spanned(expr, message));
    let found = match ungroup(expr) {
        Expr::Lit(ExprLit {
            lit: Lit::Int(literal),
            ..
        }) if matches!(literal.suffix(), "" | "usize") => Some(literal.base10_parse()?),
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
            integer(&unary.expr)?.checked_neg()
        }
        Expr::Binary(binary) => {
            let Some(operation) = operation(binary.op) else {
                return refuse(EXPECTED);
            };
            let (left, right) = (integer(&binary.left)?, integer(&binary.right)?);
            if right == 0 && matches!(binary.op, BinOp::Div(_) | BinOp::Rem(_)) {
                return refuse("an integer cannot be divided by 0");
            }
            operation(left, right)
        }
        _ => return refuse(EXPECTED),
    };
    match found {
        Some(value) => Ok(value),
        None => refuse("this integer is too large"),
    }
}

const EXPECTED: &str = "expected an integer that the macro can see: a literal, `+`, `-`, `*`, `/` and `%` of integers, and, in a field that is an \
     array, `k`";

type Operation = fn(i64, i64) -> Option<i64>;

fn operation(op: BinOp) -> Option<Operation> {
    Some(match op {
        BinOp::Add(_) => i64::checked_add,
        BinOp::Sub(_) => i64::checked_sub,
        BinOp::Mul(_) => i64::checked_mul,
        BinOp::Div(_) => i64::checked_div,
        BinOp::Rem(_) => i64::checked_rem,
        _ => return None,
    })
}

/// Whether a condition holds.
///
/// # Errors
/// A sentence at what is no condition.
pub fn condition(expr: &Expr) -> syn::Result<bool> {
    match ungroup(expr) {
        Expr::Unary(unary) if matches!(unary.op, UnOp::Not(_)) => Ok(!condition(&unary.expr)?),
        Expr::Binary(binary) => {
            if let Some(comparison) = comparison(binary.op) {
                return Ok(comparison(
                    &integer(&binary.left)?,
                    &integer(&binary.right)?,
                ));
            }
            match binary.op {
                BinOp::And(_) => Ok(condition(&binary.left)? && condition(&binary.right)?),
                BinOp::Or(_) => Ok(condition(&binary.left)? || condition(&binary.right)?),
                _ => Err(no_condition(expr)),
            }
        }
        _ => Err(no_condition(expr)),
    }
}

fn no_condition(expr: &Expr) -> syn::Error {
    syn::Error::new_spanned(
        expr,
        "expected a condition: a comparison of integers such as `k == 0` or `k % 2 == 0`, or some of them with `&&`, `||` and `!`",
    )
}

type Comparison = fn(&i64, &i64) -> bool;

fn comparison(op: BinOp) -> Option<Comparison> {
    Some(match op {
        BinOp::Eq(_) => i64::eq,
        BinOp::Ne(_) => i64::ne,
        BinOp::Lt(_) => i64::lt,
        BinOp::Le(_) => i64::le,
        BinOp::Gt(_) => i64::gt,
        BinOp::Ge(_) => i64::ge,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::{condition, integer};

    fn parsed(text: &str) -> syn::Expr {
        syn::parse_str(text).expect("an expression")
    }

    #[test]
    fn integers_are_divided_like_integers() {
        for (text, value) in [
            ("7 / 2", Some(3)),
            ("(3 + 15) % 16", Some(2)),
            ("-1 % 16", Some(-1)),
            ("2 * (4 - 1)", Some(6)),
            ("1 / 0", None),
            ("1 % 0", None),
            ("0.5", None),
            ("N - 1", None),
            ("9223372036854775807 + 1", None),
            ("9223372036854775808", None),
            ("2 ^ 3", None),
        ] {
            assert_eq!(integer(&parsed(text)).ok(), value, "{text}");
        }
    }

    #[test]
    fn conditions_compare_integers() {
        for (text, value) in [
            ("3 % 2 == 1", Some(true)),
            ("!(1 < 2) || 2 >= 2 && 1 != 1", Some(false)),
            ("1 <= 1", Some(true)),
            ("3 > 4", Some(false)),
            ("1", None),
            ("0.5 < 1", None),
            ("true", None),
        ] {
            assert_eq!(condition(&parsed(text)).ok(), value, "{text}");
        }
    }
}
