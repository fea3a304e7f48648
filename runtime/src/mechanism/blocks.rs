//! Products with a Jacobian that is given by blocks.

use crate::math::scalar::Scalar;
use crate::mechanism::report::Block;

/// Adds `D d` to a sum.
pub(crate) fn add_product<S: Scalar>(blocks: &[Block], jacobian: &[S], step: &[S], sum: &mut [S]) {
    for block in blocks {
        let values = jacobian.get(block.offset..).unwrap_or(&[]);
        let rows = values.chunks(block.columns.max(1)).take(block.rows);
        for (sum, row) in sum.iter_mut().skip(block.row).zip(rows) {
            let pairs = row.iter().zip(step.iter().skip(block.column));
            *sum = pairs.fold(*sum, |sum, (&value, &d)| value.fused(d, sum));
        }
    }
}

/// Adds `D^T lambda` to a sum.
pub(crate) fn add_loads<S: Scalar>(blocks: &[Block], jacobian: &[S], lambda: &[S], sum: &mut [S]) {
    for block in blocks {
        let values = jacobian.get(block.offset..).unwrap_or(&[]);
        let rows = values.chunks(block.columns.max(1)).take(block.rows);
        for (row, &lambda) in rows.zip(lambda.iter().skip(block.row)) {
            let elements = sum.iter_mut().skip(block.column);
            for (element, &value) in elements.zip(row) {
                *element = value.fused(lambda, *element);
            }
        }
    }
}
