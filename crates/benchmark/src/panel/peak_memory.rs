use std::fs;

/// Resets the peak memory of this process, where the system can.
pub(super) fn restart_peak() {
    // Linux: 5 resets the peak resident size (proc_pid_clear_refs(5)). Where it cannot, the peak is of longer.
    let _ = fs::write("/proc/self/clear_refs", "5");
}

/// Peak memory of this process since the reset (MB), over all trials that run at the same time; `None` where the
/// system does not report it.
pub(super) fn peak_mb() -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1e-3 * kilobytes)
}
