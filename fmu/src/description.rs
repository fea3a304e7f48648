//! `modelDescription.xml`, and `sources/buildDescription.xml`.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesEnd, BytesStart, Event};

use crate::binary::OPTIONS;
use crate::units::Unit;
use crate::variables::{Kind, Variable};

/// What a description says beside its variables.
pub(crate) struct Description<'a> {
    pub(crate) mechanism: &'a str,
    /// The name of the program.
    pub(crate) name: &'a str,
    pub(crate) about: &'a str,
    pub(crate) token: &'a str,
    /// The longest step of co-simulation (s).
    pub(crate) internal_step: f64,
}

/// A document that is being written.
struct Document(Writer<Vec<u8>>);

impl Document {
    fn new() -> io::Result<Self> {
        let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
        writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
        Ok(Self(writer))
    }

    fn empty(&mut self, name: &str, attributes: &[(&str, &str)]) -> io::Result<()> {
        let start = BytesStart::new(name).with_attributes(attributes.iter().copied());
        self.0.write_event(Event::Empty(start))
    }

    /// An element with what is written inside.
    fn element(
        &mut self,
        name: &str,
        attributes: &[(&str, &str)],
        inside: impl FnOnce(&mut Self) -> io::Result<()>,
    ) -> io::Result<()> {
        let start = BytesStart::new(name).with_attributes(attributes.iter().copied());
        self.0.write_event(Event::Start(start))?;
        inside(self)?;
        self.0.write_event(Event::End(BytesEnd::new(name)))
    }

    fn finish(self) -> Vec<u8> {
        let mut bytes = self.0.into_inner();
        bytes.push(b'\n');
        bytes
    }
}

/// The description of the model.
pub(crate) fn model(of: &Description<'_>, variables: &[Variable]) -> io::Result<Vec<u8>> {
    let mut document = Document::new()?;
    let mut attributes = vec![
        ("fmiVersion", "3.0"),
        ("modelName", of.mechanism),
        ("instantiationToken", of.token),
        ("variableNamingConvention", "structured"),
        (
            "generationTool",
            concat!("holonom-fmu ", env!("CARGO_PKG_VERSION")),
        ),
    ];
    if !of.about.is_empty() {
        attributes.push(("description", of.about));
    }
    document.element("fmiModelDescription", &attributes, |document| {
        interfaces(document, of)?;
        units(document, variables)?;
        document.element("LogCategories", &[], |document| {
            document.empty("Category", &[("name", "logStatusWarning")])?;
            document.empty("Category", &[("name", "logStatusError")])
        })?;
        document.empty("DefaultExperiment", &[("startTime", "0.0")])?;
        document.element("ModelVariables", &[], |document| {
            let mut places = variables.iter().enumerate();
            places.try_for_each(|(place, of)| variable(document, place, of))
        })?;
        document.element("ModelStructure", &[], |document| {
            structure(document, variables)
        })
    })?;
    Ok(document.finish())
}

/// Model exchange and co-simulation, and what both can do.
fn interfaces(document: &mut Document, of: &Description<'_>) -> io::Result<()> {
    let both = [
        ("modelIdentifier", of.name),
        ("canGetAndSetFMUState", "true"),
        ("canSerializeFMUState", "true"),
        ("providesDirectionalDerivatives", "true"),
        ("providesAdjointDerivatives", "true"),
    ];
    // What has passed a limit, and what has been within since an impact, is seen behind a step.
    let completed = ("needsCompletedIntegratorStep", "true");
    document.empty("ModelExchange", &[&both[..], &[completed]].concat())?;
    let step = format!("{:?}", of.internal_step);
    let own = [
        ("canHandleVariableCommunicationStepSize", "true"),
        ("fixedInternalStepSize", step.as_str()),
    ];
    document.empty("CoSimulation", &[&both[..], &own].concat())
}

fn units(document: &mut Document, variables: &[Variable]) -> io::Result<()> {
    let mut units: Vec<Unit> = Vec::new();
    for unit in variables.iter().filter_map(Variable::unit) {
        if units.iter().all(|known| known.name != unit.name) {
            units.push(unit);
        }
    }
    document.element("UnitDefinitions", &[], |document| {
        units.iter().try_for_each(|unit| {
            document.element("Unit", &[("name", unit.name.as_str())], |document| {
                let base = unit.base();
                let base: Vec<_> = base.iter().map(|(name, to)| (*name, to.as_str())).collect();
                document.empty("BaseUnit", &base)
            })
        })
    })
}

/// Its causality, variability and how its value at the start is found.
const fn role(kind: Kind) -> [&'static str; 3] {
    match kind {
        Kind::Time => ["independent", "continuous", ""],
        Kind::State => ["output", "continuous", "exact"],
        Kind::Derivative | Kind::Indicator => ["local", "continuous", "calculated"],
        Kind::Parameter => ["parameter", "tunable", "exact"],
        // Exact, which the standard leaves out here.
        Kind::Input => ["input", "continuous", ""],
        Kind::Reading => ["output", "continuous", "calculated"],
    }
}

fn variable(document: &mut Document, place: usize, of: &Variable) -> io::Result<()> {
    let [causality, variability, initial] = role(of.kind);
    let (place, unit) = (place.to_string(), of.unit());
    let derivative = of.derivative_of.map(|place| place.to_string());
    let numbers: Vec<String> = of
        .start
        .iter()
        .map(|number| format!("{number:?}"))
        .collect();
    let numbers = numbers.join(" ");
    let attributes = [
        ("name", of.name.as_str()),
        ("valueReference", &place),
        ("description", &of.about),
        ("causality", causality),
        ("variability", variability),
        ("initial", initial),
        ("unit", unit.as_ref().map_or("", |unit| &unit.name)),
        ("derivative", derivative.as_deref().unwrap_or_default()),
        ("start", &numbers),
    ];
    let attributes: Vec<_> = attributes
        .into_iter()
        .filter(|(_, value)| !value.is_empty())
        .collect();
    if !of.is_array {
        return document.empty("Float64", &attributes);
    }
    document.element("Float64", &attributes, |document| {
        document.empty("Dimension", &[("start", &of.count.to_string())])
    })
}

/// What depends on what; where nothing is said, on everything.
fn structure(document: &mut Document, variables: &[Variable]) -> io::Result<()> {
    let mut list = |name: &str, kinds: &[Kind]| {
        let places = variables.iter().enumerate();
        let mut places = places.filter(|(_, variable)| kinds.contains(&variable.kind));
        places.try_for_each(|(place, variable)| {
            let place = place.to_string();
            let mut attributes = vec![("valueReference", place.as_str())];
            if variable.kind == Kind::State {
                attributes.push(("dependencies", &place));
                attributes.push(("dependenciesKind", "constant"));
            }
            document.empty(name, &attributes)
        })
    };
    list("Output", &[Kind::State, Kind::Reading])?;
    list("ContinuousStateDerivative", &[Kind::Derivative])?;
    list("InitialUnknown", &[Kind::Derivative, Kind::Reading])?;
    list("EventIndicator", &[Kind::Indicator])
}

/// How the sources are compiled.
pub(crate) fn build(name: &str, sources: &[String]) -> io::Result<Vec<u8>> {
    let mut document = Document::new()?;
    document.element(
        "fmiBuildDescription",
        &[("fmiVersion", "3.0")],
        |document| {
            document.element(
                "BuildConfiguration",
                &[("modelIdentifier", name)],
                |document| {
                    let options = OPTIONS.join(" ");
                    let set = [
                        ("language", "C99"),
                        ("compiler", "gcc"),
                        ("compilerOptions", options.as_str()),
                    ];
                    document.element("SourceFileSet", &set, |document| {
                        let mut sources = sources.iter();
                        sources.try_for_each(|file| document.empty("SourceFile", &[("name", file)]))
                    })?;
                    document.empty("Library", &[("name", "m"), ("description", "of C")])
                },
            )
        },
    )?;
    Ok(document.finish())
}
