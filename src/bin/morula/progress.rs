//! A progress bar on a terminal; nothing in a pipe.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use morula::Run;
use std::io::IsTerminal;

const STEPS: u64 = 1000;

/// The bar of one call. It is wiped when it goes out of scope, so that an
/// error message stands alone on its line.
pub struct Bar(Option<ProgressBar>);

impl Bar {
    pub fn new(what: &str, quiet: bool) -> Bar {
        if quiet || !std::io::stderr().is_terminal() {
            return Bar(None);
        }
        let bar =
            ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr_with_hz(10));
        if let Ok(style) = ProgressStyle::with_template("{msg} [{bar:40}] {percent:>3} % {elapsed}")
        {
            bar.set_style(style.progress_chars("=> "));
        }
        bar.set_message(what.to_string());
        Bar(Some(bar))
    }

    /// What is being done now.
    pub fn say(&self, what: &str) {
        if let Some(bar) = &self.0 {
            bar.set_message(what.to_string());
        }
    }

    /// How far it is, and what is to be said of it.
    #[cfg(feature = "dem")]
    pub fn set(&self, part: f64, what: &str) {
        if let Some(bar) = &self.0 {
            bar.set_position((part * STEPS as f64) as u64);
            bar.set_message(what.to_string());
        }
    }

    /// A run that reports to this bar.
    pub fn attach<'a>(&self, run: Run<'a>) -> Run<'a> {
        match &self.0 {
            None => run,
            Some(bar) => {
                let bar = bar.clone();
                run.with_progress(Box::new(move |fraction| {
                    bar.set_position((fraction * STEPS as f64) as u64);
                    false
                }))
            }
        }
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        if let Some(bar) = &self.0 {
            bar.finish_and_clear();
        }
    }
}
