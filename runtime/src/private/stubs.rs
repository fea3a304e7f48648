//! What stands for a mechanism whose description has faults.

/// The stub of a mechanism whose description has faults: it keeps further errors away and is never
/// run.
#[doc(hidden)]
#[macro_export]
macro_rules! __stub_mechanism {
    (@handle body) => { $crate::BodyHandle<__M> };
    (@handle joint) => { $crate::JointHandle<__M, $crate::__private::AnyJoint> };
    (@handle force $($path:ty)?) => { $crate::ForceHandle<__M, $crate::__private::AnyJoint> };
    (@handle joint $path:ty) => { $crate::JointHandle<__M, $path> };
    (@handle part $part:ty) => { $part };
    (@value part $part:ty) => { <$part>::VALUE };
    (@handle value) => { $crate::__private::ValueHandle<__M> };
    (@value value) => { $crate::__private::ValueHandle::new(0) };
    (@handle state) => { $crate::__private::StateHandle<__M> };
    (@value state) => { $crate::__private::StateHandle::new(0) };
    (@handle point) => { $crate::__private::PointHandle<__M> };
    (@value point) => { $crate::__private::PointHandle::new(0) };
    (@value body) => { $crate::BodyHandle::new(0) };
    (@value force $($path:ty)?) => { $crate::ForceHandle::new(0) };
    (@value joint $($path:ty)?) => { $crate::JointHandle::new(0) };
    (@handle [$length:expr] $kind:ident $($path:ty)?) => { [$crate::__stub_mechanism!(@handle $kind $($path)?); $length] };
    (@value [$length:expr] $kind:ident $($path:ty)?) => { [$crate::__stub_mechanism!(@value $kind $($path)?); $length] };
    (
        [$($declared:tt)*] [$mechanism:ty] [$($bounds:tt)*] [$inputs:ty]
        $($field:ident: $([$length:expr])? $kind:ident $($path:ty)?,)*
    ) => {
        #[allow(warnings, clippy::all, clippy::pedantic)]
        const _: () = {
            use ::core::primitive::{f64, usize};
            pub struct __Handles<__M> {
                $(pub $field: $crate::__stub_mechanism!(@handle $([$length])? $kind $($path)?),)*
                __mechanism: ::core::marker::PhantomData<fn() -> __M>,
            }
            impl<__M> ::core::clone::Clone for __Handles<__M> {
                fn clone(&self) -> Self { *self }
            }
            impl<__M> ::core::marker::Copy for __Handles<__M> {}
            impl<__M> ::core::fmt::Debug for __Handles<__M> {
                fn fmt(&self, _: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result { loop {} }
            }
            impl $($declared)* $crate::Mechanism for $mechanism
            where
                $mechanism: 'static,
                $($bounds)*
            {
                type State<__S: $crate::Scalar> = $crate::state::State<__S, 0, 0>;
                type Velocities<__S: $crate::Scalar> = [__S; 0];
                type Multipliers<__S: $crate::Scalar> = [__S; 0];
                type Jacobian<__S: $crate::Scalar> = [__S; 0];
                type Parameters<__S: $crate::Scalar> = [__S; 0];
                type Inputs<__S: $crate::Scalar> = $inputs;
                type Constants<__S: $crate::Scalar> = [__S; 0];
                type Coefficients<__S: $crate::Scalar> = [__S; 0];
                type Factors<__S: $crate::Scalar> = [__S; 0];
                type Coordinates = $crate::mechanism::Absolute;
                type Handles = __Handles<Self>;
                type PerLimit<__T: ::core::clone::Clone> = $crate::mechanism::Nothing;
                const HANDLES: __Handles<Self> = __Handles {
                    $($field: $crate::__stub_mechanism!(@value $([$length])? $kind $($path)?),)*
                    __mechanism: ::core::marker::PhantomData,
                };
                const REPORT: $crate::Report = $crate::Report {
                    name: "",
                    bodies: &[],
                    joints: &[],
                    forces: &[],
                    markers: &[],
                    points: &[],
                    values: &[],
                    shapes: &[],
                    carriers: &[],
                    blocks: &[],
                    coordinates: 0,
                    auxiliaries: 0,
                    states: &[],
                    velocities: 0,
                    equations: 0,
                    rank: $crate::mechanism::Rank::NotDecided,
                    redundant: &[],
                    degrees_of_freedom: 0,
                    velocity_rows: &[],
                    time: $crate::mechanism::ExplicitTime::NONE,
                    curved: false,
                    kernels: &[],
                    plan: "",
                };
                fn parameters<__S: $crate::Scalar>(&self) -> ::core::result::Result<[__S; 0], $crate::ParameterError> { loop {} }
                fn inputs<__S: $crate::Scalar>(&self) -> Self::Inputs<__S> { loop {} }
                fn limits_of<__S: $crate::Scalar, __T: ::core::clone::Clone>(
                    _: &[__S; 0], _: impl ::core::ops::FnMut($crate::mechanism::JointLimits<__S>) -> __T,
                ) -> $crate::mechanism::Nothing { $crate::mechanism::Nothing }
                fn prepare<__S: $crate::Scalar>(_: &[__S; 0]) -> [__S; 0] { [] }
                fn coefficients_by_row<__S: $crate::Scalar>(_: &[__S; 0], _: &$crate::mechanism::Stabilisation<__S>, _: &[__S; 0]) -> [__S; 0] { [] }
                fn initial_state<__S: $crate::Scalar>(_: &[__S; 0]) -> Self::State<__S> { loop {} }
                fn constraints<__S: $crate::Scalar>(_: &[__S; 0], _: __S, _: &Self::State<__S>) -> [__S; 0] { [] }
                fn constraint_rates<__S: $crate::Scalar>(_: &[__S; 0], _: __S, _: &Self::State<__S>) -> [__S; 0] { [] }
                fn jacobian<__S: $crate::Scalar>(_: &[__S; 0], _: __S, _: &Self::State<__S>) -> [__S; 0] { [] }
                fn gamma<__S: $crate::Scalar>(_: &[__S; 0], _: __S, _: &Self::State<__S>) -> [__S; 0] { [] }
                fn mass<__S: $crate::Scalar>(_: &[__S; 0]) -> [__S; 0] { [] }
                fn forces<__S: $crate::Scalar>(_: &[__S; 0], _: __S, _: &Self::State<__S>) -> [__S; 0] { [] }
                fn kinetic_energy<__S: $crate::Scalar>(_: &[__S; 0], _: &Self::State<__S>) -> __S { loop {} }
                fn potential_energy<__S: $crate::Scalar>(_: &[__S; 0], _: __S, _: &Self::State<__S>) -> __S { loop {} }
                fn coordinate_rates<__S: $crate::Scalar>(_: &[__S; 0], _: &Self::State<__S>) -> [__S; 0] { [] }
                fn evaluate_into<__S: $crate::Scalar, __T: $crate::mechanism::Terms>(
                    _: &[__S; 0], _: &[__S; 0], _: __S, _: &Self::State<__S>, _: &mut Self::State<__S>, _: &mut [__S; 0],
                ) -> $crate::mechanism::Pivot<__S> { loop {} }
                fn factor<__S: $crate::Scalar, __T: $crate::mechanism::Terms>(
                    _: &[__S; 0], _: &[__S; 0], _: __S, _: &Self::State<__S>,
                ) -> ([__S; 0], $crate::mechanism::Pivot<__S>) { loop {} }
                fn solve<__S: $crate::Scalar, __T: $crate::mechanism::Terms>(
                    _: &[__S; 0], _: &[__S; 0], _: &[__S; 0], _: &[__S; 0], _: &[__S; 0],
                ) -> ([__S; 0], [__S; 0]) { ([], []) }
                fn joint_angle<__S: $crate::Scalar>(_: &[__S; 0], _: &Self::State<__S>, _: usize) -> $crate::mechanism::AngleParts<__S> { loop {} }
                fn joint_point<__S: $crate::Scalar>(_: &[__S; 0], _: usize, _: usize) -> [__S; 3] { loop {} }
                fn user_axes(_: usize) -> [f64; 4] { [1.0, 0.0, 0.0, 0.0] }
            }
            impl $($declared)* ::core::default::Default for $mechanism
            where
                $($bounds)*
            {
                fn default() -> Self { loop {} }
            }
            $crate::__stub_joints! { [$($declared)*] [$mechanism] [$($bounds)*] }
        };
    };
}

/// The joint coordinates of such a mechanism, with all kernels that can be asked for.
#[doc(hidden)]
#[macro_export]
macro_rules! __stub_joints {
    ([$($declared:tt)*] [$mechanism:ty] [$($bounds:tt)*]) => {
        impl $($declared)* $crate::JointCoordinates for $mechanism
        where
            $mechanism: 'static,
            $($bounds)*
        {
            type JointState<__S: $crate::Scalar> = $crate::state::JointState<__S, 0, 0, 0>;
            type ClosingMultipliers<__S: $crate::Scalar> = [__S; 0];
            type JointConstants<__S: $crate::Scalar> = [__S; 0];
            type JointCoefficients<__S: $crate::Scalar> = [__S; 0];
            type BodyMotions<__S: $crate::Scalar> = [__S; 0];
            type JointFactors<__S: $crate::Scalar> = [__S; 0];
            type JointVelocities<__S: $crate::Scalar> = [__S; 0];
            type Derivatives<__S: $crate::Scalar> = [__S; 0];
            type MotionsAlong<__S: $crate::Scalar> = [__S; 0];
            type Adjoint<__S: $crate::Scalar> = [__S; 0];
            type AdjointWeights<__S: $crate::Scalar> = [__S; 0];
            const JOINT_REPORT: $crate::mechanism::JointReport = $crate::mechanism::JointReport {
                motions: &[],
                closing: &[],
                rows: &[],
                kernels: &[],
                asked: &[],
                euler_parameters: &[],
                counters: &[],
                auxiliaries: 0,
                states: &[],
                rewraps: false,
                determines: false,
            };
            fn prepare_joints<__S: $crate::Scalar>(_: &[__S; 0]) -> [__S; 0] { [] }
            fn take_joint_inputs<__S: $crate::Scalar>(_: &[__S; 0], _: &mut [__S; 0]) {}
            fn joint_coefficients<__S: $crate::Scalar>(_: &[__S; 0], _: &$crate::mechanism::Stabilisation<__S>, _: &[__S; 0]) -> [__S; 0] { [] }
            fn evaluate_joints_into<__S: $crate::Scalar, __T: $crate::mechanism::Terms>(
                _: &[__S; 0], _: &[__S; 0], _: __S, _: &Self::JointState<__S>, _: &mut Self::JointState<__S>, _: &mut [__S; 0],
            ) -> $crate::mechanism::Pivot<__S> { loop {} }
            fn factor_joints<__S: $crate::Scalar, __T: $crate::mechanism::Terms>(
                _: &[__S; 0], _: &[__S; 0], _: __S, _: &Self::JointState<__S>,
            ) -> [__S; 0] { [] }
            fn solve_joints<__S: $crate::Scalar, __T: $crate::mechanism::Terms>(
                _: &[__S; 0], _: &[__S; 0], _: &[__S; 0], _: &[__S; 0], _: &[__S; 0],
            ) -> ([__S; 0], [__S; 0]) { ([], []) }
            fn joint_coordinate_rates<__S: $crate::Scalar>(_: &[__S; 0], _: __S, _: &Self::JointState<__S>) -> Self::JointState<__S> { loop {} }
            fn body_motions<__S: $crate::Scalar>(_: &[__S; 0], _: &Self::JointState<__S>) -> [__S; 0] { [] }
            fn joint_state<__S: $crate::Scalar>(_: &[__S; 0], _: &Self::State<__S>) -> Self::JointState<__S> { loop {} }
        }
        impl $($declared)* $crate::mechanism::JointRates for $mechanism
        where
            $mechanism: 'static,
            $($bounds)*
        {
            type ClosingJacobian<__S: $crate::Scalar> = [__S; 0];
            fn closing_rows<__S: $crate::Scalar>(_: &[__S; 0], _: __S, _: &Self::JointState<__S>) -> ([__S; 0], [[__S; 0]; 3]) { ([], [[], [], []]) }
        }
        impl $($declared)* $crate::mechanism::HasMassMatrix for $mechanism
        where
            $mechanism: 'static,
            $($bounds)*
        {
            type MassMatrix<__S: $crate::Scalar> = [__S; 0];
            fn mass_matrix_into<__S: $crate::Scalar>(_: &[__S; 0], zero: __S, _: &Self::JointState<__S>, _: &mut [__S]) -> __S { zero }
        }
        impl $($declared)* $crate::mechanism::HasInverse for $mechanism
        where
            $mechanism: 'static,
            $($bounds)*
        {
            fn inverse_dynamics<__S: $crate::Scalar>(_: &[__S; 0], _: __S, _: &Self::JointState<__S>, _: &[__S; 0]) -> [__S; 0] { [] }
        }
        impl $($declared)* $crate::mechanism::HasGravity for $mechanism
        where
            $mechanism: 'static,
            $($bounds)*
        {
            fn gravity_efforts<__S: $crate::Scalar>(_: &[__S; 0], _: __S, _: &Self::JointState<__S>) -> [__S; 0] { [] }
        }
        impl $($declared)* $crate::mechanism::HasCoriolis for $mechanism
        where
            $mechanism: 'static,
            $($bounds)*
        {
            fn coriolis_efforts<__S: $crate::Scalar>(_: &[__S; 0], _: __S, _: &Self::JointState<__S>, _: &[__S; 0]) -> [__S; 0] { [] }
        }
        impl $($declared)* $crate::mechanism::HasJacobian for $mechanism
        where
            $mechanism: 'static,
            $($bounds)*
        {
            type Axes<__S: $crate::Scalar> = [__S; 0];
            const MOVED_BY: &'static [&'static [(usize, ::core::option::Option<usize>)]] = &[];
            fn joint_axes<__S: $crate::Scalar>(_: &[__S; 0], _: __S, _: &Self::JointState<__S>) -> [__S; 0] { [] }
        }
    };
}
