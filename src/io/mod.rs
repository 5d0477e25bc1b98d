//! Files: VTK, series, restart; each appears whole or not at all.
