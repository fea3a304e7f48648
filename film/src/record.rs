//! What is recorded of a run.

use std::fs;
use std::marker::PhantomData;
use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use holonom::mechanism::{Located, Place};
use holonom::{BodyHandle, JointHandle, Mechanism, Real, Sample, View, Warnings};

use crate::anchors::anchors;
use crate::description::{arrows, bodies, elements, markers, placement, points, shapes};
use crate::fault::FilmError;
use crate::gears::{Gearing, Proportion, proportions};
#[cfg(feature = "gltf")]
use crate::gltf::gltf;
use crate::json::Json as _;
use crate::page::{
    Arrow, Element, Floats, Marker, Mesh, Other, Page, Point, Reading, Remark, Shape,
};
use crate::sketch::sketch;
use crate::subject::Subject;

/// The page with empty places for the title's data.
const PAGE: &str = include_str!("page.html");
/// Where the data goes.
const PLACE: &str = "/*FILM*/";
/// What the data is behind: a page that computes has its program before it.
const DATA: &str = "<script type=\"application/json\" id=\"film\">";

/// A film of a mechanism: see the crate's page.
#[derive(Clone, Debug)]
pub struct Film<M> {
    title: String,
    markers: Vec<Marker>,
    points: Vec<Point>,
    shapes: Vec<Shape>,
    pub(crate) meshes: Vec<Mesh>,
    proportions: Vec<Proportion>,
    gravity: [f64; 3],
    arrows: Vec<Arrow>,
    shows_arrows: bool,
    times: Vec<f64>,
    poses: Vec<f32>,
    ghost: Option<Ghost>,
    loads: Vec<f32>,
    traces: Vec<Trace>,
    readings: Vec<Values>,
    warnings: Vec<Remark>,
    /// Meshes that are not drawn.
    left_out: Vec<Remark>,
    mechanism: PhantomData<fn() -> M>,
}

/// Another run.
#[derive(Clone, Debug)]
struct Ghost {
    title: String,
    times: Vec<f64>,
    poses: Vec<f32>,
}

#[derive(Clone, Debug)]
struct Values {
    name: String,
    unit: String,
    values: Vec<f32>,
}

/// A point whose way is drawn.
#[derive(Clone, Debug)]
enum Trace {
    Given(Point),
    /// A named point, by its place in the report: numbers are there from the first frame on.
    Named(usize),
}

impl<M: Mechanism> Default for Film<M> {
    fn default() -> Self {
        Self::new()
    }
}

impl<M: Mechanism> Film<M> {
    /// A film without frames. Its title is the name of the mechanism's struct.
    #[must_use]
    pub fn new() -> Self {
        Self {
            title: M::REPORT.name.into(),
            markers: Vec::new(),
            points: Vec::new(),
            shapes: Vec::new(),
            meshes: Vec::new(),
            proportions: Vec::new(),
            gravity: [0.0; 3],
            arrows: Vec::new(),
            shows_arrows: false,
            times: Vec::new(),
            poses: Vec::new(),
            ghost: None,
            loads: Vec::new(),
            traces: Vec::new(),
            readings: Vec::new(),
            warnings: Vec::new(),
            left_out: Vec::new(),
            mechanism: PhantomData,
        }
    }

    /// Sets the title.
    #[must_use]
    pub fn titled(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// Records the reactions of joints too, which are then drawn as arrows: one evaluation more a
    /// frame. An arrow is the force of a joint on the second of its bodies, or on the first where
    /// the second is the ground.
    #[must_use]
    pub fn with_reactions(mut self) -> Self {
        self.shows_arrows = true;
        self
    }

    /// Draws the way of a named point, or of the centre of mass of a body, under its name. A point
    /// on the ground stays where it is, and has a mark only.
    pub fn trace(&mut self, at: impl Located<M>) {
        match at.located() {
            Place::Body(body) => self.trace_point(body, body.name(), [0.0; 3]),
            Place::Point(point) => self.traces.push(Trace::Named(point.index())),
        }
    }

    /// Draws the way of a point of a body, given from the centre of mass along the user's body axes
    /// (m).
    pub fn trace_point(&mut self, body: BodyHandle<M>, name: impl Into<String>, point: [f64; 3]) {
        self.traces.push(Trace::Given(Point {
            name: name.into(),
            body: Some(body.index()),
            at: point,
        }));
    }

    /// The traces as points of bodies, once there is a frame.
    fn traced(&self) -> Vec<Point> {
        let traces = self.traces.iter().filter_map(|trace| match trace {
            Trace::Given(point) => Some(point),
            Trace::Named(index) => self.points.get(*index),
        });
        let moving = traces.filter(|point| point.body.is_some());
        moving.cloned().collect()
    }

    /// Records a frame: an observer may be this alone, `|sample| film.record(sample)`.
    pub fn record<S: Real>(&mut self, sample: &Sample<'_, S, M>) {
        self.take(sample);
        for arrow in &self.arrows {
            let joint = JointHandle::<M, ()>::new(arrow.joint);
            let wrench = sample.reaction_on_place(joint, arrow.place);
            let load = wrench.map_or([f32::NAN; 6], |wrench| {
                let point = arrow
                    .marker
                    .map_or(wrench.point, |marker| sample.marker(marker));
                let [x, y, z] = point.map(Real::to_f64).into();
                let [fx, fy, fz] = wrench.force.map(Real::to_f64).into();
                [x, y, z, fx, fy, fz].map(|number: f64| number as f32)
            });
            self.loads.extend(load);
        }
    }

    /// Records a frame of what a [`Stepper`](holonom::Stepper) has reached, or of any other view:
    /// it has no reactions.
    pub fn record_view<S: Real>(&mut self, view: &View<'_, S, M>) {
        self.take(view);
        let none = 6 * self.arrows.len();
        self.loads.resize(self.loads.len() + none, f32::NAN);
    }

    /// A frame but its reactions.
    fn take<S: Real>(&mut self, view: &View<'_, S, M>) {
        if self.times.is_empty() {
            self.begin(view);
        }
        self.frame(view);
    }

    /// Time and poses.
    fn frame<S: Real>(&mut self, view: &View<'_, S, M>) {
        self.times.push(view.time().to_f64());
        for body in 0..M::REPORT.bodies.len() {
            let (position, orientation) = placement(view, body);
            let [x, y, z] = position.into();
            let [i, j, k, w] = orientation.coords.into();
            let pose = [x, y, z, w, i, j, k].map(|number| number as f32);
            self.poses.extend(pose);
        }
    }

    /// A drawing of one configuration.
    pub(crate) fn sketch_of(view: &View<'_, f64, M>) -> String {
        let mut film = Self::new();
        film.begin(view);
        film.frame(view);
        let names: Vec<&str> = M::REPORT.bodies.iter().map(|body| body.name).collect();
        let elements = elements::<M>();
        let subject = film.subject(&elements, &[]);
        let gearing = Gearing::new(&subject, &film.proportions);
        let anchors = [anchors(&subject), gearing.anchors.clone()].concat();
        sketch(&subject, &gearing, &anchors, &names)
    }

    /// What pictures are drawn of.
    fn subject<'a>(&'a self, elements: &'a [Element], traces: &'a [Point]) -> Subject<'a> {
        Subject {
            title: &self.title,
            elements,
            markers: &self.markers,
            points: &self.points,
            traces,
            gravity: self.gravity,
            bodies: M::REPORT.bodies.len(),
            times: &self.times,
            poses: &self.poses,
        }
    }

    /// Records a reading at the last frame; lines of one unit share a chart. Call it in the
    /// observer after [`Film::record`]. Frames without it are left out of the line.
    pub fn reading<S: Real>(&mut self, name: &str, unit: &str, value: S) {
        let Some(frame) = self.times.len().checked_sub(1) else {
            return;
        };
        let known = |values: &Values| values.name == name && values.unit == unit;
        let place = self.readings.iter().position(known).unwrap_or_else(|| {
            self.readings.push(Values {
                name: name.into(),
                unit: unit.into(),
                values: Vec::new(),
            });
            self.readings.len() - 1
        });
        let values = &mut self.readings[place].values;
        values.resize(frame, f32::NAN);
        values.push(value.to_f64() as f32);
    }

    /// Shows another run of the mechanism too: its bodies are seen through, at the same times,
    /// under the title of its film. Before and after its frames they stand still.
    pub fn ghost(&mut self, other: &Self) {
        self.ghost = (other.frames() > 0).then(|| Ghost {
            title: other.title.clone(),
            times: other.times.clone(),
            poses: other.poses.clone(),
        });
    }

    /// Shows the warnings of a run, with a mark at the time of each that has one.
    pub fn warnings(&mut self, warnings: &Warnings) {
        self.warnings = warnings
            .into_iter()
            .map(|warning| Remark {
                text: warning.to_string(),
                time: warning.time(),
            })
            .collect();
    }

    /// The number of frames.
    #[must_use]
    pub fn frames(&self) -> usize {
        self.times.len()
    }

    /// The page.
    ///
    /// # Errors
    /// [`FilmError::Empty`] without a frame; [`FilmError::NotFinite`] where a position is not a
    /// number.
    pub fn html(&self) -> Result<String, FilmError> {
        Ok(PAGE.replacen(PLACE, &self.data()?, 1))
    }

    /// The page with a WebAssembly module that goes on where the film ends, as `holonom-live` makes
    /// it.
    ///
    /// # Errors
    /// As [`Film::html`].
    #[doc(hidden)]
    pub fn html_with_module(&self, module: &[u8]) -> Result<String, FilmError> {
        let program = STANDARD.encode(module);
        let script = format!("<script type=\"text/plain\" id=\"live\">{program}</script>\n{DATA}");
        let page = PAGE.replacen(DATA, &script, 1);
        Ok(page.replacen(PLACE, &self.data()?, 1))
    }

    /// The largest extent of points and centres of mass in the first frame (m); 1 where all is in
    /// one place, or there is no frame.
    #[doc(hidden)]
    #[must_use]
    pub fn extent(&self) -> f64 {
        if self.times.is_empty() {
            return 1.0;
        }
        self.subject(&elements::<M>(), &[]).size()
    }

    /// What the page shows, as the viewer reads it.
    ///
    /// # Errors
    /// As [`Film::html`].
    #[doc(hidden)]
    pub fn data(&self) -> Result<String, FilmError> {
        self.check()?;
        let (bodies, elements) = (bodies::<M>(), elements::<M>());
        let traces = self.traced();
        let subject = self.subject(&elements, &traces);
        let gearing = Gearing::new(&subject, &self.proportions);
        let markers = [&self.markers[..], &anchors(&subject), &gearing.anchors].concat();
        let full: Vec<Vec<f32>> = self
            .readings
            .iter()
            .map(|reading| {
                let mut values = reading.values.clone();
                values.resize(self.times.len(), f32::NAN);
                values
            })
            .collect();
        let readings = self.readings.iter().zip(&full);
        let remarks = [&self.warnings[..], &self.left_out].concat();
        let page = Page {
            title: &self.title,
            bodies: &bodies,
            elements: &elements,
            markers: &markers,
            points: &self.points,
            shapes: &self.shapes,
            meshes: &self.meshes,
            wheels: &gearing.wheels,
            racks: &gearing.racks,
            gravity: self.gravity,
            times: &self.times,
            poses: Floats(&self.poses),
            ghost: self.ghost.as_ref().map(|ghost| Other {
                title: &ghost.title,
                times: &ghost.times,
                poses: Floats(&ghost.poses),
            }),
            loads: Floats(&self.loads),
            arrows: &self.arrows,
            show_arrows: self.shows_arrows,
            traces: &traces,
            readings: readings
                .map(|(reading, values)| Reading {
                    name: &reading.name,
                    unit: &reading.unit,
                    values: Floats(values),
                })
                .collect(),
            warnings: &remarks,
        };
        let mut data = String::new();
        page.write(&mut data);
        Ok(data)
    }

    /// A moving picture for a README or a page of documentation: an SVG that loops without a
    /// program, in light and dark. Plane motions are seen along their normal, others from a corner.
    ///
    /// # Errors
    /// As [`Film::html`].
    pub fn svg(&self) -> Result<String, FilmError> {
        self.check()?;
        Ok(self.subject(&elements::<M>(), &self.traced()).svg())
    }

    /// The film as a glTF file of one piece, for Blender, three.js, game engines and slides: a node
    /// a body, and an animation. Angles between frames turn the short way: record them closely.
    /// Needs the feature `gltf`.
    ///
    /// # Errors
    /// As [`Film::html`].
    #[cfg(feature = "gltf")]
    pub fn gltf(&self) -> Result<String, FilmError> {
        self.check()?;
        let names: Vec<&str> = M::REPORT.bodies.iter().map(|body| body.name).collect();
        let text = gltf(
            &self.subject(&elements::<M>(), &self.traced()),
            (&self.shapes, &self.meshes),
            &names,
        );
        text.map_err(|error| FilmError::Write(error.into()))
    }

    /// Writes the glTF file, whose name ends in `.gltf`.
    ///
    /// # Errors
    /// As [`Film::save`].
    #[cfg(feature = "gltf")]
    pub fn save_gltf(&self, path: impl AsRef<Path>) -> Result<(), FilmError> {
        fs::write(path, self.gltf()?).map_err(FilmError::Write)
    }

    /// Writes the moving picture to a file.
    ///
    /// # Errors
    /// As [`Film::save`].
    pub fn save_svg(&self, path: impl AsRef<Path>) -> Result<(), FilmError> {
        fs::write(path, self.svg()?).map_err(FilmError::Write)
    }

    /// Whether there is something to show.
    fn check(&self) -> Result<(), FilmError> {
        if self.times.is_empty() {
            return Err(FilmError::Empty);
        }
        let numbers = (7 * M::REPORT.bodies.len()).max(1);
        let ghost = self.ghost.iter();
        let ghost = ghost.map(|ghost| (&ghost.times, &ghost.poses));
        for (times, poses) in ghost.chain([(&self.times, &self.poses)]) {
            if let Some(place) = poses.iter().position(|x| !x.is_finite()) {
                let time = times[place / numbers];
                return Err(FilmError::NotFinite { time });
            }
        }
        Ok(())
    }

    /// Writes the page to a file.
    ///
    /// # Errors
    /// As [`Film::html`]; [`FilmError::Write`] where the file cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), FilmError> {
        fs::write(path, self.html()?).map_err(FilmError::Write)
    }

    /// What does not change in a run.
    fn begin<S: Real>(&mut self, view: &View<'_, S, M>) {
        self.gravity = view.gravity().map(Real::to_f64).into();
        self.markers = markers(view);
        self.points = points(view);
        self.shapes = shapes(view);
        self.proportions = proportions(view);
        if self.shows_arrows {
            self.arrows = arrows::<M>();
        }
        let left_out = self.described_meshes(view).into_iter();
        let remark = |text| Remark { text, time: None };
        self.left_out = left_out.map(remark).collect();
    }

    /// Says which meshes would be drawn.
    #[cfg(not(feature = "meshes"))]
    fn described_meshes<S: Real>(&self, _view: &View<'_, S, M>) -> Vec<String> {
        let files = crate::description::meshes::<M>().filter_map(|(_, mesh)| mesh.file);
        files
            .map(|file| format!("{file}: needs the feature `meshes` of `holonom-film`"))
            .collect()
    }
}
