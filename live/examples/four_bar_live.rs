//! A four-bar with springs, whose lengths a reader moves while it runs:
//!
//! ```text
//! cargo run --release -p holonom-live --example four_bar_live -- target/films/four-bar-live.html
//! ```

mod linkage;

use linkage::FourBar;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::args().nth(1);
    Ok(linkage::live(FourBar::default()).page(file.unwrap_or("four-bar-live.html".into()))?)
}
