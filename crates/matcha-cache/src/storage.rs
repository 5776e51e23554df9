//! Memory of the entries: zeroed by the system when first touched, in huge pages
//! where there are any, aligned so that cells share as few cache lines as they can.

use crate::CacheError;
use crate::sync::AtomicU64;

/// A slice of entries, all empty at first.
pub(crate) struct Storage {
    #[cfg(not(loom))]
    words: core::ptr::NonNull<AtomicU64>,
    #[cfg(not(loom))]
    length: usize,
    #[cfg(not(loom))]
    allocation: (core::ptr::NonNull<u8>, core::alloc::Layout),
    #[cfg(loom)]
    words: Box<[AtomicU64]>,
}

#[cfg(loom)]
impl Storage {
    pub(crate) fn new(length: usize) -> Result<Self, CacheError> {
        Ok(Self {
            words: (0..length).map(|_| AtomicU64::new(0)).collect(),
        })
    }

    pub(crate) fn words(&self) -> &[AtomicU64] {
        &self.words
    }
}

#[cfg(not(loom))]
mod zeroed {
    use super::*;
    use core::alloc::Layout;
    use core::ptr::NonNull;

    /// Size of a huge page on x86-64 and of most on AArch64.
    const HUGE_PAGE: usize = 2 << 20;
    const CACHE_LINE: usize = 64;

    impl Storage {
        pub(crate) fn new(length: usize) -> Result<Self, CacheError> {
            let bytes = length.saturating_mul(8);
            let refused = CacheError::Refused {
                bytes: bytes as u64,
            };
            let align = if bytes >= HUGE_PAGE {
                HUGE_PAGE
            } else {
                CACHE_LINE
            };
            // The allocator clears memory itself if asked for a large alignment, which
            // would touch every page. Ask for a small one, and align inside.
            let layout = bytes
                .checked_add(align)
                .and_then(|size| Layout::from_size_align(size, 16).ok())
                .ok_or(refused.clone())?;
            // SAFETY: the layout's size is at least `align`, not zero.
            let raw = unsafe { std::alloc::alloc_zeroed(layout) };
            let base = NonNull::new(raw).ok_or(refused)?;
            let offset = base.as_ptr().align_offset(align);
            // SAFETY: `offset` is below `align`, and `align` bytes more than needed were
            // allocated; zero bytes are valid AtomicU64s, and the result is aligned for them.
            let words = unsafe { base.add(offset).cast::<AtomicU64>() };
            ask_for_huge_pages(words.cast(), bytes);
            Ok(Self {
                words,
                length,
                allocation: (base, layout),
            })
        }

        #[inline(always)]
        pub(crate) fn words(&self) -> &[AtomicU64] {
            // SAFETY: `words` points at `length` initialised entries that live as long as
            // `self`; they are only ever reached as atomics.
            unsafe { core::slice::from_raw_parts(self.words.as_ptr(), self.length) }
        }
    }

    impl Drop for Storage {
        fn drop(&mut self) {
            let (base, layout) = self.allocation;
            // SAFETY: this is the pointer and layout of the allocation in `new`.
            unsafe { std::alloc::dealloc(base.as_ptr(), layout) }
        }
    }

    // SAFETY: the memory is owned and reached as atomics only.
    unsafe impl Send for Storage {}
    // SAFETY: as above.
    unsafe impl Sync for Storage {}

    /// A wish: without it look-ups cost more page walks, nothing else.
    #[cfg(target_os = "linux")]
    fn ask_for_huge_pages(start: NonNull<u8>, bytes: usize) {
        let whole = bytes / HUGE_PAGE * HUGE_PAGE;
        if whole > 0 && !cfg!(miri) {
            // SAFETY: the range is page aligned and inside this allocation; the advice
            // changes how it is mapped, not what it holds.
            unsafe { libc::madvise(start.as_ptr().cast(), whole, libc::MADV_HUGEPAGE) };
        }
    }

    #[cfg(not(target_os = "linux"))]
    fn ask_for_huge_pages(_start: NonNull<u8>, _bytes: usize) {}
}

#[cfg(all(test, not(loom)))]
mod tests {
    use super::*;
    use core::sync::atomic::Ordering;

    #[test]
    fn memory_is_aligned_and_empty() {
        for length in [1, 10, 1000, 1 << 19] {
            let storage = Storage::new(length).unwrap();
            let words = storage.words();
            assert_eq!(words.len(), length);
            assert_eq!(words.as_ptr() as usize % 64, 0);
            assert!(words.iter().all(|word| word.load(Ordering::Relaxed) == 0));
        }
    }

    #[test]
    fn too_much_is_refused() {
        assert!(Storage::new(usize::MAX / 8).is_err());
    }
}
