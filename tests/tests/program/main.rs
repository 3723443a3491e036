//! The program from outside: commands, exit codes, outputs, bad input, crashes.

mod bad_files;
mod bad_places;
mod bad_scenes;
mod claims;
mod commands;
mod dump;
mod figure;
mod gate;
mod models;
mod outputs;
mod recompute;
mod robustness;
mod score;
mod technique;
