// Entries of 64 bits, fingerprint above and value below, written by one compare-and-swap.

//@ atomic64 table_entries

fn table_fingerprint(entry: u64) -> u32 {
    return u32(entry >> 32u);
}

fn table_find(key: KeyHash) -> TableEntry {
    let first = table_first(key);
    for (var e = 0u; e < word_table_size(1u); e += 1u) {
        let entry = long_table_entries(first + e);
        if table_fingerprint(entry) == key.fingerprint {
            return TableEntry(true, u32(entry & 0xfffffffflu));
        }
        if entry == 0lu {
            break;
        }
    }
    return TableEntry(false, 0u);
}

fn table_put(key: KeyHash, word: u32) {
    let first = table_first(key);
    let filled = (u64(key.fingerprint) << 32u) | u64(word);
    var e = 0u;
    while e < word_table_size(1u) {
        let entry = long_table_entries(first + e);
        if entry == 0lu {
            let outcome = compare_table_entries(first + e, 0lu, filled);
            if outcome.exchanged {
                table_count(TABLE_STORED);
                return;
            }
            // The exchange is weak: it may fail although the entry is free, and then it is tried again.
            if outcome.old == 0lu {
                continue;
            }
            if table_fingerprint(outcome.old) != key.fingerprint {
                // Another invocation was faster; as in the paper its loser does not try again.
                table_count(TABLE_LOST);
            }
            return;
        }
        if table_fingerprint(entry) == key.fingerprint {
            return;
        }
        e += 1u;
    }
    table_count(TABLE_REFUSED);
}
