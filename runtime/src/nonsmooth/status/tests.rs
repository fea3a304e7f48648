//! What statuses remember of flights.

use super::*;

/// A flight from a gap that round-off has made may end together with another one, where it is not
/// the one that was found. It has not flown even so.
#[test]
fn what_does_not_rise_above_round_off_has_not_flown() {
    let floor = 1e-15;
    for is_found in [false, true] {
        let mut status = Status::<f64>::new();
        assert!(!status.has_not_flown(), "a run may begin within a flight");
        status.stand(-1e-12, floor);
        status.is_found = is_found;
        assert!(status.has_not_flown());
        status.reading = 1e-12;
        status.go_on();
        assert!(status.has_not_flown(), "it was as far below");
        status.reading = 1e-9;
        status.go_on();
        assert!(!status.has_not_flown());
    }
}
