//! Python environments for the scripts in `postprocess` and `benches/peers`, made once from their requirements and kept under `target`.

use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Root of the workspace.
pub fn root() -> &'static Path {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.ancestors().find(|folder| folder.join("Cargo.lock").is_file()).unwrap_or(package)
}

/// What the scripts in `postprocess`, their tests and those of the Python package need, one after the other. That of networks names all that is needed
/// and goes first: what its packages depend on beside that, a solver of 1 GB, is left out.
const REQUIREMENTS: [(&str, &[&str]); 3] = [
    ("postprocess/requirements-network.txt", &["--no-deps"]),
    ("postprocess/requirements.txt", &[]),
    ("python/tests/requirements.txt", &[]),
];

/// The interpreter of the environment in `target/python-venv`, which serves all tests and is made anew when the requirements change.
///
/// Fails the test with what to install where Python 3.11 or later with venv is missing.
pub fn interpreter() -> PathBuf {
    environment("python-venv", &REQUIREMENTS)
}

/// The interpreter of an environment with the programs that `benches/peers.rs` compares with, in `target/peers-venv`.
#[allow(dead_code, reason = "each test binary has its own copy of this module")]
pub fn peers_interpreter() -> PathBuf {
    environment("peers-venv", &[("benches/peers/requirements.txt", &[])])
}

/// The interpreter of an environment with what plays pages in a browser, in `target/browser-venv`.
#[allow(dead_code, reason = "each test binary has its own copy of this module")]
pub fn browser_interpreter() -> PathBuf {
    environment("browser-venv", &[("postprocess/tests/browser/requirements.txt", &[])])
}

/// [`interpreter`] with the package `meniscus`: built by `pip install .` from the present source, with the library that these tests link.
#[allow(dead_code, reason = "each test binary has its own copy of this module")]
pub fn package_interpreter() -> PathBuf {
    let python = interpreter();
    // Two tests may come here at once, as above; what was built is installed again in seconds.
    let lock = fs::File::create(root().join("target/python-package.lock")).expect("target is writable");
    lock.lock().expect("the lock of the Python package");
    let mut install = Command::new(&python);
    install
        .args([
            "-m",
            "pip",
            "install",
            "--quiet",
            "--disable-pip-version-check",
            "--no-deps",
            "--force-reinstall",
            "--no-build-isolation",
        ])
        .arg(root());
    // The backend of the build is started by its name.
    let folders = std::env::var_os("PATH").unwrap_or_default();
    let folders = python.parent().map(Path::to_path_buf).into_iter().chain(std::env::split_paths(&folders));
    install.env("PATH", std::env::join_paths(folders).expect("a path of folders"));
    run(&mut install, "the package must be built");
    python
}

/// The interpreter of an environment with what files of requirements name, each installed with options of pip.
fn environment(name: &str, requirements: &[(&str, &[&str])]) -> PathBuf {
    let mut hasher = DefaultHasher::new();
    for (file, _) in requirements {
        fs::read_to_string(root().join(file)).unwrap_or_else(|error| panic!("{file}: {error}")).hash(&mut hasher);
    }
    let wanted = format!("{:016x}", hasher.finish());

    let target = root().join("target");
    fs::create_dir_all(&target).expect("target can be made");
    // Two tests, or two test commands, may come here at once: the second one waits until the environment is made.
    let lock = fs::File::create(target.join(format!("{name}.lock"))).expect("target is writable");
    lock.lock().expect("the lock of the Python environment");

    let environment = target.join(name);
    let stamp = environment.join("requirements.hash");
    let python = environment.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    if fs::read_to_string(&stamp).is_ok_and(|found| found == wanted) && python.is_file() {
        return python;
    }
    if environment.exists() {
        fs::remove_dir_all(&environment).expect("the old Python environment can be removed");
    }
    let mut make = Command::new("python3");
    make.args(["-m", "venv"]).arg(&environment);
    run(
        &mut make,
        "python3 with venv is needed: install it (Debian, Ubuntu: apt install python3 python3-venv), 3.11 or later",
    );
    for (file, options) in requirements {
        let mut install = Command::new(&python);
        install
            .args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"])
            .args(*options)
            .arg("--requirement")
            .arg(root().join(file));
        let advice = format!(
            "the packages of {file} could not be installed: is the package index reachable, is Python 3.11 or later?"
        );
        run(&mut install, &advice);
    }
    fs::write(&stamp, wanted).expect("the Python environment is writable");
    python
}

/// Runs a command to its end and returns its standard output; fails the test with `advice` and what it wrote.
pub fn run(command: &mut Command, advice: &str) -> String {
    match command.output() {
        Err(error) => panic!("{advice}\n{command:?}: {error}"),
        Ok(output) => {
            let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
            let (out, err) = (text(&output.stdout), text(&output.stderr));
            assert!(output.status.success(), "{advice}\n{command:?}: {}\n{out}{err}", output.status);
            out
        }
    }
}
