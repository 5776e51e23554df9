// Entries of two words of 32 bits, for devices without 64-bit atomic operations. An invocation
// claims an entry by its fingerprint and then publishes the value, complemented: zero means that
// it is not there yet. Only the claimer writes the value, once, and a claimed fingerprint never
// changes, so a reader sees a whole entry or a miss. The one value whose complement is zero is
// never published, and so evaluated each time.

//@ atomic table_fingerprints
//@ atomic table_values

fn table_find(key: KeyHash) -> TableEntry {
    let first = table_first(key);
    for (var e = 0u; e < word_table_size(1u); e += 1u) {
        let fingerprint = word_table_fingerprints(first + e);
        if fingerprint == key.fingerprint {
            let value = word_table_values(first + e);
            return TableEntry(value != 0u, ~value);
        }
        if fingerprint == 0u {
            break;
        }
    }
    return TableEntry(false, 0u);
}

fn table_put(key: KeyHash, word: u32) {
    let first = table_first(key);
    var e = 0u;
    while e < word_table_size(1u) {
        let fingerprint = word_table_fingerprints(first + e);
        if fingerprint == 0u {
            let outcome = compare_table_fingerprints(first + e, 0u, key.fingerprint);
            if outcome.exchanged {
                put_table_values(first + e, ~word);
                table_count(TABLE_STORED);
                return;
            }
            // The exchange is weak: it may fail although the entry is free, and then it is tried again.
            if outcome.old == 0u {
                continue;
            }
            if outcome.old != key.fingerprint {
                // Another invocation was faster; as in the paper its loser does not try again.
                table_count(TABLE_LOST);
            }
            return;
        }
        if fingerprint == key.fingerprint {
            return;
        }
        e += 1u;
    }
    table_count(TABLE_REFUSED);
}
