//! Memory that rays walk through at random: in huge pages where the system has them.
//!
//! With pages of 4 KiB nearly every node of a large scene costs a page walk too, which under a
//! hypervisor is two-dimensional.

/// Moves items into memory of which the kernel was asked to make huge pages.
pub(super) fn in_huge_pages<T: Copy>(items: Vec<T>) -> Vec<T> {
    if size_of_val(&items[..]) < HUGE_PAGE {
        return items;
    }
    let mut moved = Vec::with_capacity(items.len());
    ask_for_huge_pages(moved.as_mut_ptr(), items.len());
    moved.extend_from_slice(&items);
    moved
}

/// Size of a huge page on x86-64 and of most on AArch64.
const HUGE_PAGE: usize = 2 << 20;

/// A wish for the whole huge pages inside of a range that has not been touched yet.
#[cfg(target_os = "linux")]
fn ask_for_huge_pages<T>(start: *mut T, count: usize) {
    let skipped = start.cast::<u8>().align_offset(HUGE_PAGE);
    let whole = (count * size_of::<T>()).saturating_sub(skipped) / HUGE_PAGE * HUGE_PAGE;
    if whole > 0 && !cfg!(miri) {
        let first = start.cast::<u8>().wrapping_add(skipped);
        // SAFETY: the range is page aligned and inside the caller's allocation; the advice changes
        // how it is mapped, not what it holds.
        unsafe { libc::madvise(first.cast(), whole, libc::MADV_HUGEPAGE) };
    }
}

#[cfg(not(target_os = "linux"))]
fn ask_for_huge_pages<T>(_start: *mut T, _count: usize) {}
