//! Other processes of this program: one estimates the cost of a run, one does a run.
//!
//! Each run is a process, so that a crash does not affect others, its memory can be measured and is returned to the system, and a run on a cluster is the same
//! command. The standard input of such a process is a pipe held by its parent: when the parent dies, for whatever reason, the pipe closes, and the run saves
//! its state and ends.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

use super::run::Run;

/// The program, to be started as another process.
#[derive(Debug, Clone)]
pub(crate) struct Program {
    /// Its file.
    pub(crate) path: PathBuf,
    /// The study file.
    pub(crate) study: PathBuf,
}

/// Environment variable for the number of threads.
const THREADS: &str = "RAYON_NUM_THREADS";

impl Program {
    /// The output of `check --json` for a run with this number of threads.
    ///
    /// # Errors
    /// The error output of the process.
    pub(crate) fn check(&self, run: &Run, threads: usize) -> Result<Vec<u8>, String> {
        let mut command = Command::new(&self.path);
        command.args(["check", "--json"]).env(THREADS, threads.to_string()).stdin(Stdio::null());
        for text in run.overrides() {
            command.arg(format!("--set={text}"));
        }
        let output = command.arg("--").arg(&run.case).output().map_err(|error| error.to_string())?;
        if output.status.success() {
            return Ok(output.stdout);
        }
        Err(errors_of(&output))
    }

    /// Starts a process that does one run; `digest` is that of its case, and its output goes to `log`.
    ///
    /// # Errors
    /// [`io::Error`] if it cannot be started.
    pub(crate) fn start(&self, run: &Run, digest: &str, folder: &Path, threads: usize, log: File) -> io::Result<Child> {
        let also_log = log.try_clone()?;
        Command::new(&self.path)
            .args(["study", "run", "--worker", "--digest", digest, "--index", &run.index.to_string()])
            .args(["--threads", &threads.to_string(), "--out"])
            .arg(folder)
            .arg("--")
            .arg(&self.study)
            .stdin(Stdio::piped())
            .stdout(log)
            .stderr(also_log)
            .spawn()
    }
}

/// The standard output of a process, on one line.
pub(crate) fn output_line(output: &Output) -> String {
    one_line(&output.stdout)
}

/// The error output of a process, on one line.
pub(crate) fn errors_of(output: &Output) -> String {
    one_line(&output.stderr)
}

fn one_line(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).split_whitespace().collect::<Vec<_>>().join(" ")
}
