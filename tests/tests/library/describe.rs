//! One element of the library among bodies, as a mechanism: with run-time values everywhere, or
//! with literals everywhere.

/// Whether axes become known at run time.
macro_rules! late {
    (param) => {
        true
    };
    (literal) => {
        false
    };
}

/// A function from [`Data`](crate::data::Data) to the kernels of a mechanism with one joint or
/// force.
///
/// `describe! { param [i j] [i, j] joint Revolute { point = head, axis = a } }`: the mode; the
/// bodies that move, `bead` for a particle; what the element is between; the element with its
/// attributes. In these a word stands for one of the data: as parameters in the mode `param`, as
/// the numbers of [`LITERAL`](crate::data::LITERAL) in the mode `literal`.
macro_rules! describe {
    (@words param $done:tt [$key:ident = head, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done param $done [$key = [hx, hy, hz],] [$($rest)*] $($then)* }
    };
    (@words param $done:tt [$key:ident = centre, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done param $done [$key = [kx, ky, kz],] [$($rest)*] $($then)* }
    };
    (@words param $done:tt [$key:ident = tail, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done param $done [$key = [tx, ty, tz],] [$($rest)*] $($then)* }
    };
    (@words param $done:tt [$key:ident = a, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done param $done [$key = [ax, ay, az],] [$($rest)*] $($then)* }
    };
    (@words param $done:tt [$key:ident = b, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done param $done [$key = [bx, by, bz],] [$($rest)*] $($then)* }
    };
    (@words param $done:tt [$key:ident = number, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done param $done [$key = n,] [$($rest)*] $($then)* }
    };
    (@words param $done:tt [$key:ident = arm, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done param $done [$key = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx],] [$($rest)*] $($then)* }
    };
    (@words param $done:tt [$key:ident = across, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done param $done [
            $key = [hx + (ay * bz - az * by), hy + (az * bx - ax * bz), hz + (ax * by - ay * bx)],
        ] [$($rest)*] $($then)* }
    };
    (@words param $done:tt [$key:ident = beyond, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done param $done [$key = [hx + n * ax, hy + n * ay, hz + n * az],] [$($rest)*] $($then)* }
    };
    (@words param $done:tt [$key:ident = sine, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done param $done [$key = 0.3 * sin(n * time),] [$($rest)*] $($then)* }
    };
    (@words param $done:tt [$key:ident = stretch, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done param $done [$key = sqrt(
            (tx - hx) * (tx - hx) + (ty - hy) * (ty - hy) + (tz - hz) * (tz - hz)
        ) + 0.3 * sin(n * time),] [$($rest)*] $($then)* }
    };
    (@words literal $done:tt [$key:ident = head, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done literal $done [$key = [0.3, -0.2, 0.4],] [$($rest)*] $($then)* }
    };
    (@words literal $done:tt [$key:ident = centre, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done literal $done [$key = [0.2, -0.5, 0.1],] [$($rest)*] $($then)* }
    };
    (@words literal $done:tt [$key:ident = tail, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done literal $done [$key = [0.7, 0.5, -0.6],] [$($rest)*] $($then)* }
    };
    (@words literal $done:tt [$key:ident = a, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done literal $done [$key = [0.5, 1.0, -0.25],] [$($rest)*] $($then)* }
    };
    (@words literal $done:tt [$key:ident = b, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done literal $done [$key = [0.75, 0.5, 0.5],] [$($rest)*] $($then)* }
    };
    (@words literal $done:tt [$key:ident = number, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done literal $done [$key = 0.8,] [$($rest)*] $($then)* }
    };
    (@words literal $done:tt [$key:ident = arm, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done literal $done [$key = [0.625, -0.4375, -0.5],] [$($rest)*] $($then)* }
    };
    (@words literal $done:tt [$key:ident = across, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done literal $done [$key = [0.925, -0.6375, -0.1],] [$($rest)*] $($then)* }
    };
    (@words literal $done:tt [$key:ident = beyond, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done literal $done [$key = [0.7, 0.6, 0.2],] [$($rest)*] $($then)* }
    };
    (@words literal $done:tt [$key:ident = sine, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done literal $done [$key = 0.3 * sin(0.8 * time),] [$($rest)*] $($then)* }
    };
    (@words literal $done:tt [$key:ident = stretch, $($rest:tt)*] $($then:tt)*) => {
        describe! { @done literal $done [$key = sqrt(1.65) + 0.3 * sin(0.8 * time),] [$($rest)*] $($then)* }
    };
    // Whatever else stands there is the language's own.
    (@words $mode:ident $done:tt [$key:ident = ($($value:tt)*), $($rest:tt)*] $($then:tt)*) => {
        describe! { @done $mode $done [$key = $($value)*,] [$($rest)*] $($then)* }
    };
    (@words $mode:ident $done:tt [] $bodies:tt $($then:tt)*) => {
        describe! { @bodies $mode [] $bodies $done $($then)* }
    };
    (@done $mode:ident [$($done:tt)*] [$($more:tt)*] $($then:tt)*) => {
        describe! { @words $mode [$($done)* $($more)*] $($then)* }
    };

    (@bodies param [$($done:tt)*] [i $($rest:tt)*] $($then:tt)*) => {
        describe! { @bodies param [
            $($done)*
            #[body(mass = 1.3, inertia = [0.2, 0.3, 0.25], position = [ix, iy, iz], orientation = [i0, i1, i2, i3])]
            i: Body,
        ] [$($rest)*] $($then)* }
    };
    (@bodies param [$($done:tt)*] [j $($rest:tt)*] $($then:tt)*) => {
        describe! { @bodies param [
            $($done)*
            #[body(mass = 0.7, inertia = [0.1, 0.15, 0.12], position = [jx, jy, jz], orientation = [j0, j1, j2, j3])]
            j: Body,
        ] [$($rest)*] $($then)* }
    };
    (@bodies param [$($done:tt)*] [k $($rest:tt)*] $($then:tt)*) => {
        describe! { @bodies param [
            $($done)*
            #[body(mass = 2.1, inertia = [0.4, 0.35, 0.5], position = [kx, ky, kz], orientation = [k0, k1, k2, k3])]
            k: Body,
        ] [$($rest)*] $($then)* }
    };
    (@bodies param [$($done:tt)*] [bead $($rest:tt)*] $($then:tt)*) => {
        describe! { @bodies param [
            $($done)*
            #[body(mass = 0.9, position = [kx, ky, kz])]
            bead: Particle,
        ] [$($rest)*] $($then)* }
    };
    (@bodies literal [$($done:tt)*] [i $($rest:tt)*] $($then:tt)*) => {
        describe! { @bodies literal [
            $($done)*
            #[body(mass = 1.3, inertia = [0.2, 0.3, 0.25], position = [0.1, 0.2, -0.3], orientation = [0.5, -0.1, 0.7, 0.5])]
            i: Body,
        ] [$($rest)*] $($then)* }
    };
    (@bodies literal [$($done:tt)*] [j $($rest:tt)*] $($then:tt)*) => {
        describe! { @bodies literal [
            $($done)*
            #[body(mass = 0.7, inertia = [0.1, 0.15, 0.12], position = [-0.4, 0.3, 0.2], orientation = [0.1, 0.7, -0.5, 0.5])]
            j: Body,
        ] [$($rest)*] $($then)* }
    };
    (@bodies literal [$($done:tt)*] [k $($rest:tt)*] $($then:tt)*) => {
        describe! { @bodies literal [
            $($done)*
            #[body(mass = 2.1, inertia = [0.4, 0.35, 0.5], position = [0.2, -0.5, 0.1], orientation = [0.7, 0.1, 0.5, -0.5])]
            k: Body,
        ] [$($rest)*] $($then)* }
    };
    (@bodies literal [$($done:tt)*] [bead $($rest:tt)*] $($then:tt)*) => {
        describe! { @bodies literal [
            $($done)*
            #[body(mass = 0.9, position = [0.2, -0.5, 0.1])]
            bead: Particle,
        ] [$($rest)*] $($then)* }
    };
    (@bodies param [$($bodies:tt)*] [] [$($attributes:tt)*] $between:tt $attribute:ident $element:ident) => {
        |data: &crate::data::Data| {
            use holonom::prelude::*;

            #[derive(Debug, Mechanism)]
            #[mechanism(gravity = [gx, gy, gz])]
            struct Scene {
                #[param] gx: f64, #[param] gy: f64, #[param] gz: f64,
                #[param] ix: f64, #[param] iy: f64, #[param] iz: f64,
                #[param] i0: f64, #[param] i1: f64, #[param] i2: f64, #[param] i3: f64,
                #[param] jx: f64, #[param] jy: f64, #[param] jz: f64,
                #[param] j0: f64, #[param] j1: f64, #[param] j2: f64, #[param] j3: f64,
                #[param] kx: f64, #[param] ky: f64, #[param] kz: f64,
                #[param] k0: f64, #[param] k1: f64, #[param] k2: f64, #[param] k3: f64,
                #[param] hx: f64, #[param] hy: f64, #[param] hz: f64,
                #[param] tx: f64, #[param] ty: f64, #[param] tz: f64,
                #[param] ax: f64, #[param] ay: f64, #[param] az: f64,
                #[param] bx: f64, #[param] by: f64, #[param] bz: f64,
                #[param] n: f64,
                $($bodies)*
                #[$attribute(between = $between, $($attributes)*)]
                element: $element,
            }

            let [gx, gy, gz] = data.gravity;
            let [[ix, iy, iz], [jx, jy, jz], [kx, ky, kz]] = data.positions;
            let [[i0, i1, i2, i3], [j0, j1, j2, j3], [k0, k1, k2, k3]] = data.orientations;
            let [[hx, hy, hz], [tx, ty, tz]] = [data.head, data.tail];
            let [[ax, ay, az], [bx, by, bz]] = [data.a, data.b];
            let scene = Scene::new(
                gx, gy, gz, ix, iy, iz, i0, i1, i2, i3, jx, jy, jz, j0, j1, j2, j3, kx, ky, kz, k0, k1, k2, k3,
                hx, hy, hz, tx, ty, tz, ax, ay, az, bx, by, bz, data.number,
            );
            crate::kernels::boxed(&scene.expect("acceptable parameters"), Scene::HANDLES.element)
        }
    };
    (@bodies literal [$($bodies:tt)*] [] [$($attributes:tt)*] $between:tt $attribute:ident $element:ident) => {
        |_: &crate::data::Data| {
            use holonom::prelude::*;

            #[derive(Debug, Mechanism)]
            struct Scene {
                $($bodies)*
                #[$attribute(between = $between, $($attributes)*)]
                element: $element,
            }

            crate::kernels::boxed(&Scene::default(), Scene::HANDLES.element)
        }
    };

    ($mode:ident $bodies:tt $between:tt $attribute:ident $element:ident { $($key:ident = $value:tt),* $(,)? }) => {
        describe! { @words $mode [] [$($key = $value,)*] $bodies $between $attribute $element }
    };
}
