mod models;
mod saved;
