//! Joints made by a macro of one's own, two of them equal to the letter.

macro_rules! rope {
    ($(#[$attribute:meta])* $name:ident) => {
        mech::joint! {
            $(#[$attribute])*
            pub joint $name(i, j; from: Point, to: Point, length: Length) {
                squared(j.to - i.from) - length * length;
            }
        }
    };
}

rope! {
    /// A taut rope.
    Rope
}

/// Equal joints in two modules do not meet.
pub mod spare {
    rope! {
        /// A taut rope.
        Rope
    }
}
