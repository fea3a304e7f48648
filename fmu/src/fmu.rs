//! A mechanism as a functional mock-up unit.

use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;

use holonom::formulation::Formulation;
use holonom::mechanism::TracedCoordinates;
use holonom::{Mechanism, Rk4, View};
use holonom_export::{Double, Export, Interface, Source, Traced};

use crate::archive::Entry;
use crate::description::{self, Description};
use crate::error::FmuError;
use crate::variables::{self, Variable};
use crate::{archive, binary, model};

/// Files in C, and headers, that are the same in every unit.
const FILES: [(&str, &str); 7] = [
    ("fmi3_absent.c", include_str!("../c/fmi3_absent.c")),
    ("fmi3_events.h", include_str!("../c/fmi3_events.h")),
    ("fmi3_functions.c", include_str!("../c/fmi3_functions.c")),
    ("fmi3_mechanism.h", include_str!("../c/fmi3_mechanism.h")),
    (
        "fmi3FunctionTypes.h",
        include_str!("../c/fmi3FunctionTypes.h"),
    ),
    ("fmi3Functions.h", include_str!("../c/fmi3Functions.h")),
    (
        "fmi3PlatformTypes.h",
        include_str!("../c/fmi3PlatformTypes.h"),
    ),
];

/// The longest step of co-simulation (s), where nothing else is said.
const INTERNAL_STEP: f64 = 1e-3;

/// A mechanism that is written as a functional mock-up unit of FMI 3.0.
///
/// ```
/// use holonom::prelude::*;
/// use holonom_fmu::FmuExt;
///
/// #[derive(Mechanism)]
/// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
/// struct Arm {
///     #[input]
///     torque: f64,
///     #[body(mass = 1.0, inertia = [0.083, 0.001, 0.083], position = [0.0, 0.5, 0.0])]
///     link: Body,
///     #[joint(between = [ground, link], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
///     hinge: Revolute,
///     #[force(between = [ground, link], axis = [1.0, 0.0, 0.0], moment = torque)]
///     motor: TorsionalActuator,
/// }
///
/// # let folder = std::env::temp_dir().join(format!("holonom-fmu-example-{}", std::process::id()));
/// # std::fs::create_dir_all(&folder)?;
/// # let path = folder.join("arm.fmu");
/// Arm::default()
///     .fmu(StandardLagrange)
///     .about("torque", "torque of the motor (N m)")
///     .reading("height", "height of the link (m)", |view| view.position(Arm::HANDLES.link).z)
///     .write(&path)?;
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), holonom_fmu::FmuError>(())
/// ```
///
/// Its variables are `hinge_angle` and `hinge_rate`, which are states and outputs, their
/// derivatives `der(hinge_angle)` and `der(hinge_rate)`, the input `torque` and the output
/// `height`.
///
/// `C` are the coordinates in which the equations of motion are solved.
#[derive(Debug)]
pub struct Fmu<M: Mechanism, C = <M as Mechanism>::Coordinates> {
    export: Export<M, Double, C>,
    description: String,
    abouts: Vec<(String, String)>,
    internal_step: f64,
    is_compiled: bool,
}

/// What was written.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Written {
    /// The platform of the binary, such as `x86_64-linux`. `None` where there is none, because no
    /// compiler of C was found or none was asked for.
    pub platform: Option<String>,
}

/// Mechanisms that are written as functional mock-up units.
pub trait FmuExt: Mechanism {
    /// The mechanism as a unit, in the coordinates that its attribute names. What is wrong is said
    /// where it is written.
    fn fmu<F: Formulation<f64>>(&self, formulation: F) -> Fmu<Self>
    where
        Self::Coordinates: TracedCoordinates<Self>,
    {
        Fmu::new(self, formulation)
    }
}

impl<M: Mechanism> FmuExt for M {}

impl<M: Mechanism, C: TracedCoordinates<M>> Fmu<M, C> {
    /// The mechanism as a unit, with its parameters and inputs as they are.
    #[must_use]
    pub fn new<F: Formulation<f64>>(mechanism: &M, formulation: F) -> Self {
        Self {
            export: Export::new(mechanism, formulation),
            description: String::new(),
            abouts: Vec::new(),
            internal_step: INTERNAL_STEP,
            is_compiled: true,
        }
    }

    /// Gives the unit, its files and its functions in C another name than that of the mechanism in
    /// lower case.
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        self.export = self.export.named(name);
        self
    }

    /// What the mechanism is, for a reader.
    #[must_use]
    pub fn description(mut self, text: &str) -> Self {
        text.clone_into(&mut self.description);
        self
    }

    /// What a variable is, with its unit in parentheses, such as `torque of the motor (N m)`. A
    /// unit is a product of powers of `kg`, `m`, `s`, `A`, `K`, `mol`, `cd`, `rad`, `N`, `J`, `W`,
    /// `Pa`, `Hz`, `V`, `mm` and `deg`; other texts are no unit.
    #[must_use]
    pub fn about(mut self, variable: &str, text: &str) -> Self {
        self.abouts.push((variable.to_owned(), text.to_owned()));
        self
    }

    /// Begins with this state of the bodies, in the place of the described one.
    #[must_use]
    pub fn starting_from(mut self, mechanism: &M, bodies: &M::State<f64>) -> Self {
        self.export = self.export.starting_from(mechanism, bodies);
        self
    }

    /// Corrects the described start onto the constraints, see [`Export::assembled`].
    #[must_use]
    pub fn assembled(mut self, mechanism: &M) -> Self {
        self.export = self.export.assembled(mechanism);
        self
    }

    /// Passes limits of joints as if there were none. Else joints turn back there, see the
    /// [documentation of the crate](crate#limits-and-laws-that-switch).
    #[must_use]
    pub fn without_limits(mut self) -> Self {
        self.export = self.export.without_limits();
        self
    }

    /// An output: a function of the state, with what it is, and its unit in parentheses. See
    /// [`Export::reading`].
    #[must_use]
    pub fn reading(
        mut self,
        name: &str,
        about: &str,
        read: impl FnOnce(&View<'_, Traced<Double>, M>) -> Traced<Double>,
    ) -> Self {
        self.export = self.export.reading(name, about, read);
        self
    }

    /// The longest step (s) of the Runge-Kutta method of order 4 that moves the mechanism in
    /// co-simulation; 1 ms where nothing is said. Model exchange has the steps of the importer.
    #[must_use]
    pub fn internal_step(mut self, step: f64) -> Self {
        self.internal_step = step;
        self
    }

    /// Leaves the binary out: an importer compiles the sources.
    #[must_use]
    pub fn without_binary(mut self) -> Self {
        self.is_compiled = false;
        self
    }

    /// Writes the unit. A file that is there is written over.
    ///
    /// The binary is compiled by `cc`, or what the environment variable `CC` names.
    ///
    /// # Errors
    /// What cannot be exported, what the compiler says if it fails, and what keeps a file from
    /// being written. Nothing is written then, but for the last.
    pub fn write(self, path: impl AsRef<Path>) -> Result<Written, FmuError> {
        let (files, written) = self.files()?;
        let path = path.as_ref();
        let file = File::create(path).map_err(|error| {
            io::Error::new(error.kind(), format!("`{}`: {error}", path.display()))
        })?;
        archive::write(BufWriter::new(file), files)?;
        Ok(written)
    }

    /// All files by their paths in the unit.
    fn files(self) -> Result<(Vec<Entry>, Written), FmuError> {
        let step = self.internal_step;
        if !(step > 0.0 && step.is_finite()) {
            return Err(FmuError::InternalStep { step });
        }
        let export = self.export.step(Rk4).derivatives().reading_derivatives();
        let export = export.checked()?;
        let interface = export.interface();
        let source = export.c()?;
        let name = source.name.clone();
        if interface.states.is_empty() {
            return Err(FmuError::NoStates);
        }
        if name == "fmu" || name.starts_with("fmi3") {
            return Err(FmuError::Name { name });
        }
        let variables = variables::of(&interface, &self.abouts)?;
        let token = token(&source, &variables);
        let sources = sources(source, &interface, &variables, &token, step);
        let description = Description {
            mechanism: M::REPORT.name,
            name: &name,
            about: &self.description,
            token: &token,
            internal_step: step,
        };
        let mut files = vec![(
            "modelDescription.xml".to_owned(),
            description::model(&description, &variables)?,
        )];
        let mut platform = None;
        if self.is_compiled
            && let Some((found, library)) = binary::compiled(&name, &sources)?
        {
            let file = format!("{name}{}", std::env::consts::DLL_SUFFIX);
            files.push((format!("binaries/{found}/{file}"), library));
            platform = Some(found);
        }
        let compiled = sources.iter().map(|(file, _)| file.clone());
        let compiled: Vec<String> = compiled.filter(|file| file.ends_with(".c")).collect();
        let build = description::build(&name, &compiled)?;
        files.push(("sources/buildDescription.xml".to_owned(), build));
        let sources = sources.into_iter();
        files.extend(sources.map(|(file, text)| (format!("sources/{file}"), text)));
        Ok((files, Written { platform }))
    }
}

fn sources(
    source: Source,
    interface: &Interface,
    variables: &[Variable],
    token: &str,
    internal_step: f64,
) -> Vec<Entry> {
    let name = &source.name;
    let model = model::header(interface, variables, token, internal_step);
    let mut files = vec![
        (format!("{name}.c"), source.source.into_bytes()),
        (format!("{name}.h"), source.header.into_bytes()),
        ("fmi3_model.h".to_owned(), model.into_bytes()),
    ];
    let fixed = FILES.iter();
    files.extend(fixed.map(|(file, text)| ((*file).to_owned(), text.as_bytes().to_vec())));
    files
}

/// By which a binary knows its description: FNV-1a over the program and its variables, of 128 bits
/// (Fowler, Noll and Vo).
fn token(source: &Source, variables: &[Variable]) -> String {
    let variables = format!("{variables:?}");
    let texts = [&source.header, &source.source, &variables];
    let bytes = texts.into_iter().flat_map(|text| text.bytes());
    let hash = bytes.fold(
        0x6c62_272e_07bb_0142_62b8_2175_6295_c58d_u128,
        |hash, byte| (hash ^ u128::from(byte)).wrapping_mul((1 << 88) + 0x13b),
    );
    format!("{hash:032x}")
}
