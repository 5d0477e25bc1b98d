//! The program as its user sees it: command line, cases, messages, interrupted runs.

#[path = "../support/mod.rs"]
mod support;

mod bad_drawings;
mod before_a_run;
mod case_files;
mod case_schema;
mod cases;
mod chip;
mod command_line;
mod expectations;
mod faults;
mod marks;
mod mirrored;
mod movies;
mod network_page;
mod pages;
