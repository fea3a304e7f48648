//! More kinds than the compiler expands within each other.

use holonom::prelude::*;

/// Forces of a hundred and more kinds, and a mechanism that has them all.
macro_rules! pushed {
    ($(#[$attribute:meta])* $mechanism:ident: $($kind:ident $field:ident)*) => {
        $(holonom::force! {
            force $kind(i; thrust: Vector) {
                force i.thrust at i.origin;
            }
        })*
        #[derive(Mechanism)]
        $(#[$attribute])*
        struct $mechanism {
            #[body(mass = 1.0, free)]
            bead: Particle,
            $(
                #[force(between = [bead], thrust = [0.0, 0.0, 0.0])]
                $field: $kind,
            )*
        }
    };
}

pushed! {
    Many:
    A0 a0 A1 a1 A2 a2 A3 a3 A4 a4 A5 a5 A6 a6 A7 a7 A8 a8 A9 a9
    B0 b0 B1 b1 B2 b2 B3 b3 B4 b4 B5 b5 B6 b6 B7 b7 B8 b8 B9 b9
    C0 c0 C1 c1 C2 c2 C3 c3 C4 c4 C5 c5 C6 c6 C7 c7 C8 c8 C9 c9
    D0 d0 D1 d1 D2 d2 D3 d3 D4 d4 D5 d5 D6 d6 D7 d7 D8 d8 D9 d9
    E0 e0 E1 e1 E2 e2 E3 e3 E4 e4 E5 e5 E6 e6 E7 e7 E8 e8 E9 e9
    F0 f0 F1 f1 F2 f2 F3 f3 F4 f4 F5 f5 F6 f6 F7 f7 F8 f8 F9 f9
    G0 g0 G1 g1 G2 g2 G3 g3 G4 g4 G5 g5 G6 g6 G7 g7 G8 g8 G9 g9
    H0 h0 H1 h1 H2 h2 H3 h3 H4 h4 H5 h5 H6 h6 H7 h7 H8 h8 H9 h9
    I0 i0 I1 i1 I2 i2 I3 i3 I4 i4 I5 i5 I6 i6 I7 i7 I8 i8 I9 i9
    J0 j0 J1 j1 J2 j2 J3 j3 J4 j4 J5 j5 J6 j6 J7 j7 J8 j8 J9 j9
}

#[derive(Mechanism)]
#[mechanism(recursion_limit = "256")]
struct Text {
    #[body(mass = 1.0, free)]
    bead: Particle,
}

fn main() {
    // What is refused has handles and kernels all the same, as far as the compiler is concerned.
    let _ = Many::HANDLES.bead;
}
