//! The macro.

/// Makes a Python module of mechanisms, a class each.
///
/// ```ignore
/// holonom_python::module! {
///     /// Linkages and arms.
///     mod linkages;
///     FourBar(crank) {
///         height: "height of the coupler (m)" = |view| view.position(FourBar::HANDLES.coupler).z,
///     }
///     Ur5;
///     runs HeavyTop;
/// }
/// ```
///
/// - `mod` names the module, as the library of the crate is called.
/// - A mechanism needs `coordinates = "joints"` or `"both"`, and `kernels = [mass, inverse,
///   jacobian]`. It is named by one word: `use` it before.
/// - In parentheses stand the joints that are the coordinates, as many as there are degrees of
///   freedom: joints of the spanning tree, none that closes a loop. Left out, they are all joints
///   of a tree in the order of the fields. Where a joint has several motions, all joints have to be
///   left out.
/// - In braces stand readings: a name, what it is with its unit in parentheses, and a function of
///   the state. A function is compiled for numbers that carry derivatives, too.
/// - `runs` before a mechanism makes a class that has `simulate` alone, for any description:
///   without kernels, with ball joints, in coordinates of the bodies.
#[macro_export]
macro_rules! module {
    ($(#[doc = $about:literal])* mod $module:ident; $($classes:tt)*) => {
        $(#[doc = $about])*
        #[$crate::__private::pyo3::pymodule]
        #[pyo3(crate = "holonom_python::__private::pyo3")]
        fn $module(
            module: &$crate::__private::pyo3::Bound<'_, $crate::__private::pyo3::types::PyModule>,
        ) -> $crate::__private::pyo3::PyResult<()> {
            $crate::__private::begin(module)?;
            let mut stubs = ::std::vec::Vec::new();
            $crate::__classes!(module, stubs; $($classes)*);
            $crate::__private::end(module, stubs)
        }
    };
}

/// The classes, one after the other.
#[doc(hidden)]
#[macro_export]
macro_rules! __classes {
    ($module:ident, $stubs:ident;) => {};
    ($module:ident, $stubs:ident; runs $mechanism:ident { $($readings:tt)* } $($rest:tt)*) => {
        $crate::__runs!($module, $stubs, $mechanism, [$($readings)*]);
        $crate::__classes!($module, $stubs; $($rest)*);
    };
    ($module:ident, $stubs:ident; runs $mechanism:ident; $($rest:tt)*) => {
        $crate::__runs!($module, $stubs, $mechanism, []);
        $crate::__classes!($module, $stubs; $($rest)*);
    };
    ($module:ident, $stubs:ident; $mechanism:ident $(($($joint:ident),* $(,)?))? { $($readings:tt)* } $($rest:tt)*) => {
        $crate::__analysed!($module, $stubs, $mechanism, [$($($joint)*)?], [$($readings)*]);
        $crate::__classes!($module, $stubs; $($rest)*);
    };
    ($module:ident, $stubs:ident; $mechanism:ident $(($($joint:ident),* $(,)?))?; $($rest:tt)*) => {
        $crate::__analysed!($module, $stubs, $mechanism, [$($($joint)*)?], []);
        $crate::__classes!($module, $stubs; $($rest)*);
    };
}

/// What both kinds of classes have.
#[doc(hidden)]
#[macro_export]
macro_rules! __exposed {
    (
        $mechanism:ident, $coordinates:ty, [$($joint:ident)*],
        [$($reading:ident: $about:literal = |$view:ident| $value:expr),* $(,)?], $begin:expr, $names:expr
    ) => {
        type Of = $mechanism;
        struct Class;

        impl $crate::__private::Exposed for Class {
            type Mechanism = Of;
            type Coordinates = $coordinates;

            const CHOSEN: &'static [&'static str] = &[$(stringify!($joint)),*];
            const READINGS: &'static [$crate::__private::Reading] = &[
                $($crate::__private::Reading { name: stringify!($reading), about: $about }),*
            ];

            fn make(
                numbers: &mut $crate::__private::Numbers,
            ) -> ::core::result::Result<Of, $crate::__private::holonom::ParameterError> {
                #[allow(unused_imports)]
                use $crate::__private::Fallback as _;
                $crate::__private::Construct::construct(Of::new, numbers)
            }

            fn typical() -> ::core::option::Option<Of> {
                #[allow(unused_imports)]
                use $crate::__private::NotTypical as _;
                $crate::__private::Typical::<Of>::of()
            }

            #[allow(unused_variables)]
            fn read(
                view: &$crate::__private::holonom::View<'_, f64, Of>,
            ) -> ::std::vec::Vec<f64> {
                ::std::vec![$({ let $view = view; $value }),*]
            }

            fn begin(
                valued: &$crate::__private::Valued<Of>,
                time: f64,
                start: &$crate::__private::Start,
            ) -> ::core::result::Result<
                <Of as $crate::__private::holonom::Mechanism>::State<f64>,
                $crate::__private::holonom::Fault,
            > {
                $begin(valued, time, start)
            }

            fn coordinates() -> ::std::vec::Vec<(::std::string::String, &'static str)> {
                $names()
            }
        }
    };
}

/// A class with runs alone.
#[doc(hidden)]
#[macro_export]
macro_rules! __runs {
    ($module:ident, $stubs:ident, $mechanism:ident, $readings:tt) => {{
        $crate::__exposed!(
            $mechanism,
            <Of as $crate::__private::holonom::Mechanism>::Coordinates,
            [],
            $readings,
            $crate::__private::by_joints::<Class>,
            $crate::__private::joint_names::<Class>
        );
        {
            use $crate::__private::pyo3;

            #[pyo3::pyclass(crate = "holonom_python::__private::pyo3", frozen, subclass)]
            struct $mechanism($crate::__private::Object<Class>);

            $crate::__methods!($mechanism, {});

            let class = $module.py().get_type::<$mechanism>();
            $stubs.push($crate::__private::register::<Class>(
                $module, &class, false,
            )?);
        }
    }};
}

/// A class with equations of motion.
#[doc(hidden)]
#[macro_export]
macro_rules! __analysed {
    (
        $module:ident, $stubs:ident, $mechanism:ident, [$($joint:ident)*],
        [$($reading:ident: $about:literal = |$view:ident| $value:expr),* $(,)?]
    ) => {{
        $crate::__exposed!(
            $mechanism, $crate::__private::holonom::mechanism::Relative, [$($joint)*],
            [$($reading: $about = |$view| $value),*],
            $crate::__private::in_coordinates::<Class, N>, $crate::__private::coordinate_names::<Class>
        );

        /// The numbers of coordinates, inputs and readings.
        const REPORT: $crate::__private::holonom::Report =
            <Of as $crate::__private::holonom::Mechanism>::REPORT;
        const N: usize = REPORT.degrees_of_freedom as usize;
        const K: usize = $crate::__private::inputs(&REPORT);
        const CHOSEN: usize = <Class as $crate::__private::Exposed>::CHOSEN.len();
        const _: () = $crate::__private::check_coordinates(
            &<Of as $crate::__private::holonom::JointCoordinates>::JOINT_REPORT,
            REPORT.degrees_of_freedom,
            CHOSEN,
        );
        // They are fields, and joints with a coordinate.
        $(
            let _ = <Of as $crate::__private::holonom::Mechanism>::HANDLES.$joint.index();
            const _: () = ::core::assert!(
                $crate::__private::is_coordinate(
                    &<Of as $crate::__private::holonom::JointCoordinates>::JOINT_REPORT,
                    ::core::stringify!($joint),
                ),
                ::core::concat!(
                    "`", ::core::stringify!($joint), "` in the parentheses behind `",
                    ::core::stringify!($mechanism),
                    "` is no coordinate: name joints of the spanning tree, no bodies and no joint that closes a loop"
                ),
            );
        )*

        impl $crate::__private::Analysed<N> for Class {
            fn linearise(
                space: &$crate::__private::holonom::independent::IndependentCoordinates<Of, N>,
                state: &<Of as $crate::__private::holonom::JointCoordinates>::JointState<f64>,
            ) -> ::core::result::Result<$crate::__private::Matrices, $crate::__private::holonom::Fault> {
                let mut inputs = REPORT.values.iter().enumerate().filter(|(_, value)| value.is_input);
                let inputs: [_; K] = ::core::array::from_fn(|_| {
                    let place = inputs.next().map_or(usize::MAX, |(place, _)| place);
                    $crate::__private::holonom::mechanism::ValueHandle::new(place)
                });
                #[allow(unused_variables)]
                let linear = space.linearise(state, inputs, |view| [$({ let $view = view; $value }),*])?;
                ::core::result::Result::Ok($crate::__private::Matrices::of(&linear))
            }
        }

        {
            use $crate::__private::pyo3;

            #[pyo3::pyclass(crate = "holonom_python::__private::pyo3", frozen, subclass)]
            struct $mechanism($crate::__private::Object<Class>);

            $crate::__methods!($mechanism, {
                /// Accelerations (rad/s^2, m/s^2), shape (..., N), under efforts `tau` (N m, N)
                /// along the coordinates beside the described forces. `q` (rad, m), `v` (rad/s,
                /// m/s) and `tau` have shape (..., N); the leading axes are the same, or there are
                /// none. Inputs by name have shape () or that of the leading axes.
                #[pyo3(signature = (q, v=None, tau=None, *, inputs=None, time=0.0))]
                fn forward_dynamics<'py>(
                    &self,
                    py: pyo3::Python<'py>,
                    q: &pyo3::Bound<'py, pyo3::PyAny>,
                    v: Option<&pyo3::Bound<'py, pyo3::PyAny>>,
                    tau: Option<&pyo3::Bound<'py, pyo3::PyAny>>,
                    inputs: Option<&pyo3::Bound<'py, pyo3::types::PyDict>>,
                    time: f64,
                ) -> pyo3::PyResult<$crate::__private::Array<'py>> {
                    let given = $crate::__private::Given { inputs, time };
                    self.0.forward_dynamics::<N>(py, [Some(q), v, tau], &given)
                }

                /// Efforts (N m, N), shape (..., N), that have to act along the coordinates beside
                /// the described forces for accelerations `a` (rad/s^2, m/s^2): `M(q) a + h(q, v)`.
                #[pyo3(signature = (q, v=None, a=None, *, inputs=None, time=0.0))]
                fn inverse_dynamics<'py>(
                    &self,
                    py: pyo3::Python<'py>,
                    q: &pyo3::Bound<'py, pyo3::PyAny>,
                    v: Option<&pyo3::Bound<'py, pyo3::PyAny>>,
                    a: Option<&pyo3::Bound<'py, pyo3::PyAny>>,
                    inputs: Option<&pyo3::Bound<'py, pyo3::types::PyDict>>,
                    time: f64,
                ) -> pyo3::PyResult<$crate::__private::Array<'py>> {
                    let given = $crate::__private::Given { inputs, time };
                    self.0.inverse_dynamics::<N>(py, [Some(q), v, a], &given)
                }

                /// Mass matrices (kg m^2, kg m, kg), shape (..., N, N), symmetric, of `q` of shape
                /// (..., N).
                #[pyo3(signature = (q, *, time=0.0))]
                fn mass_matrix<'py>(
                    &self,
                    py: pyo3::Python<'py>,
                    q: &pyo3::Bound<'py, pyo3::PyAny>,
                    time: f64,
                ) -> pyo3::PyResult<$crate::__private::Array<'py>> {
                    let given = $crate::__private::Given { inputs: None, time };
                    self.0.mass_matrix::<N>(py, q, &given)
                }

                /// Jacobians, shape (..., 6, N), of a body's centre of mass or of a named point:
                /// rows 0 to 2 give its velocity (m/s, global), rows 3 to 5 the angular velocity of
                /// its body (rad/s, global).
                #[pyo3(signature = (at, q, *, time=0.0))]
                fn jacobian<'py>(
                    &self,
                    py: pyo3::Python<'py>,
                    at: &str,
                    q: &pyo3::Bound<'py, pyo3::PyAny>,
                    time: f64,
                ) -> pyo3::PyResult<$crate::__private::Array<'py>> {
                    let given = $crate::__private::Given { inputs: None, time };
                    self.0.jacobian::<N>(py, at, q, &given)
                }

                /// The equations of motion, linear about states: `A` (..., 2 N, 2 N), `B`
                /// (..., 2 N, K), `C` (..., P, 2 N), `D` (..., P, K), with `x` the coordinates and
                /// then their rates, `u` the inputs, `y` the readings of the class.
                #[pyo3(signature = (q, v=None, *, inputs=None, time=0.0))]
                fn linearised<'py>(
                    &self,
                    py: pyo3::Python<'py>,
                    q: &pyo3::Bound<'py, pyo3::PyAny>,
                    v: Option<&pyo3::Bound<'py, pyo3::PyAny>>,
                    inputs: Option<&pyo3::Bound<'py, pyo3::types::PyDict>>,
                    time: f64,
                ) -> pyo3::PyResult<$crate::Linearised> {
                    let given = $crate::__private::Given { inputs, time };
                    self.0.linearised::<N>(py, [Some(q), v], &given)
                }

                /// Runs many at once from `t_start` to `t_end` (s), in lanes and on cores, by the
                /// Runge-Kutta method of order 4 with steps of `dt` (s) and a report after every so
                /// many of them. `start` (rad, m) and `rates` (rad/s, m/s) have shape (B, N) or
                /// (N,); parameters by name () or (B,); inputs by name (), (B,), or (B, S) with a
                /// number for each of S steps. A run that cannot go on is NaN from there on, and
                /// stands in `stopped`.
                #[pyo3(signature = (t_end, dt, *, every=1, start=None, rates=None, inputs=None, parameters=None, t_start=0.0, limits=true, threads=None))]
                #[allow(clippy::too_many_arguments)]
                fn rollouts<'py>(
                    &self,
                    py: pyo3::Python<'py>,
                    t_end: f64,
                    dt: f64,
                    every: usize,
                    start: Option<&pyo3::Bound<'py, pyo3::PyAny>>,
                    rates: Option<&pyo3::Bound<'py, pyo3::PyAny>>,
                    inputs: Option<&pyo3::Bound<'py, pyo3::types::PyDict>>,
                    parameters: Option<&pyo3::Bound<'py, pyo3::types::PyDict>>,
                    t_start: f64,
                    limits: bool,
                    threads: Option<usize>,
                ) -> pyo3::PyResult<$crate::Rollouts> {
                    let many = $crate::__private::Many {
                        interval: (t_start, t_end), step: dt, every, start, rates, inputs, parameters, limits, threads,
                    };
                    self.0.rollouts::<N>(py, &many)
                }
            });

            let class = $module.py().get_type::<$mechanism>();
            $stubs.push($crate::__private::register::<Class>($module, &class, true)?);
        }
    }};
}

/// The methods of all classes, and those that are given.
#[doc(hidden)]
#[macro_export]
macro_rules! __methods {
    ($class:ident, { $($further:tt)* }) => {
        #[pyo3::pymethods(crate = "holonom_python::__private::pyo3")]
        impl $class {
            #[new]
            #[pyo3(signature = (**values))]
            fn new(
                py: pyo3::Python<'_>,
                values: Option<&pyo3::Bound<'_, pyo3::types::PyDict>>,
            ) -> pyo3::PyResult<Self> {
                Ok(Self($crate::__private::Object::new(py, values)?))
            }

            fn __getattr__<'py>(
                &self,
                py: pyo3::Python<'py>,
                name: &str,
            ) -> pyo3::PyResult<pyo3::Bound<'py, pyo3::PyAny>> {
                self.0.get(py, name)
            }

            fn __setattr__(
                &self,
                py: pyo3::Python<'_>,
                name: &str,
                value: &pyo3::Bound<'_, pyo3::PyAny>,
            ) -> pyo3::PyResult<()> {
                self.0.set(py, name, value)
            }

            fn __getnewargs_ex__<'py>(
                &self,
                py: pyo3::Python<'py>,
            ) -> pyo3::PyResult<((), pyo3::Bound<'py, pyo3::types::PyDict>)> {
                Ok(((), self.0.dict(py)?))
            }

            fn __repr__(&self, py: pyo3::Python<'_>) -> pyo3::PyResult<String> {
                self.0.repr(py)
            }

            /// Runs from `t_start` to `t_end` (s), with a report every so many seconds, at the
            /// start and at the end. `start` (rad, m) and `rates` (rad/s, m/s) are by coordinate,
            /// in a dictionary or an array of shape (N,); what is left out is as described. Inputs
            /// by name are numbers, or arrays of shape (K,) with a number for every `period` (s).
            /// The method is "dormand_prince" or "bdf" (for stiff mechanisms) with a relative
            /// tolerance, or "rk4" with a step (s). Warnings of the run are those of Python, of the
            /// class `RunWarning`.
            #[pyo3(signature = (t_end, *, every=0.01, start=None, rates=None, inputs=None, period=None, method="dormand_prince", tolerance=None, step=None, projection=true, reactions=false, film=true, t_start=0.0))]
            #[allow(clippy::too_many_arguments)]
            fn simulate<'py>(
                &self,
                py: pyo3::Python<'py>,
                t_end: f64,
                every: f64,
                start: Option<&pyo3::Bound<'py, pyo3::PyAny>>,
                rates: Option<&pyo3::Bound<'py, pyo3::PyAny>>,
                inputs: Option<&pyo3::Bound<'py, pyo3::types::PyDict>>,
                period: Option<f64>,
                method: &str,
                tolerance: Option<f64>,
                step: Option<f64>,
                projection: bool,
                reactions: bool,
                film: bool,
                t_start: f64,
            ) -> pyo3::PyResult<$crate::Run> {
                let setting = $crate::__private::Setting {
                    interval: (t_start, t_end), every, start, rates, inputs, period, method, tolerance, step,
                    projection, reactions, film,
                };
                self.0.simulate(py, &setting)
            }

            $($further)*
        }
    };
}
