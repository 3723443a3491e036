//! What is running and how long it will take: a bar on a terminal, plain lines elsewhere.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal as _;
use std::time::{Duration, Instant};

/// Between plain lines.
const PLAIN_INTERVAL: Duration = Duration::from_secs(10);

/// Progress of one run, in steps of about equal length.
pub(crate) struct Progress {
    bar: Option<ProgressBar>,
    started: Instant,
    last_line: Instant,
    done: u64,
    total: u64,
    message: String,
}

impl Progress {
    /// Starts with `total` steps to go.
    pub(crate) fn new(total: u64) -> Self {
        let bar = std::io::stderr().is_terminal().then(|| {
            let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr());
            let style =
                ProgressStyle::with_template("{bar:32} {percent:>3} %  {elapsed} gone, {eta} left  {msg}");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar.enable_steady_tick(Duration::from_millis(250));
            bar
        });
        let now = Instant::now();
        Self { bar, started: now, last_line: now, done: 0, total, message: String::new() }
    }

    /// Says what is being done now.
    pub(crate) fn say(&mut self, message: String) {
        self.message = message;
        match &self.bar {
            Some(bar) => bar.set_message(self.message.clone()),
            None => self.plain_line(),
        }
    }

    /// Some steps are done.
    pub(crate) fn advance(&mut self, steps: u64) {
        self.done += steps;
        match &self.bar {
            Some(bar) => bar.inc(steps),
            None => self.plain_line(),
        }
    }

    /// A line that stays.
    pub(crate) fn note(&self, line: &str) {
        match &self.bar {
            Some(bar) => bar.println(line),
            None => eprintln!("{line}"),
        }
    }

    /// Takes the bar away.
    pub(crate) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }

    fn plain_line(&mut self) {
        let first = self.done == 0 && self.last_line == self.started;
        if !first && self.last_line.elapsed() < PLAIN_INTERVAL {
            return;
        }
        self.last_line = Instant::now();
        let percent = 100 * self.done / self.total.max(1);
        let elapsed = self.started.elapsed().as_secs_f64();
        let left = match self.done {
            0 => String::new(),
            done => format!(
                ", about {:.0} s left",
                elapsed / done as f64 * (self.total - done.min(self.total)) as f64
            ),
        };
        eprintln!("{percent:>3} %  {elapsed:.0} s gone{left}  {}", self.message);
    }
}
