//! What every benchmark does: it prints its table, then criterion's statistics unless only the table is wanted.

use criterion::Criterion;

/// Prints the table; with `-- --table` nothing else.
pub fn table_then_statistics(print_table: fn(), statistics: fn(&mut Criterion)) {
    print_table();
    if !std::env::args().any(|argument| argument == "--table") {
        let mut criterion = Criterion::default().configure_from_args();
        statistics(&mut criterion);
        criterion.final_summary();
    }
}
