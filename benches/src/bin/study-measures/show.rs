//! `study show`.

use std::error::Error;
use std::fs;
use std::path::PathBuf;

use clap::Args;
use holonom_benches::output;
use holonom_benches::show::{first, scene, scenes};
use holonom_study::StudyError;

#[derive(Debug, Args)]
pub(crate) struct Show {
    /// What moves: a name, or `all`; six mechanisms of different kinds if nothing is said.
    #[arg(long, value_name = "NAME")]
    problem: Option<String>,
    /// How long it moves (s), if not as long as is usual for the problem.
    #[arg(long, value_name = "S", value_parser = seconds)]
    seconds: Option<f64>,
    /// Where the page goes.
    #[arg(long, value_name = "DIR", default_value = "target/study/show")]
    out: PathBuf,
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(value) if value > 0.0 && f64::is_finite(value) => Ok(value),
        _ => Err("not a positive number of seconds, such as 2.5".into()),
    }
}

pub(crate) fn study(arguments: &Show) -> Result<(), Box<dyn Error>> {
    let chosen = match arguments.problem.as_deref() {
        None => first().to_vec(),
        Some("all") => scenes(),
        Some(name) => vec![scene(name)?],
    };
    let out = &arguments.out;
    for scene in chosen {
        let seconds = arguments.seconds.unwrap_or(scene.seconds);
        let film = scene.record(seconds)?;
        let path = out.join(scene.name).with_extension("html");
        let written = fs::create_dir_all(out).and_then(|()| fs::write(&path, &film.html));
        written.map_err(|source| StudyError::Write {
            path: path.clone(),
            source,
        })?;
        output::show(&format!(
            "{}: {seconds} s in {} frames\n{}\n{}\n\n{}\n\n",
            scene.title,
            film.frames,
            film.method,
            film.warnings,
            path.display()
        ))?;
    }
    Ok(())
}
