// The material cache's table (Fujieda and Harada 2022, algorithm 1): cells of a few entries, each
// a fingerprint and a value, taken in order, first value stays. How an entry is written is in
// table_int64.wgsl and table_int32.wgsl.

// Cells, entries of a cell.
//@ plain table_size 2
// What became of insertions: stored, refused because the cell was full, lost to another invocation.
//@ atomic table_counts

const TABLE_STORED = 0u;
const TABLE_REFUSED = 1u;
const TABLE_LOST = 2u;

// What a look-up gives.
struct TableEntry {
    found: bool,
    word: u32,
}

// The first entry of a key's cell.
fn table_first(key: KeyHash) -> u32 {
    return cell_of(key.cell, word_table_size(0u)) * word_table_size(1u);
}

fn table_count(outcome: u32) {
    add_table_counts(outcome, 1u);
}
