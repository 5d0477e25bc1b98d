//! Pure functions on points and fields: contours, fits, laws.
