//! The available memory, and the memory of a direct simulation.

/// Bytes of a kibibyte and of a mebibyte.
const KIBIBYTE: u64 = 1024;
const MEBIBYTE: f64 = 1_048_576.0;

/// Memory per particle in bytes: pairs, matrices and fields, and a record with its picture, measured from 66,000 to 261,000 particles of two fluids.
const BYTES_PER_PARTICLE: f64 = 1600.0;

/// A direct simulation that does not fit into the memory.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "a spacing of {spacing:e} m gives {particles:.2e} particles, which need about {:.0} MiB of memory, and {:.0} MiB are available; a spacing of \
     {enough:.1e} m or more would do", needed / MEBIBYTE, available / MEBIBYTE
)]
pub struct InsufficientMemory {
    /// Spacing in m.
    spacing: f64,
    /// Number of particles.
    particles: f64,
    /// Memory in bytes that they need.
    needed: f64,
    /// Memory in bytes that is available.
    available: f64,
    /// Spacing in m that fits.
    enough: f64,
}

/// Whether the memory (bytes) is too small for a pore of an area (m²) at a spacing (m).
///
/// # Errors
/// [`InsufficientMemory`] if it is.
pub(crate) fn check(area: f64, spacing: f64, available: u64) -> Result<(), InsufficientMemory> {
    let (particles, available) = (area / (spacing * spacing), available as f64);
    let needed = BYTES_PER_PARTICLE * particles;
    if needed <= available {
        return Ok(());
    }
    let enough = rounded_up((area * BYTES_PER_PARTICLE / available).sqrt());
    Err(InsufficientMemory { spacing, particles, needed, available, enough })
}

/// Rounded up to two digits.
fn rounded_up(value: f64) -> f64 {
    let unit = 10.0_f64.powf(value.log10().floor() - 1.0);
    (value / unit).ceil() * unit
}

/// Memory in bytes still available to this process, if the system reports it.
pub(crate) fn available() -> Option<u64> {
    [free(), address_space()].into_iter().flatten().min()
}

/// Free memory in bytes, if the system reports it, within the limit of the control group of this process.
pub(crate) fn free() -> Option<u64> {
    let free = kibibytes(&std::fs::read_to_string("/proc/meminfo").ok()?, "MemAvailable:")?;
    let limit = std::fs::read_to_string("/sys/fs/cgroup/memory.max").ok().and_then(|text| text.trim().parse().ok());
    Some(free.min(limit.unwrap_or(u64::MAX)))
}

/// Peak memory in bytes of this process so far, if the system reports it.
pub(crate) fn peak() -> Option<u64> {
    kibibytes(&std::fs::read_to_string("/proc/self/status").ok()?, "VmHWM:")
}

/// The remaining address space of this process in bytes; `None` if it has no limit or the system does not report it.
fn address_space() -> Option<u64> {
    let limit = address_space_limit(&std::fs::read_to_string("/proc/self/limits").ok()?)?;
    let taken = kibibytes(&std::fs::read_to_string("/proc/self/status").ok()?, "VmSize:")?;
    Some(limit.saturating_sub(taken))
}

/// The soft limit in bytes, from the text of `/proc/self/limits`.
fn address_space_limit(text: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix("Max address space"))?;
    line.split_whitespace().next()?.parse().ok()
}

/// The value in bytes of a line such as `VmSize: 12 kB`.
fn kibibytes(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    line.split_whitespace().next()?.parse::<u64>().ok().map(|kibibytes| kibibytes.saturating_mul(KIBIBYTE))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spacing_that_the_memory_does_not_hold_is_refused_with_one_that_it_holds() {
        let (area, available) = (1e-6, 150 << 20);
        // 10,000 particles need 15 MiB, a million a hundred times as much.
        assert_eq!(check(area, 1e-5, available), Ok(()));
        let refused = check(area, 1e-6, available).unwrap_err();
        let message = "a spacing of 1e-6 m gives 1.00e6 particles, which need about 1526 MiB of memory, and 150 MiB are available; a spacing of \
                    3.2e-6 m or more would do";
        assert_eq!(refused.to_string(), message);
        assert_eq!(check(area, refused.enough, available), Ok(()));
    }

    #[test]
    fn what_the_system_tells_is_read() {
        assert_eq!(kibibytes("MemTotal: 9 kB\nMemAvailable:   12 kB\n", "MemAvailable:"), Some(12 * 1024));
        let limits =
            |value: &str| format!("Limit Soft Hard Units\nMax address space         {value}   unlimited   bytes\n");
        assert_eq!(address_space_limit(&limits("4096")), Some(4096));
        assert_eq!(address_space_limit(&limits("unlimited")), None);
        assert_eq!(address_space_limit(""), None);
    }
}
