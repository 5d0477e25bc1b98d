//! A study as a job array of Slurm: the script, and the real thing on this machine, which needs Slurm and Munge and is ignored otherwise.
#![cfg(unix)]

use std::net::TcpListener;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::support::program::{assert_code, command, meniscus, stderr, stdout};

const STUDY: &str = r#"
format = 1
title = "Small drops on a cluster"
case = "drop.toml"
[[axis]]
key = "sph.wetting.young.contact-angle-deg"
name = "angle"
values = [50, 60, 70, 80]
"#;

fn folder() -> tempfile::TempDir {
    let folder = crate::support::program::folder_with_small_case();
    std::fs::write(folder.path().join("study.toml"), STUDY).unwrap();
    folder
}

/// Submits with a path on which there is `sbatch` only as far as `bin` holds it.
fn submit(folder: &Path, bin: &Path) -> std::process::Output {
    command(
        folder,
        &["study", "run", "study.toml", "--out", "out", "--engine", "slurm", "--jobs", "2", "--sbatch=--time=5"],
    )
    .env("PATH", bin)
    .output()
    .unwrap()
}

#[test]
fn the_script_of_a_job_array_names_the_runs_that_are_left() {
    let folder = folder();
    assert_code(&meniscus(folder.path(), &["study", "run", "study.toml", "--out", "out", "--index", "3"]), 0);
    let bin = folder.path().join("bin");
    std::fs::create_dir(&bin).unwrap();
    let output = submit(folder.path(), &bin);
    assert_code(&output, 2);
    assert!(stderr(&output).contains("`sbatch` cannot be started"), "{}", stderr(&output));
    let script = std::fs::read_to_string(folder.path().join("out/slurm.sh")).unwrap();
    let lines: Vec<&str> = script.lines().collect();
    assert_eq!(lines[0], "#!/bin/bash");
    for line in ["#SBATCH --array=1-2,4%2", "#SBATCH --cpus-per-task=1", "#SBATCH --time=5"] {
        assert!(lines.contains(&line), "{line} is missing in\n{script}");
    }
    // What the first steps of a run were measured to take, 64 MiB at least; these runs are small.
    let memory =
        lines.iter().find_map(|line| line.strip_prefix("#SBATCH --mem=")?.strip_suffix('M')?.parse::<u32>().ok());
    assert!(memory.is_some_and(|memory| (64..=96).contains(&memory)), "{script}");
    let last = lines.last().unwrap();
    assert!(last.starts_with("exec /") && last.contains("--index \"$SLURM_ARRAY_TASK_ID\""), "{script}");
    assert!(Command::new("bash").arg("-n").arg(folder.path().join("out/slurm.sh")).status().unwrap().success());
}

#[test]
fn several_studies_are_submitted_one_by_one() {
    let folder = folder();
    std::fs::write(folder.path().join("other.toml"), STUDY.replace("[50, 60, 70, 80]", "[50, 60]")).unwrap();
    let bin = folder.path().join("bin");
    std::fs::create_dir(&bin).unwrap();
    // It tells what it was given, in place of a cluster.
    let sbatch = bin.join("sbatch");
    std::fs::write(&sbatch, "#!/bin/sh\necho 7\n").unwrap();
    let mut executable = std::fs::metadata(&sbatch).unwrap().permissions();
    std::os::unix::fs::PermissionsExt::set_mode(&mut executable, 0o755);
    std::fs::set_permissions(&sbatch, executable).unwrap();
    let output =
        command(folder.path(), &["study", "run", "study.toml", "other.toml", "--out", "out", "--engine", "slurm"])
            .env("PATH", &bin)
            .output()
            .unwrap();
    assert_code(&output, 0);
    let text = stdout(&output);
    assert!(
        text.contains("4 runs submitted as job array 7") && text.contains("2 runs submitted as job array 7"),
        "{text}"
    );
    for (name, array) in [("study", "1-4"), ("other", "1-2")] {
        let script = std::fs::read_to_string(folder.path().join(format!("out/study-{name}/slurm.sh"))).unwrap();
        assert!(script.contains(&format!("--array={array}")) && script.contains(&format!("{name}.toml")), "{script}");
    }
}

/// A process of the cluster; it ends with the test.
struct Daemon(Child);

impl Drop for Daemon {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = Command::new("kill").arg(self.0.id().to_string()).status();
        let _ = self.0.wait();
    }
}

fn daemon(program: &str, arguments: &[&str], configuration: &Path) -> Option<Daemon> {
    let mut command = Command::new(program);
    command.args(arguments).env("SLURM_CONF", configuration).stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().ok().map(Daemon)
}

fn free_port() -> u16 {
    TcpListener::bind(("127.0.0.1", 0)).unwrap().local_addr().unwrap().port()
}

/// A cluster of one node on this machine; the reason where there is none.
fn cluster(folder: &Path) -> Result<Vec<Daemon>, String> {
    let missing = |program: &&&str| Command::new(program).arg("-V").output().is_err();
    if let Some(program) = ["munged", "slurmctld", "slurmd", "sbatch"].iter().find(missing) {
        return Err(format!("{program} is not installed"));
    }
    use std::os::unix::fs::PermissionsExt;
    for name in ["state", "spool", "munge"] {
        std::fs::create_dir(folder.join(name)).unwrap();
    }
    let at = |name: &str| folder.join(name).display().to_string();
    let key: Vec<u8> = (0..=u8::MAX).cycle().take(1024).collect();
    std::fs::write(at("munge/key"), key).unwrap();
    std::fs::set_permissions(at("munge/key"), std::fs::Permissions::from_mode(0o400)).unwrap();
    std::fs::set_permissions(at("munge"), std::fs::Permissions::from_mode(0o700)).unwrap();
    let host = Command::new("hostname").arg("-s").output().map_err(|error| error.to_string())?;
    let host = String::from_utf8_lossy(&host.stdout).trim().to_owned();
    let user = Command::new("id").arg("-un").output().map_err(|error| error.to_string())?;
    let user = String::from_utf8_lossy(&user.stdout).trim().to_owned();
    let configuration = format!(
        "ClusterName=test\nSlurmctldHost={host}(127.0.0.1)\nSlurmUser={user}\nSlurmdUser={user}\nAuthType=auth/munge\n\
         AuthInfo=socket={}\nSlurmctldPort={}\nSlurmdPort={}\nStateSaveLocation={}\nSlurmdSpoolDir={}\nSlurmctldPidFile={}\n\
         SlurmdPidFile={}\nSlurmctldLogFile={}\nSlurmdLogFile={}\nProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\n\
         SelectType=select/cons_tres\nSelectTypeParameters=CR_Core_Memory\nReturnToService=2\nMpiDefault=none\n\
         NodeName={host} NodeAddr=127.0.0.1 CPUs=1 RealMemory=500 State=UNKNOWN\nPartitionName=all Nodes={host} Default=YES\n",
        at("munge.sock"),
        free_port(),
        free_port(),
        at("state"),
        at("spool"),
        at("slurmctld.pid"),
        at("slurmd.pid"),
        at("slurmctld.log"),
        at("slurmd.log"),
    );
    let path = folder.join("slurm.conf");
    std::fs::write(&path, configuration).unwrap();
    let munge: Vec<String> = [("key-file", "munge/key"), ("socket", "munge.sock"), ("pid-file", "munge/pid")]
        .into_iter()
        .chain([("log-file", "munge/log"), ("seed-file", "munge/seed")])
        .map(|(option, file)| format!("--{option}={}", at(file)))
        .collect();
    let munge: Vec<&str> = munge.iter().map(String::as_str).chain(["--force", "--foreground"]).collect();
    let mut daemons = vec![daemon("munged", &munge, &path).ok_or("munged cannot be started")?];
    wait(10, || folder.join("munge.sock").exists()).ok_or("munged does not answer")?;
    for program in ["slurmctld", "slurmd"] {
        daemons.push(daemon(program, &["-D"], &path).ok_or("Slurm cannot be started")?);
    }
    let idle = || {
        let nodes = Command::new("sinfo").args(["-h", "-o", "%T"]).env("SLURM_CONF", &path).output();
        nodes.is_ok_and(|output| String::from_utf8_lossy(&output.stdout).trim() == "idle")
    };
    wait(20, idle).ok_or_else(|| {
        let log = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap_or_default();
        format!("the node does not come up: {}{}", log("slurmctld.log"), log("slurmd.log"))
    })?;
    Ok(daemons)
}

/// Waits up to some seconds until `found` says so.
fn wait(seconds: u64, mut found: impl FnMut() -> bool) -> Option<()> {
    let clock = Instant::now();
    while !found() {
        if clock.elapsed() > Duration::from_secs(seconds) {
            return None;
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    Some(())
}

#[test]
#[ignore = "needs Slurm and Munge (Debian, Ubuntu: apt install slurm-wlm munge), then --include-ignored; .ci/run does it"]
fn a_job_array_on_a_real_cluster_of_one_node_does_all_runs() {
    let place = tempfile::tempdir().unwrap();
    let daemons = cluster(place.path()).unwrap_or_else(|reason| panic!("there is no cluster to test on: {reason}"));
    let folder = folder();
    let output = command(folder.path(), &["study", "run", "study.toml", "--out", "out", "--engine", "slurm"])
        .env("SLURM_CONF", place.path().join("slurm.conf"))
        .output()
        .unwrap();
    assert_code(&output, 0);
    assert!(stdout(&output).contains("4 runs submitted as job array 1"), "{}", stdout(&output));
    let complete = || {
        let output = meniscus(folder.path(), &["study", "report", "study.toml", "--out", "out"]);
        stdout(&output).matches("| done ").count() == 4
    };
    let log = || std::fs::read_to_string(place.path().join("slurmctld.log")).unwrap_or_default();
    assert!(wait(60, complete).is_some(), "the runs did not end\n{}", log());
    // A job that is not yet taken from the queue would outlive its cluster.
    let is_empty = || {
        let queue = Command::new("squeue").arg("-h").env("SLURM_CONF", place.path().join("slurm.conf")).output();
        queue.is_ok_and(|output| output.status.success() && output.stdout.is_empty())
    };
    assert!(wait(30, is_empty).is_some(), "the queue does not empty\n{}", log());
    drop(daemons);
    // The same table as on one machine.
    let table = |out: &str| std::fs::read_to_string(folder.path().join(out).join("table.csv")).unwrap();
    assert_code(&meniscus(folder.path(), &["study", "run", "study.toml", "--out", "here"]), 0);
    assert_eq!(table("out"), table("here"));
}
