//! The distance constraint: a massless rod with a ball at either end.

crate::joint! {
    /// A massless rod between two balls: the point `tail` of `j` keeps its distance from the point
    /// `head` of `i`, that of the reference configuration if `length` is left out, and never zero.
    /// The spherical-spherical joint of Nikravesh 1988, section 7.3.1; the equation is the
    /// difference of squares (m^2).
    #[doc(alias("DistanceJoint", "Rod", "Rope"))]
    pub joint Distance(i, j; head: Point, tail: Point, length: Length = initial(length(j.tail - i.head))) {
        squared(j.tail - i.head) - length * length;
    }
}
