//! A study as a job array of Slurm: one index per incomplete run, the same command as on one machine.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::child::Program;
use super::engine::memory_of;
use super::estimate::Estimate;
use super::folder::StudyFolder;
use super::run::PlannedRun;
use meniscus_output::{FileError, atomic};

/// Seconds before a time limit at which a run is requested to save its state.
const NOTICE: u32 = 60;

/// Default memory of a run in MiB.
const MEMORY: u64 = 1024;

/// Smallest memory of a run in MiB: the shell that starts it needs some, too.
const LEAST_MEMORY: u64 = 64;

/// Why an array cannot be submitted.
#[derive(Debug, thiserror::Error)]
pub(crate) enum SlurmError {
    /// The script cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// There is no Slurm.
    #[error("`sbatch` cannot be started ({error}); the script is in {}", script.display())]
    NoSbatch {
        /// The error of the system.
        error: std::io::Error,
        /// The script.
        script: PathBuf,
    },
    /// Slurm refused.
    #[error("sbatch refused {}: {said}", script.display())]
    Refused {
        /// The script.
        script: PathBuf,
        /// Its message.
        said: String,
    },
}

/// Content of an array.
#[derive(Debug)]
pub(crate) struct Array<'a> {
    /// Name of the study.
    pub(crate) name: &'a str,
    /// The incomplete runs.
    pub(crate) runs: &'a [&'a PlannedRun],
    /// The expected cost of each of them.
    pub(crate) estimates: &'a [Estimate],
    /// Folder of the results.
    pub(crate) folder: &'a StudyFolder,
    /// This program.
    pub(crate) program: &'a Program,
    /// Threads of each run.
    pub(crate) threads: usize,
    /// Most concurrent runs; `None` for as many as the cluster allows.
    pub(crate) jobs: Option<usize>,
    /// Further options of `sbatch`, as in a script.
    pub(crate) options: &'a [String],
}

/// The script of an array.
pub(crate) fn script(array: &Array<'_>) -> String {
    const BYTES_PER_MEBIBYTE: u64 = 1 << 20;
    let indices: Vec<usize> = array.runs.iter().map(|planned| planned.run.index).collect();
    let largest = array.estimates.iter().map(|estimate| memory_of(Some(estimate))).max().unwrap_or(0);
    let memory = if largest == 0 { MEMORY } else { largest.div_ceil(BYTES_PER_MEBIBYTE).max(LEAST_MEMORY) };
    let root = absolute(array.folder.root());
    let threads = array.threads;
    let at_once = array.jobs.map_or(String::new(), |jobs| format!("%{jobs}"));
    let mut lines = vec![
        "#!/bin/bash".to_owned(),
        format!("#SBATCH --job-name={}", quoted(array.name)),
        format!("#SBATCH --array={}{at_once}", ranges(&indices)),
        format!("#SBATCH --cpus-per-task={threads}"),
        format!("#SBATCH --mem={memory}M"),
        // The interrupt lets the run save its state; the process replaces the shell that would get it.
        format!("#SBATCH --signal=B:INT@{NOTICE}"),
        format!("#SBATCH --output={}", quoted(&root.join("logs").join("slurm-%A-%a.log").display().to_string())),
    ];
    lines.extend(array.options.iter().map(|option| format!("#SBATCH {option}")));
    let show = |path: &Path| quoted(&absolute(path).display().to_string());
    lines.push(format!(
        "exec {} study run --index \"$SLURM_ARRAY_TASK_ID\" --threads {threads} --out {} -- {}",
        show(&array.program.path),
        show(array.folder.root()),
        show(&array.program.study)
    ));
    lines.join("\n") + "\n"
}

/// Writes the script and submits it.
pub(crate) fn submit(array: &Array<'_>) -> Result<String, SlurmError> {
    let path = array.folder.root().join("slurm.sh");
    atomic::make_folder(&array.folder.root().join("logs"))?;
    atomic::write(&path, script(array).as_bytes())?;
    let output = Command::new("sbatch")
        .arg("--parsable")
        .arg(&path)
        .output()
        .map_err(|error| SlurmError::NoSbatch { error, script: path.clone() })?;
    if !output.status.success() {
        let said = super::child::errors_of(&output);
        return Err(SlurmError::Refused { script: path, said });
    }
    Ok(super::child::output_line(&output))
}

/// `1-3,7` for 1, 2, 3, 7.
fn ranges(indices: &[usize]) -> String {
    let mut parts: Vec<(usize, usize)> = Vec::new();
    for &index in indices {
        match parts.last_mut() {
            Some((_, last)) if *last + 1 == index => *last = index,
            _ => parts.push((index, index)),
        }
    }
    let part =
        |(first, last): (usize, usize)| if first == last { format!("{first}") } else { format!("{first}-{last}") };
    parts.into_iter().map(part).collect::<Vec<_>>().join(",")
}

fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf())
}

/// The text quoted as one word of a shell.
fn quoted(text: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "/._-+=%".contains(c);
    if !text.is_empty() && text.chars().all(plain) {
        text.to_owned()
    } else {
        format!("'{}'", text.replace('\'', "'\\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_are_written_as_ranges_and_paths_as_one_word() {
        assert_eq!(ranges(&[1, 2, 3, 7, 9, 10]), "1-3,7,9-10");
        assert_eq!(quoted("/a/b-1.toml"), "/a/b-1.toml");
        assert_eq!(quoted("it's here"), "'it'\\''s here'");
    }
}
