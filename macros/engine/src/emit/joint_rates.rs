//! Kernels in the rates of the joints: one trait for each that is asked for.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::joint_report::option;
use super::straight_line::StraightLine;
use super::writer::{Writer, name as terms_name};
use crate::coordinates::adjoint::Adjoint;
use crate::coordinates::derivatives::Derivatives;
use crate::coordinates::joint_rates::JointRates;
use crate::coordinates::kernels::JointKernels;
use crate::model::Asked;
use crate::symbolic::equations::Kernel;
use crate::syntax::words::local;

/// The trait of a kernel, its function and its type, if that is no number for each rate.
fn names(asked: Asked) -> (Ident, Ident, Option<Ident>) {
    let (implemented, function, kind) = match asked {
        Asked::Mass => ("HasMassMatrix", "mass_matrix", Some("MassMatrix")),
        Asked::Gravity => ("HasGravity", "gravity_efforts", None),
        Asked::Coriolis => ("HasCoriolis", "coriolis_efforts", None),
        Asked::Inverse => ("HasInverse", "inverse_dynamics", None),
        Asked::Jacobian => ("HasJacobian", "joint_axes", Some("Axes")),
        Asked::Forward => ("JointCoordinates", "forward_dynamics", None),
        Asked::Derivatives => ("JointCoordinates", "derivatives", Some("Derivatives")),
        Asked::Adjoint => ("JointCoordinates", "adjoint", Some("Adjoint")),
    };
    (
        format_ident!("{implemented}"),
        format_ident!("{function}"),
        kind.map(|kind| format_ident!("{kind}")),
    )
}

impl Writer<'_, JointKernels> {
    /// The traits of what is asked for, and that of the rows.
    pub(super) fn joint_rates(&mut self) -> TokenStream {
        let kernels = self.kernels;
        let Some(of_joints) = &kernels.joint_rates else {
            return TokenStream::new();
        };
        let mut tokens = self.closing_rows(of_joints);
        for (asked, kernel) in &of_joints.asked {
            tokens.extend(self.asked(*asked, kernel, of_joints));
        }
        tokens
    }

    fn closing_rows(&mut self, of_joints: &JointRates) -> TokenStream {
        let (name, facade) = (&self.model.name, self.facade);
        let StraightLine {
            statements,
            outputs,
        } = self.of_state(
            "__closing_rows",
            &of_joints.rows,
            &TokenStream::new(),
            &TokenStream::new(),
        );
        let rows = self.kernels.rows.len();
        let entries = rows * self.kernels.velocities;
        let (jacobian, others) = outputs.split_at(entries);
        let (gamma, others) = others.split_at(rows);
        let (rates, values) = others.split_at(rows);
        let unpack = Self::unpack();
        let arguments = arguments();
        quote! {
            #[automatically_derived]
            impl #facade::__private::JointRates for #name {
                type ClosingJacobian<__S: #facade::Scalar> = [__S; #entries];

                fn closing_rows<__S: #facade::Scalar>(
                    #arguments
                ) -> (Self::ClosingJacobian<__S>, [Self::ClosingMultipliers<__S>; 3]) {
                    #unpack
                    #statements
                    ([#(#jacobian),*], [[#(#gamma),*], [#(#rates),*], [#(#values),*]])
                }
            }
        }
    }

    /// The accelerations with their derivatives; without these, the type of no number.
    pub(super) fn derivatives(&mut self) -> TokenStream {
        let (facade, kernels) = (self.facade, self.kernels);
        let Some(Derivatives {
            kernel,
            motions,
            values,
        }) = &kernels.derivatives
        else {
            return quote! {
                type Derivatives<__S: #facade::Scalar> = [__S; 0];
                type MotionsAlong<__S: #facade::Scalar> = [__S; 0];
            };
        };
        let (none, unpack, arguments) = (TokenStream::new(), Self::unpack(), arguments());
        let StraightLine {
            statements,
            outputs,
        } = self.of_state("__derivatives", kernel, &none, &none);
        let length = outputs.len();
        let along = self.of_state("__motions_along", motions, &none, &none);
        let (along_statements, along_outputs) = (along.statements, along.outputs);
        let along_length = along_outputs.len();
        quote! {
            type Derivatives<__S: #facade::Scalar> = [__S; #length];
            type MotionsAlong<__S: #facade::Scalar> = [__S; #along_length];
            const DERIVED_BY: ::core::option::Option<&'static [usize]> =
                ::core::option::Option::Some(&[#(#values),*]);

            fn derivatives<__S: #facade::Scalar>(#arguments) -> Self::Derivatives<__S> {
                #unpack
                #statements
                [#(#outputs),*]
            }

            fn motions_along<__S: #facade::Scalar>(#arguments) -> Self::MotionsAlong<__S> {
                #unpack
                #along_statements
                [#(#along_outputs),*]
            }
        }
    }

    /// What a weighted sum of rates changes by; without it, the types of no number.
    pub(super) fn adjoint(&mut self) -> TokenStream {
        let (facade, kernels) = (self.facade, self.kernels);
        let Some(Adjoint {
            kernels,
            weights,
            inputs,
        }) = &kernels.adjoint
        else {
            return quote! {
                type Adjoint<__S: #facade::Scalar> = [__S; 0];
                type AdjointWeights<__S: #facade::Scalar> = [__S; 0];
            };
        };
        // Weights are read as accelerations are.
        let given = local("accelerations");
        let (arguments, passed) = (self.arguments(), Self::passed());
        let bodies = kernels.iter().map(|(terms, kernel)| {
            let frame = self.frame(
                format!("__adjoint_{}", terms_name(*terms)),
                quote!(#arguments #given: &[__S; #weights],),
                quote!(#passed #given,),
            );
            let StraightLine {
                statements,
                outputs,
            } = self.line_of(kernel, &frame);
            (outputs.len(), quote!(#statements [#(#outputs),*]))
        });
        let bodies: Vec<(usize, TokenStream)> = bodies.collect();
        let length = bodies.first().map_or(0, |(length, _)| *length);
        let body = match &bodies[..] {
            [(_, plain), (_, stabilised), ..] => {
                quote!(if __T::STABILISED { #stabilised } else { #plain })
            }
            _ => bodies.into_iter().map(|(_, body)| body).collect(),
        };
        let unpack = Self::unpack();
        let [constants, coefficients, time, state] =
            ["constants", "coefficients", "time", "state"].map(local);
        quote! {
            type Adjoint<__S: #facade::Scalar> = [__S; #length];
            type AdjointWeights<__S: #facade::Scalar> = [__S; #weights];
            const ADJOINT_BY: ::core::option::Option<&'static [usize]> =
                ::core::option::Option::Some(&[#(#inputs),*]);

            fn adjoint<__S: #facade::Scalar, __T: #facade::__private::Terms>(
                #constants: &Self::JointConstants<__S>,
                #coefficients: &Self::JointCoefficients<__S>,
                #time: __S,
                #state: &Self::JointState<__S>,
                #given: &Self::AdjointWeights<__S>,
            ) -> Self::Adjoint<__S> {
                #unpack
                #body
            }
        }
    }

    /// The accelerations of given efforts, where they are asked for.
    pub(super) fn forward(&mut self) -> TokenStream {
        let kernels = self.kernels;
        let asked = kernels.joint_rates.as_ref();
        let Some(kernel) = asked.and_then(|asked| asked.forward.as_ref()) else {
            return TokenStream::new();
        };
        let (function, _) = self.of_rates("forward_dynamics", kernel, &quote!(JointVelocities));
        quote! {
            const HAS_FORWARD: bool = true;

            #function
        }
    }

    /// A function of a state and of a number for each rate, with its number of outputs.
    fn of_rates(
        &mut self,
        name: &str,
        kernel: &Kernel,
        returned: &TokenStream,
    ) -> (TokenStream, usize) {
        let facade = self.facade;
        let [.., of_velocities, _] = self.types_outside();
        let given = local("accelerations");
        let StraightLine {
            statements,
            outputs,
        } = self.of_state(
            &format!("__{name}"),
            kernel,
            &quote!(#given: &#of_velocities,),
            &quote!(#given,),
        );
        let (unpack, arguments) = (Self::unpack(), arguments());
        let function = format_ident!("{name}");
        let tokens = quote! {
            fn #function<__S: #facade::Scalar>(
                #arguments
                #given: &Self::JointVelocities<__S>,
            ) -> Self::#returned<__S> {
                #unpack
                #statements
                [#(#outputs),*]
            }
        };
        (tokens, outputs.len())
    }

    fn asked(&mut self, asked: Asked, kernel: &Kernel, of_joints: &JointRates) -> TokenStream {
        let (name, facade) = (&self.model.name, self.facade);
        let (implemented, function, kind) = names(asked);
        let [.., of_velocities, _] = self.types_outside();
        let accelerations = local("accelerations");
        let (declared, own, passed) = match asked {
            Asked::Inverse | Asked::Coriolis => (
                quote!(#accelerations: &#of_velocities,),
                quote!(#accelerations: &Self::JointVelocities<__S>,),
                quote!(#accelerations,),
            ),
            _ => (TokenStream::new(), TokenStream::new(), TokenStream::new()),
        };
        let StraightLine {
            statements,
            outputs,
        } = self.of_state(&format!("__{function}"), kernel, &declared, &passed);
        let length = outputs.len();
        let (returned, declared) = match kind {
            Some(kind) => (
                quote!(Self::#kind<__S>),
                quote!(type #kind<__S: #facade::Scalar> = [__S; #length];),
            ),
            None => (quote!(Self::JointVelocities<__S>), TokenStream::new()),
        };
        let moved_by = (asked == Asked::Jacobian).then(|| {
            let bodies = of_joints.moved_by.iter().map(|rates| {
                let rates = rates.iter().map(|&(rate, ball)| {
                    let ball = option(ball);
                    quote!((#rate, #ball))
                });
                quote!(&[#(#rates),*])
            });
            quote! {
                const MOVED_BY: &'static [&'static [(usize, ::core::option::Option<usize>)]] =
                    &[#(#bodies),*];
            }
        });
        let unpack = Self::unpack();
        let arguments = arguments();
        let function = if asked == Asked::Mass {
            let telling = kernel.telling().into_iter().map(|place| &outputs[place]);
            let entries = local("entries");
            // Inlined into what gives the entries a place: else that is filled with zeros first,
            // 7 of 20 ns of a UR5.
            quote! {
                #[inline(always)]
                fn mass_matrix_into<__S: #facade::Scalar>(
                    #arguments
                    #entries: &mut [__S],
                ) -> __S {
                    #unpack
                    #statements
                    if let ::core::option::Option::Some(#entries) = #entries.first_chunk_mut() {
                        *#entries = [#(#outputs),*];
                    }
                    #facade::__private::zero_if_finite(&[#(#telling),*])
                }
            }
        } else {
            quote! {
                fn #function<__S: #facade::Scalar>(#arguments #own) -> #returned {
                    #unpack
                    #statements
                    [#(#outputs),*]
                }
            }
        };
        quote! {
            #[automatically_derived]
            impl #facade::__private::#implemented for #name {
                #declared
                #moved_by

                #function
            }
        }
    }

    /// A kernel that reads constants, time and a state, and what else is declared.
    fn of_state(
        &mut self,
        name: &str,
        kernel: &Kernel,
        declared: &TokenStream,
        passed: &TokenStream,
    ) -> StraightLine {
        let [constants, time, state] = ["constants", "time", "state"].map(local);
        let [of_state, of_constants, ..] = self.types_outside();
        let frame = self.frame(
            name.into(),
            quote!(#constants: &#of_constants, #time: __S, #state: &#of_state, #declared),
            quote!(#constants, #time, #state, #passed),
        );
        self.line_of(kernel, &frame)
    }
}

fn arguments() -> TokenStream {
    let [constants, time, state] = ["constants", "time", "state"].map(local);
    quote! {
        #constants: &Self::JointConstants<__S>,
        #time: __S,
        #state: &Self::JointState<__S>,
    }
}
